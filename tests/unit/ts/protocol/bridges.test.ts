import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { findArkit } from '../../../../protocol/ts/bridges/arkit_shapes.ts';
import { neutralValues } from '../../../../protocol/ts/bridges/face_values.ts';
import { valuesFromArkit } from '../../../../protocol/ts/bridges/from_arkit.ts';
import { arkitOfValues } from '../../../../protocol/ts/bridges/to_arkit.ts';
import { neutralFrame } from '../../../../protocol/ts/face_frame.ts';
import {
  arkitNames,
  decodeJson,
  fromArkit,
  fromOculus,
  oculusNames,
  ProtocolError,
  toArkit,
  toOculus,
} from '../../../../protocol/ts/index.ts';

interface Vectors {
  in: { coefficients: Record<string, number>; faps: Record<string, number> }[];
  out: { faps: Record<string, number>; coefficients: Record<string, number> }[];
  oculus: { weights: number[]; viseme: { select1: number; select2: number; blend: number } }[];
}
const vectors = JSON.parse(
  readFileSync(new URL('../../../../protocol/vectors/bridges/bridges.json', import.meta.url), 'utf8'),
) as Vectors;

describe('fromArkit', () => {
  it('makes the FAPs of the golden vectors', () => {
    for (const { coefficients, faps } of vectors.in) {
      const { values } = valuesFromArkit(coefficients);
      for (let n = 3; n <= 68; ++n) {
        const expected = faps[n];
        // Left out of the vectors: 0, or held against a viseme by a step of at most 4.
        if (expected === undefined) expect(Math.abs(values.faps[n]!), `FAP ${n}`).toBeLessThanOrEqual(4);
        else expect(values.faps[n]! / expected, `FAP ${n}`).toBeCloseTo(1, 4);
      }
    }
  });

  it('takes names, Live Link names and arrays', () => {
    const named = fromArkit({ jawOpen: 0.5 }).frame;
    expect(fromArkit({ JawOpen: 0.5 }).frame).toEqual(named);
    expect(fromArkit(arkitNames.map((name) => (name === 'jawOpen' ? 0.5 : 0))).frame).toEqual(named);
    expect(named.levels[3]).toBeGreaterThan(50);
    expect(named.viseme.select1).toBe(10);
  });

  it('clamps and counts, and refuses what is no number or no shape', () => {
    const over = fromArkit({ jawOpen: 2, browInnerUp: -1, mouthFunnel: 1 });
    expect(over.clamped).toBe(2);
    expect(over.frame).toEqual(fromArkit({ jawOpen: 1, mouthFunnel: 1 }).frame);
    expect(() => fromArkit({ jawOpen: NaN })).toThrow(/jawOpen/);
    expect(() => fromArkit({ jaw: 1 })).toThrow(/jaw/);
    expect(() => fromArkit([1, 2, 3])).toThrow(RangeError);
  });

  it('parts the lips with the jaw and closes them again', () => {
    const open = fromArkit({ jawOpen: 1 }).frame;
    const shut = fromArkit({ jawOpen: 1, mouthClose: 1 }).frame;
    expect(open.levels[4]! + open.levels[5]!).toBeLessThan(-200);
    expect(shut.levels[4]! + shut.levels[5]!).toBeGreaterThanOrEqual(0);
  });
});

describe('toArkit', () => {
  it('reads the golden vectors', () => {
    for (const { faps, coefficients } of vectors.out) {
      const values = neutralValues();
      for (const [n, value] of Object.entries(faps)) values.faps[Number(n)] = value;
      const read = arkitOfValues(values);
      arkitNames.forEach((name, s) => {
        expect(Math.abs(read[s]! - (coefficients[name] ?? 0)), name).toBeLessThan(6e-4);
      });
    }
  });

  it('reads visemes and expressions too', () => {
    const a = neutralFrame();
    a.viseme = { select1: 10, select2: 0, blend: 63 };
    expect(toArkit(a)[findArkit('jawOpen')!]).toBeGreaterThan(0.4);
    const joy = neutralFrame();
    joy.expression = { select1: 1, intensity1: 63, select2: 0, intensity2: 0 };
    expect(toArkit(joy)[findArkit('mouthSmileLeft')!]).toBeGreaterThan(0.3);
  });

  it('gives back what went in', () => {
    const back = toArkit(fromArkit({ jawOpen: 0.6, eyeBlinkLeft: 1, browInnerUp: 0.5, mouthPucker: 0.3 }).frame);
    expect(back[findArkit('jawOpen')!]).toBeCloseTo(0.6, 1);
    expect(back[findArkit('eyeBlinkLeft')!]).toBeCloseTo(1, 1);
    expect(back[findArkit('eyeBlinkRight')!]).toBe(0);
    expect(back[findArkit('browInnerUp')!]).toBeCloseTo(0.5, 1);
  });
});

describe('oculus', () => {
  it('makes FAP 1 of the golden vectors', () => {
    for (const { weights, viseme } of vectors.oculus) expect(fromOculus(weights).frame.viseme).toEqual(viseme);
  });

  it('reads FAP 1 back as it is', () => {
    const frame = neutralFrame();
    frame.viseme = { select1: 10, select2: 1, blend: 42 };
    const read = toOculus(frame);
    expect(read[10]).toBeCloseTo(42 / 63, 5);
    expect(read[1]).toBeCloseTo(21 / 63, 5);
    expect(toOculus(neutralFrame())[0]).toBe(1);
    expect(oculusNames[10]).toBe('aa');
  });

  it('reads an open jaw as an open vowel', () => {
    const read = toOculus(fromArkit({ jawOpen: 1 }).frame);
    expect(Math.max(...read)).toBe(read[10]);
  });
});

describe('JSON form', () => {
  const stateOf = (members: object) => {
    const message = decodeJson(JSON.stringify({ type: 'keyframe', state: members }));
    if (message.type !== 'keyframe') throw new Error('not a keyframe');
    return message.state;
  };
  const refusalOf = (members: object) => {
    try {
      stateOf(members);
    } catch (error) {
      if (error instanceof ProtocolError) return { where: error.where, code: error.code };
    }
    return undefined;
  };

  it('takes arkit and oculus; explicit members win', () => {
    expect(stateOf({ arkit: { jawOpen: 0.5 } })).toEqual(fromArkit({ jawOpen: 0.5 }).frame);
    const mixed = stateOf({ arkit: { jawOpen: 0.5 }, faps: { 5: 200 }, viseme: { select1: 1 } });
    expect(mixed.levels[5]).toBe(100);
    expect(mixed.levels[3]).toBe(fromArkit({ jawOpen: 0.5 }).frame.levels[3]);
    expect(mixed.viseme).toEqual({ select1: 1, select2: 0, blend: 63 });
    expect(stateOf({ oculus: { aa: 1 } }).viseme).toEqual({ select1: 10, select2: 0, blend: 63 });
    expect(stateOf({ arkit: { headYaw: 0.5 } }).levels[49]).toBe(Math.round(-50000 / 170));
  });

  it('refuses what is wrong at its place', () => {
    expect(refusalOf({ arkit: { jaw: 1 } })).toEqual({ where: '/state/arkit/jaw', code: 'invalid_argument' });
    expect(refusalOf({ arkit: [1] })).toEqual({ where: '/state/arkit', code: 'out_of_range' });
    expect(refusalOf({ oculus: { aa: 1 }, viseme: { select1: 1 } })).toEqual({
      where: '/state/oculus',
      code: 'invalid_argument',
    });
  });
});
