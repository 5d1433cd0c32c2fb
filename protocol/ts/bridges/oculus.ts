import { maxBlend, type FaceFrame } from '../face_frame.ts';
import { arkitSettings } from '../generated/arkit.ts';
import { faps as allFaps } from '../generated/mpeg4.ts';
import { standardQuantizers, type QuantizerSteps } from '../quantizers.ts';
import { axisDisplacements } from './axis_displacements.ts';
import { clamp, frameOf, neutralValues, valuesOf, type FaceValues } from './face_values.ts';

/** The visemes of Oculus Lipsync in their order, which is also the order of FAP 1's visemes. */
export const oculusNames = [
  'sil', 'PP', 'FF', 'TH', 'DD', 'kk', 'CH', 'SS', 'nn', 'RR', 'aa', 'E', 'ih', 'oh', 'ou',
] as const;
export const oculusCount = oculusNames.length;

const index = new Map(oculusNames.map((name, i) => [name.toLowerCase(), i]));
/** The index of a viseme by name, case-insensitive. */
export const findOculus = (name: string): number | undefined => index.get(name.toLowerCase());

/** All 15 weights in order, or some by name (the others are 0). */
export type OculusInput = ArrayLike<number> | Readonly<Record<string, number>>;
export interface FromOculus {
  frame: FaceFrame;
  /** Number of weights outside 0..1, which were clamped. */
  clamped: number;
}

/** Regularization of the fit towards the weights of FAP 1, square millimetres: ridge, and cost of any change. */
const trustInFap1 = 4;
const costOfChange = 5;
const sweeps = 60;

const unitNames = ['IRISD', 'ES', 'ENS', 'MNS', 'MW'];
const mouthFaps = allFaps.filter((fap) => fap.kind === 'translation' && [2, 6, 8].includes(fap.group));
const millimetres = mouthFaps.map(
  (fap) => (arkitSettings.millimetres[unitNames.indexOf(fap.unit!)]! / 1024) * (fap.number === 18 ? 0.3 : 1),
);
const units = oculusNames.map((_, select1) => {
  const values = neutralValues();
  values.viseme = { select1, select2: 0, blend: maxBlend };
  const moved = axisDisplacements(values);
  return mouthFaps.map((fap) => moved[fap.number]!);
});
const gram = units.map((a) =>
  units.map((b) => a.reduce((sum, value, i) => sum + value * b[i]! * millimetres[i]! * millimetres[i]!, 0)),
);

function weightsOf(input: OculusInput): { w: Float64Array; clamped: number } {
  const w = new Float64Array(oculusCount);
  if ('length' in input && typeof input.length === 'number') {
    if (input.length !== oculusCount) throw new RangeError(`must be ${oculusCount} weights, not ${input.length}`);
    w.set(input as ArrayLike<number>);
  } else {
    for (const [name, value] of Object.entries(input)) {
      const viseme = findOculus(name);
      if (viseme === undefined) throw new RangeError(`${name} is not one of the visemes ${oculusNames.join(' ')}`);
      w[viseme] = value;
    }
  }
  let clamped = 0;
  let sum = 0;
  for (let v = 0; v < oculusCount; ++v) {
    if (!Number.isFinite(w[v])) throw new RangeError(`${oculusNames[v]} is not a finite number`);
    if (w[v]! < 0 || w[v]! > 1) ++clamped;
    w[v] = clamp(w[v]!, 0, 1);
    if (v > 0) sum += w[v]!;
  }
  if (sum > 1) for (let v = 0; v < oculusCount; ++v) w[v]! /= sum;
  return { w, clamped };
}

/**
 * Converts weights to FAP 1, which holds two visemes whose weights sum to 1: the two strongest, if 1 minus their sum is
 * less than 1.41 times the weaker, else the strongest and silence. A sum over 1 is normalized. NaN, infinity, an
 * unknown name or a wrong number of weights throws RangeError.
 */
export function fromOculus(input: OculusInput, steps: QuantizerSteps = standardQuantizers): FromOculus {
  const { w, clamped } = weightsOf(input);
  let first = 0;
  let second = 0;
  for (let v = 1; v < oculusCount; ++v) {
    if (first === 0 || w[v]! > w[first]!) {
      second = first;
      first = v;
    } else if (second === 0 || w[v]! > w[second]!) {
      second = v;
    }
  }
  const lack = 1 - w[first]! - w[second]!;
  const pair = lack * lack < 2 * w[second]! * w[second]!;
  const share = pair ? Math.min((1 + w[first]! - w[second]!) / 2, 1) : w[first]!;
  const blend = Math.round(share * maxBlend);
  const values = neutralValues();
  if (blend > 0) values.viseme = { select1: first, select2: pair ? second : 0, blend };
  return { frame: frameOf(values, steps), clamped };
}

/** Like toOculus, for FAPs in FAP units. */
export function oculusOfValues(values: FaceValues): Float32Array {
  const said = new Float64Array(oculusCount);
  const { select1, select2, blend } = values.viseme;
  const share = Math.min(blend, maxBlend) / maxBlend;
  if (select1 < oculusCount) said[select1]! += share;
  if (select2 < oculusCount) said[select2]! += 1 - share;
  said[0] = 0;
  const displacement = axisDisplacements({ ...values, expression: neutralValues().expression });
  const left = mouthFaps.map((fap, i) => {
    let units_left = displacement[fap.number]!;
    for (let v = 1; v < oculusCount; ++v) units_left -= said[v]! * units[v]![i]!;
    return units_left * millimetres[i]!;
  });
  const slope = Float64Array.from(units, (of) => {
    let sum = 0;
    for (let i = 0; i < left.length; ++i) sum -= of[i]! * millimetres[i]! * left[i]!;
    return sum;
  });
  const w = said.slice();
  for (let sweep = 0; sweep < sweeps; ++sweep) {
    for (let v = 1; v < oculusCount; ++v) {
      const own = gram[v]![v]!;
      const stiff = own + trustInFap1;
      const change = (own * (w[v]! - said[v]!) - slope[v]!) / stiff;
      const worth = Math.max(Math.abs(change) - costOfChange / stiff, 0);
      const step = clamp(said[v]! + Math.sign(change) * worth, 0, 1) - w[v]!;
      w[v]! += step;
      for (let k = 1; k < oculusCount; ++k) slope[k]! += step * gram[v]![k]!;
    }
  }
  let sum = 0;
  for (let v = 1; v < oculusCount; ++v) sum += w[v]!;
  const result = Float32Array.from(w, (value) => (sum > 1 ? value / sum : value));
  result[0] = Math.max(1 - sum, 0);
  return result;
}

/** Weights of sum 1 that fit the mouth best: FAP 1's, modified by the low-level FAPs. Expressions are ignored. */
export function toOculus(frame: FaceFrame, steps: QuantizerSteps = standardQuantizers): Float32Array {
  return oculusOfValues(valuesOf(frame, steps));
}
