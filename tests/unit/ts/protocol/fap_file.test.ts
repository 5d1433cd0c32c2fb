import { readdirSync, readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { framesOfFap, parseFap, ProtocolError, writeFap, type FapFile } from '../../../../protocol/ts/index.ts';

const folder = new URL('../../../../protocol/vectors/fap/', import.meta.url);
const names = readdirSync(folder).filter((name) => name.endsWith('.fap'));

interface Golden {
  file: { rate: number; name: string; frames: Record<string, unknown>[] };
  warnings: unknown[];
  written: string;
}
const golden = (name: string): Golden =>
  JSON.parse(readFileSync(new URL(name.replace('.fap', '.json'), folder), 'utf8')) as Golden;
const bytes = (name: string): Uint8Array => new Uint8Array(readFileSync(new URL(name, folder)));

/** A file in the words of the golden files. */
const described = (file: FapFile): unknown => ({
  rate: file.rate,
  name: file.name,
  frames: file.frames.map(({ number, present, viseme, expression, values }) => ({
    number,
    present,
    values: Object.fromEntries(present.filter((fap) => fap > 2).map((fap) => [fap, values[fap]])),
    ...(viseme && { viseme: Object.values(viseme) }),
    ...(expression && { expression: Object.values(expression) }),
  })),
});

describe('.fap files', () => {
  it('there are golden files of every quirk', () => expect(names.length).toBeGreaterThanOrEqual(20));

  it.each(names)('%s is read as its golden file says', (name) => {
    const { file, warnings } = parseFap(bytes(name));
    expect(described(file)).toEqual(golden(name).file);
    expect(warnings).toEqual(golden(name).warnings);
  });

  it.each(names)('%s is written to the byte as in C++, and read again the same', (name) => {
    const { file } = parseFap(bytes(name));
    const text = writeFap(file);
    expect(text).toBe(golden(name).written);
    expect(parseFap(text).file).toEqual(file);
  });

  const { refused } = JSON.parse(readFileSync(new URL('refused.json', folder), 'utf8')) as {
    refused: { name: string; text: string; code: string; where: string }[];
  };
  it.each(refused)('$name is refused by line and word', ({ text, code, where }) => {
    let error: unknown;
    try {
      parseFap(text);
    } catch (thrown) {
      error = thrown;
    }
    expect(error).toBeInstanceOf(ProtocolError);
    expect(error).toMatchObject({ code, where });
  });
});

describe('frames of a .fap file', () => {
  const mask = (...faps: number[]): string =>
    Array.from({ length: 68 }, (_, i) => (faps.includes(i + 1) ? 1 : 0)).join(' ');
  const { file } = parseFap(`2.1 x 10 3\n${mask(1, 3)}\n0 10 0 63 0 400\n${mask(14)}\n1 1e8\n${mask(3)}\n5 800\n`);

  it('are neutral where a FAP is absent, or keep it', () => {
    const zero = framesOfFap(file);
    expect(zero.map(({ time }) => time)).toEqual([0, 100, 400, 500]);
    expect(zero.map(({ state }) => state.levels[3])).toEqual([100, 0, 0, 200]);
    expect(zero.map(({ state }) => state.levels[14])).toEqual([0, 32767, 32767, 0]);
    expect(zero[1]!.state.viseme.select1).toBe(0);
    const kept = framesOfFap(file, { absent: 'keep', gaps: 'interpolate' });
    expect(kept.map(({ time }) => time)).toEqual([0, 100, 500]);
    expect(kept.map(({ state }) => state.levels[3])).toEqual([100, 100, 200]);
    expect(kept[2]!.state.viseme).toEqual({ select1: 10, select2: 0, blend: 63 });
  });
});
