import { describe, expect, test } from 'vitest';
import { copyFrame, neutralFrame, sameFrame, type FaceFrame } from '@protocol/face_frame.ts';

const changes: [string, (frame: FaceFrame) => void][] = [
  ...(['select1', 'select2', 'blend'] as const).map((part): [string, (frame: FaceFrame) => void] => [
    `viseme.${part}`,
    ({ viseme }) => (viseme[part] += 1),
  ]),
  ...(['select1', 'intensity1', 'select2', 'intensity2'] as const).map((part): [string, (frame: FaceFrame) => void] => [
    `expression.${part}`,
    ({ expression }) => (expression[part] += 1),
  ]),
  ['the first level', ({ levels }) => (levels[3] = 1)],
  ['the last level', ({ levels }) => (levels[levels.length - 1] = -1)],
];

describe('face frames', () => {
  test('SameFrame_ACopy_IsTheSame', () => expect(sameFrame(neutralFrame(), copyFrame(neutralFrame()))).toBe(true));

  test.each(changes)('SameFrame_%sDiffers_IsAnother', (_, change) => {
    const changed = neutralFrame();
    change(changed);
    expect(sameFrame(neutralFrame(), changed)).toBe(false);
  });
});
