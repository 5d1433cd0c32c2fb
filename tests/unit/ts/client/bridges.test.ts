import { readFileSync } from 'node:fs';
import { beforeAll, describe, expect, it } from 'vitest';
import { Bridges } from '../../../../clients/js/motion/index.ts';
import { neutralFrame } from '../../../../protocol/ts/face_frame.ts';
import { standardQuantizers } from '../../../../protocol/ts/index.ts';
import { loadLibrary } from '../support/runtime.ts';

interface Vectors {
  in: { coefficients: Record<string, number>; faps: Record<string, number> }[];
  out: { faps: Record<string, number>; coefficients: Record<string, number> }[];
  oculus: { weights: number[]; viseme: { select1: number; select2: number; blend: number } }[];
}
const vectors = JSON.parse(
  readFileSync(new URL('../../../../protocol/vectors/bridges/bridges.json', import.meta.url), 'utf8'),
) as Vectors;

/** Quantizer steps by which each of these values is 20,000 levels, the others whole units. */
function finestSteps(faps: Record<string, number>): Float64Array {
  const steps = standardQuantizers.slice().fill(1);
  for (const [n, value] of Object.entries(faps)) if (value !== 0) steps[Number(n)] = Math.abs(value) / 20_000;
  return steps;
}

let bridges: Bridges;
beforeAll(async () => {
  bridges = new Bridges(await loadLibrary());
});
const shape = (name: string): number => bridges.arkitNames.indexOf(name);

describe('fromArkit', () => {
  it('makes the FAPs of the golden vectors', () => {
    for (const { coefficients, faps } of vectors.in) {
      const steps = finestSteps(faps);
      const { frame } = bridges.fromArkit(coefficients, steps);
      for (let n = 3; n <= 68; ++n) {
        const expected = faps[n];
        const made = frame.levels[n]! * steps[n]!;
        // Left out of the vectors: 0, or held against a viseme by a step of at most 4.
        if (expected === undefined) expect(Math.abs(made), `FAP ${n}`).toBeLessThanOrEqual(4);
        else expect(Math.abs(made / expected - 1), `FAP ${n}`).toBeLessThanOrEqual(1e-4);
      }
    }
  });

  it('takes names, Live Link names and arrays', () => {
    const named = bridges.fromArkit({ jawOpen: 0.5 }).frame;
    expect(bridges.fromArkit({ JawOpen: 0.5 }).frame).toEqual(named);
    expect(bridges.fromArkit(bridges.arkitNames.map((name) => (name === 'jawOpen' ? 0.5 : 0))).frame).toEqual(named);
    expect(named.levels[3]).toBeGreaterThan(50);
    expect(named.viseme.select1).toBe(10);
    expect(bridges.arkitNames).toHaveLength(52);
  });

  it('clamps and counts, and refuses what is no number or no shape', () => {
    const over = bridges.fromArkit({ jawOpen: 2, browInnerUp: -1, mouthFunnel: 1 });
    expect(over.clamped).toBe(2);
    expect(over.frame).toEqual(bridges.fromArkit({ jawOpen: 1, mouthFunnel: 1 }).frame);
    expect(() => bridges.fromArkit({ jawOpen: NaN })).toThrow(/jawOpen is not a finite number/);
    expect(() => bridges.fromArkit({ jaw: 1 })).toThrow(/jaw is not one/);
    expect(() => bridges.fromArkit([1, 2, 3])).toThrow(RangeError);
  });

  it('parts the lips with the jaw and closes them again', () => {
    const open = bridges.fromArkit({ jawOpen: 1 }).frame;
    const shut = bridges.fromArkit({ jawOpen: 1, mouthClose: 1 }).frame;
    expect(open.levels[4]! + open.levels[5]!).toBeLessThan(-200);
    expect(shut.levels[4]! + shut.levels[5]!).toBeGreaterThanOrEqual(0);
  });
});

describe('toArkit', () => {
  it('reads the golden vectors', () => {
    for (const { faps, coefficients } of vectors.out) {
      const frame = neutralFrame();
      for (const [n, value] of Object.entries(faps)) frame.levels[Number(n)] = Math.sign(value) * 20_000;
      const read = bridges.toArkit(frame, finestSteps(faps));
      bridges.arkitNames.forEach((name, s) => {
        expect(Math.abs(read[s]! - (coefficients[name] ?? 0)), name).toBeLessThan(6e-4);
      });
    }
  });

  it('reads visemes and expressions too', () => {
    const a = neutralFrame();
    a.viseme = { select1: 10, select2: 0, blend: 63 };
    expect(bridges.toArkit(a)[shape('jawOpen')]).toBeGreaterThan(0.4);
    const joy = neutralFrame();
    joy.expression = { select1: 1, intensity1: 63, select2: 0, intensity2: 0 };
    expect(bridges.toArkit(joy)[shape('mouthSmileLeft')]).toBeGreaterThan(0.3);
  });

  it('gives back what went in', () => {
    const { frame } = bridges.fromArkit({ jawOpen: 0.6, eyeBlinkLeft: 1, browInnerUp: 0.5, mouthPucker: 0.3 });
    const back = bridges.toArkit(frame);
    expect(back[shape('jawOpen')]).toBeCloseTo(0.6, 1);
    expect(back[shape('eyeBlinkLeft')]).toBeCloseTo(1, 1);
    expect(back[shape('eyeBlinkRight')]).toBe(0);
    expect(back[shape('browInnerUp')]).toBeCloseTo(0.5, 1);
  });

  it('refuses steps that make a FAP infinite', () => {
    const frame = neutralFrame();
    frame.levels[3] = 1;
    expect(() => bridges.toArkit(frame, standardQuantizers.slice().fill(Infinity, 3, 4))).toThrow(RangeError);
  });
});

describe('oculus', () => {
  it('makes FAP 1 of the golden vectors', () => {
    for (const { weights, viseme } of vectors.oculus) expect(bridges.fromOculus(weights).frame.viseme).toEqual(viseme);
  });

  it('reads FAP 1 back as it is', () => {
    const frame = neutralFrame();
    frame.viseme = { select1: 10, select2: 1, blend: 42 };
    const read = bridges.toOculus(frame);
    expect(read[10]).toBeCloseTo(42 / 63, 5);
    expect(read[1]).toBeCloseTo(21 / 63, 5);
    expect(bridges.toOculus(neutralFrame())[0]).toBe(1);
    expect(bridges.oculusNames[10]).toBe('aa');
    expect(bridges.oculusNames).toHaveLength(15);
  });

  it('reads an open jaw as an open vowel', () => {
    const read = bridges.toOculus(bridges.fromArkit({ jawOpen: 1 }).frame);
    expect(Math.max(...read)).toBe(read[10]);
  });
});
