import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { beforeAll, describe, expect, it } from 'vitest';
import { Performance, type Library } from '../../../../clients/js/motion/index.ts';
import { ProtocolError } from '../../../../protocol/ts/index.ts';
import { loadLibrary } from '../support/runtime.ts';

const protocol = new URL('../../../../protocol/', import.meta.url);
const read = (name: string): string => readFileSync(new URL(name, protocol), 'utf8');
const { Ajv2020 } = createRequire(new URL('../../../../web/package.json', import.meta.url))('ajv/dist/2020.js') as {
  Ajv2020: new (options: object) => { compile(schema: object): (document: unknown) => boolean };
};

interface Documents {
  good: unknown[];
  refused: { where: string; schema: 'refuses' | 'cannot tell'; document: unknown }[];
}
interface GoldenFrame {
  time: number;
  viseme?: object;
  expression?: object;
  faps?: Record<string, number>;
}

const documents = JSON.parse(read('vectors/performance/documents.json')) as Documents;

let library: Library;
beforeAll(async () => {
  library = await loadLibrary();
});
const perform = (document: string): Performance => new Performance(library, document);

describe('A performance document', () => {
  it('Good_IsTaken', () => {
    for (const document of documents.good as { cues?: unknown[]; idle?: object }[]) {
      const text = JSON.stringify(document);
      if (document.cues?.length || document.idle) expect(() => perform(text), text).not.toThrow();
      else expect(() => perform(text), text).toThrow(/no cues and no idle life/); // a document, but nothing to play
    }
  });

  it('Bad_IsRefusedAtThePlace', () => {
    for (const { where, document } of documents.refused) {
      try {
        perform(JSON.stringify(document));
        expect.fail(`taken: ${JSON.stringify(document)}`);
      } catch (error) {
        expect(error, JSON.stringify(document)).toBeInstanceOf(ProtocolError);
        if (where !== '') expect((error as ProtocolError).where, JSON.stringify(document)).toBe(where);
      }
    }
  });

  it('Schema_AgreesWithTheReader', () => {
    const valid = new Ajv2020({ strict: false }).compile(JSON.parse(read('schema/performance.schema.json')) as object);
    for (const document of documents.good) expect(valid(document), JSON.stringify(document)).toBe(true);
    for (const { schema, document } of documents.refused) {
      expect(valid(document), JSON.stringify(document)).toBe(schema === 'cannot tell');
    }
    for (const name of ['examples/performances/hello.json', 'examples/performances/minute.json']) {
      expect(valid(JSON.parse(read(name))), name).toBe(true);
    }
  }, 60_000); // compiling a schema takes its time on a busy machine
});

describe('Performance', () => {
  it.each([
    ['vectors/performance/corners.json', 'vectors/performance/corners.frames.json'],
    ['examples/performances/hello.json', 'vectors/performance/hello.frames.json'],
  ])('%s_GivesTheGoldenFrames', (document, golden) => {
    const performance = perform(read(document));
    const { frames } = JSON.parse(read(golden)) as { frames: GoldenFrame[] };
    const none = { viseme: { select1: 0, select2: 0, blend: 0 } };
    const neutral = { expression: { select1: 0, intensity1: 0, select2: 0, intensity2: 0 } };
    for (const frame of frames) {
      const face = performance.at(frame.time);
      expect(face.viseme, `at ${frame.time}`).toEqual(frame.viseme ?? none.viseme);
      expect(face.expression, `at ${frame.time}`).toEqual(frame.expression ?? neutral.expression);
      const wrong = face.faps.findIndex((value, n) => Math.abs(value - (frame.faps?.[n] ?? 0)) > 0.01);
      expect(wrong, `the FAP that is wrong at ${frame.time}`).toBe(-1);
    }
  });

  it('FrameAt_IsWhatAStreamCarries', () => {
    const performance = perform(read('examples/performances/hello.json'));
    const frame = performance.frameAt(700);
    const face = performance.at(700);
    expect(frame.levels[48]).toBe(Math.round(face.faps[48]! / 170));
    expect(frame.viseme).toEqual(face.viseme);
  });

  it('At_WithABlinkInMoreTimeThanANumberHolds_KeepsTheEyesOpen', () => {
    const idle = { blinks_per_minute: 1e-310, head: 0, eyes: 0 };
    const performance = perform(JSON.stringify({ format: 'semblante.performance', version: 1, idle }));
    expect(Array.from(performance.at(1000).faps)).toEqual(new Array<number>(69).fill(0));
  });

  it('At_ATimeThatIsNone_Throws', () => {
    const performance = perform(read('examples/performances/hello.json'));
    for (const ms of [-1, NaN, Infinity]) expect(() => performance.at(ms)).toThrow(RangeError);
  });
});
