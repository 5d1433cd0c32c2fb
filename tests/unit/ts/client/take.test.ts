import { readdirSync, readFileSync } from 'node:fs';
import { beforeAll, describe, expect, it } from 'vitest';
import { readTake, writeTake, type Library, type Take } from '../../../../clients/js/motion/index.ts';
import { neutralFrame, type TimedFrame } from '../../../../protocol/ts/face_frame.ts';
import { nearestLevel, ProtocolError, standardQuantizers } from '../../../../protocol/ts/index.ts';
import { loadLibrary } from '../support/runtime.ts';

const folder = new URL('../../../../protocol/vectors/fap/', import.meta.url);
const names = readdirSync(folder).filter((name) => name.endsWith('.fap'));

/** In the order of FapFileOddity, protocol/cpp/fap_file.h. */
const oddities = [
  'other_version',
  'blank_in_name',
  'count_differs',
  'extra_flag',
  'few_values',
  'more_values',
  'not_finite',
  'first_number_not_zero',
  'numbers_not_rising',
  'numbers_left_out',
  'single_number_viseme',
  'packed_viseme',
  'single_number_expression',
  'unknown_select',
  'strength_out_of_range',
  'strength_not_whole',
];

interface GoldenFrame {
  number: number;
  values: Record<string, number>;
  viseme?: [number, number, number, number];
  expression?: [number, number, number, number, number, number];
}
interface Golden {
  file: { rate: number; name: string; frames: GoldenFrame[] };
  warnings: { oddity: string; line: number; count: number }[];
  written: string;
}
const golden = (name: string): Golden =>
  JSON.parse(readFileSync(new URL(name.replace('.fap', '.json'), folder), 'utf8')) as Golden;
const bytes = (name: string): Uint8Array => new Uint8Array(readFileSync(new URL(name, folder)));

/** What the golden file's frames are in a stream: what is absent is neutral, and the face holds still in gaps. */
function meant({ rate, frames }: Golden['file']): TimedFrame[] {
  const timed: TimedFrame[] = [];
  let before = 0;
  for (const { number, values, viseme, expression } of frames) {
    const timeOf = (at: number): number => Math.round((at * 1000) / rate);
    if (number > before + 1) timed.push({ time: timeOf(number - 1), state: timed.at(-1)!.state });
    const state = neutralFrame();
    if (viseme) [state.viseme.select1, state.viseme.select2, state.viseme.blend] = viseme;
    if (expression) {
      const [select1, intensity1, select2, intensity2] = expression;
      state.expression = { select1, intensity1, select2, intensity2 };
    }
    for (const [fap, value] of Object.entries(values))
      state.levels[Number(fap)] = nearestLevel(value, standardQuantizers[Number(fap)]!);
    timed.push({ time: timeOf(number), state });
    before = number;
  }
  return timed;
}

let library: Library;
beforeAll(async () => {
  library = await loadLibrary();
});
const read = (text: string | Uint8Array, options = {}): Take => readTake(library, 'fap', text, options);
function refusalOf(use: () => unknown): ProtocolError {
  try {
    use();
  } catch (error) {
    if (error instanceof ProtocolError) return error;
    throw error;
  }
  throw new Error('not refused');
}

describe('.fap files', () => {
  it('there are golden files of every quirk', () => expect(names.length).toBeGreaterThanOrEqual(20));

  it.each(names)('%s is read as its golden file says', (name) => {
    const { frameRate, frames, warnings } = read(bytes(name));
    const { file, warnings: expected } = golden(name);
    expect(frameRate).toBe(file.rate);
    expect(frames).toEqual(meant(file));
    expect(warnings.map(({ oddity, line, count }) => ({ oddity: oddities[oddity], line, count }))).toEqual(expected);
    for (const { line, message } of warnings) expect(message).toMatch(new RegExp(`^line ${line}: \\w`));
  });

  it.each(names)('%s as it is written is read as the same frames', (name) => {
    expect(read(golden(name).written).frames).toEqual(read(bytes(name)).frames);
  });

  const { refused } = JSON.parse(readFileSync(new URL('refused.json', folder), 'utf8')) as {
    refused: { name: string; text: string; code: string; where: string }[];
  };
  it.each(refused)('$name is refused by line and word', ({ text, code, where }) => {
    const error = refusalOf(() => read(text));
    expect(error.where).toBe(where);
    expect(error.code).toBe(code === 'too_large' ? code : 'malformed');
    expect(error.message).not.toBe('');
  });
});

describe('frames of a .fap file', () => {
  const mask = (...faps: number[]): string =>
    Array.from({ length: 68 }, (_, i) => (faps.includes(i + 1) ? 1 : 0)).join(' ');
  const text = `2.1 x 10 3\n${mask(1, 3)}\n0 10 0 63 0 400\n${mask(14)}\n1 1e8\n${mask(3)}\n5 800\n`;

  it('are neutral where a FAP is absent, or keep it', () => {
    const zero = read(text).frames;
    expect(zero.map(({ time }) => time)).toEqual([0, 100, 400, 500]);
    expect(zero.map(({ state }) => state.levels[3])).toEqual([100, 0, 0, 200]);
    expect(zero.map(({ state }) => state.levels[14])).toEqual([0, 32767, 32767, 0]);
    expect(zero[1]!.state.viseme.select1).toBe(0);
    const kept = read(text, { absent: 'keep', gaps: 'interpolate' }).frames;
    expect(kept.map(({ time }) => time)).toEqual([0, 100, 500]);
    expect(kept.map(({ state }) => state.levels[3])).toEqual([100, 100, 200]);
    expect(kept[2]!.state.viseme).toEqual({ select1: 10, select2: 0, blend: 63 });
  });
});

describe('files that are written', () => {
  const frames = Array.from({ length: 20 }, (_, i) => {
    const state = neutralFrame();
    state.viseme = { select1: 3, select2: 0, blend: 40 };
    state.levels[3] = 5 * i;
    state.levels[49] = -6 * i;
    return { time: 40 * i, state };
  });

  it('.fap: have the same frames', () => {
    const take = read(writeTake(library, 'fap', frames));
    expect(take.frameRate).toBe(25);
    expect(take.frames).toEqual(frames);
    expect(read(writeTake(library, 'fap', frames, 50)).frameRate).toBe(50);
  });

  it('CSV of Live Link Face: have the turn of the head, and the mouth by its shapes', () => {
    const text = writeTake(library, 'live_link_csv', frames);
    expect(new TextDecoder().decode(text)).toMatch(/^Timecode,BlendShapeCount,EyeBlink/);
    const take = readTake(library, 'live_link_csv', text);
    expect(take.frames).toHaveLength(frames.length);
    expect(take.frameRate).toBeCloseTo(25, 0);
    take.frames.forEach(({ time, state }, i) => {
      expect(Math.abs(time - frames[i]!.time)).toBeLessThan(1);
      expect(state.levels[49]).toBe(frames[i]!.state.levels[49]);
    });
  });

  it('refuse what they cannot hold', () => {
    expect(refusalOf(() => writeTake(library, 'fap', [])).message).toBe('there are no frames');
    expect(refusalOf(() => writeTake(library, 'fap', [...frames].reverse())).where).toBe('frames');
    expect(refusalOf(() => readTake(library, 'live_link_csv', 'a,b\n')).code).toBe('malformed');
  });
});
