import { describe, expect, it } from 'vitest';
import { mirrored, neutralFrame } from '../../../../protocol/ts/index.ts';

describe('mirrored', () => {
  it('Mirrored_LeftBecomesRight_AndTurnsChangeTheirSide', () => {
    const frame = neutralFrame();
    frame.viseme = { select1: 3, select2: 10, blend: 20 };
    frame.levels[19] = 500; // the left upper lid
    frame.levels[24] = 40; // the right eye, to the left
    frame.levels[3] = 100;
    frame.levels[49] = 7; // the head, to the left
    const other = mirrored(frame);
    const expected = neutralFrame();
    expected.viseme = frame.viseme;
    expected.levels[20] = 500;
    expected.levels[23] = -40;
    expected.levels[3] = 100;
    expected.levels[49] = -7;
    expect(other).toEqual(expected);
  });

  it('Mirrored_Twice_IsTheFrameItself', () => {
    const frame = neutralFrame();
    for (let n = 3; n <= 68; n += 1) frame.levels[n] = n * 7 - 200;
    expect(mirrored(mirrored(frame))).toEqual(frame);
    expect(mirrored(frame)).not.toEqual(frame);
  });
});
