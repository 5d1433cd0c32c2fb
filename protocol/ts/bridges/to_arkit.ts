import { firstLowLevelFap, lastLowLevelFap, type FaceFrame } from '../face_frame.ts';
import { arkitSettings, arkitShapes } from '../generated/arkit.ts';
import { faps as allFaps } from '../generated/mpeg4.ts';
import { standardQuantizers, type QuantizerSteps } from '../quantizers.ts';
import {
  amount,
  arkitCount,
  eyes,
  fullTurn,
  jawOpen,
  lidsShut,
  lowerLidShut,
  mouthClose,
  tongueOut,
  type Eye,
} from './arkit_shapes.ts';
import { axisDisplacements } from './axis_displacements.ts';
import { clamp, valuesOf, type FaceValues } from './face_values.ts';

const mostSweeps = 40;
const leastStep = 1e-4;
const lidRounds = 16;
/** Regularization of a coefficient towards 0, square millimetres. */
const ridge = 0.05;

const unitNames = ['IRISD', 'ES', 'ENS', 'MNS', 'MW'];
const unitInterval = (value: number): number => clamp(value, 0, 1);

/** Millimetres per FAP unit on a usual head. FAP 18 (chin boss) has less weight: its range ends before the jaw's. */
const millimetres = new Float64Array(lastLowLevelFap + 1);
for (const fap of allFaps) {
  if (fap.kind !== 'translation') continue;
  millimetres[fap.number] = (arkitSettings.millimetres[unitNames.indexOf(fap.unit!)]! / 1024) * (fap.number === 18 ? 0.3 : 1);
}

const dot = (a: readonly number[], b: readonly number[]): number => {
  let sum = 0;
  for (let i = 0; i < a.length; ++i) sum += a[i]! * b[i]!;
  return sum;
};

const ownRule = new Set([
  tongueOut,
  ...eyes.flatMap((eye) => [eye.blink, eye.lookDown, eye.lookIn, eye.lookOut, eye.lookUp, eye.squint, eye.wide]),
]);
/** The FAPs of the fit: mouth, jaw, brows, cheeks and nose. */
const fittedFaps = allFaps
  .filter((fap) => fap.kind === 'translation' && [2, 4, 5, 8, 9].includes(fap.group))
  .map((fap) => fap.number);
const fittedShapes = Array.from({ length: arkitCount }, (_, s) => s).filter((s) => !ownRule.has(s));
/** The fit's columns; jawOpen and mouthClose are replaced by "parted" (jawOpen only) and "shut" (both). */
const columns = fittedShapes.map((s) =>
  fittedFaps.map((n) => millimetres[n]! * (amount(s, n) + (s === mouthClose ? amount(jawOpen, n) : 0))),
);
const mirrors = fittedShapes.map((s) => fittedShapes.indexOf(arkitShapes[s]!.mirror));
const gram = columns.map((a) => Float64Array.from(columns, (b) => dot(a, b)));

/** Coordinate descent on half the squared error + cost; the two sides of a pair are solved together. */
function solve(displacement: Float64Array): Float64Array {
  const wanted = fittedFaps.map((n) => millimetres[n]! * displacement[n]!);
  const x = new Float64Array(fittedShapes.length);
  const slope = Float64Array.from(fittedShapes, (s, i) => arkitShapes[s]!.cost - dot(columns[i]!, wanted));
  const stepOf = (i: number, stiff: number): number => unitInterval(x[i]! - (slope[i]! + ridge * x[i]!) / stiff) - x[i]!;
  const move = (i: number, step: number): void => {
    if (step === 0) return;
    x[i]! += step;
    const row = gram[i]!;
    for (let k = 0; k < x.length; ++k) slope[k]! += step * row[k]!;
  };
  for (let sweep = 0; sweep < mostSweeps; ++sweep) {
    let largest = 0;
    for (let i = 0; i < x.length; ++i) {
      const other = mirrors[i]!;
      if (other < i) continue;
      const stiff = gram[i]![i]! + ridge + (other !== i ? Math.abs(gram[i]![other]!) : 0);
      const step = stepOf(i, stiff);
      const otherStep = other !== i ? stepOf(other, stiff) : 0;
      move(i, step);
      move(other, otherStep);
      largest = Math.max(largest, Math.abs(step), Math.abs(otherStep));
    }
    if (largest < leastStep) break;
  }
  const result = new Float64Array(arkitCount);
  fittedShapes.forEach((s, i) => (result[s] = x[i]!));
  return result;
}

interface LidAmounts {
  upper: Float64Array;
  lower: Float64Array;
}
const lidAmounts: LidAmounts[] = eyes.map((eye) => ({
  upper: Float64Array.from(arkitShapes, (_, s) => amount(s, eye.upperLid)),
  lower: Float64Array.from(arkitShapes, (_, s) => amount(s, eye.lowerLid)),
}));

/** Blink, squint and wide from the positions of the two lids minus the effects of gaze and the other shapes. */
function readLids(eye: Eye, lids: LidAmounts, displacement: Float64Array, x: Float64Array): void {
  let upperGiven = 0;
  let lowerGiven = 0;
  for (let s = 0; s < arkitCount; ++s) {
    upperGiven += x[s]! * lids.upper[s]!;
    lowerGiven += x[s]! * lids.lower[s]!;
  }
  const upperWanted = displacement[eye.upperLid]!;
  let blink = 0;
  let squint = 0;
  let wide = 0;
  for (let round = 0; round < lidRounds; ++round) {
    const squinted = upperGiven + squint * lids.upper[eye.squint]!;
    wide = unitInterval((upperWanted - squinted) / lids.upper[eye.wide]!);
    const upper = squinted + wide * lids.upper[eye.wide]!;
    const lower = lowerGiven + squint * lids.lower[eye.squint]! + wide * lids.lower[eye.wide]!;
    const meet = Math.max(lower, lowerLidShut);
    const open = Math.max(lidsShut - meet - upper, lidsShut / 16);
    blink = unitInterval((upperWanted - upper) / open);
    const expected = lower + blink * (meet - lower);
    squint = unitInterval(squint + (0.8 * (displacement[eye.lowerLid]! - expected)) / lids.lower[eye.squint]!);
  }
  x[eye.blink] = blink;
  x[eye.squint] = squint;
  x[eye.wide] = wide;
}

function readGaze(eye: Eye, displacement: Float64Array, x: Float64Array): void {
  const out = (eye.outwards * displacement[eye.yaw]!) / fullTurn;
  const down = displacement[eye.pitch]! / fullTurn;
  x[eye.lookOut] = unitInterval(out);
  x[eye.lookIn] = unitInterval(-out);
  x[eye.lookDown] = unitInterval(down);
  x[eye.lookUp] = unitInterval(-down);
}

/** Like toArkit, for FAPs in FAP units. */
export function arkitOfValues(values: FaceValues): Float32Array {
  for (let n = firstLowLevelFap; n <= lastLowLevelFap; ++n) {
    if (!Number.isFinite(values.faps[n])) throw new RangeError(`FAP ${n} is not a finite number`);
  }
  const displacement = axisDisplacements(values);
  const x = solve(displacement);
  const shut = x[mouthClose]!;
  x[jawOpen] = Math.min(x[jawOpen]! + shut, 1);
  x[mouthClose] = Math.min(shut, x[jawOpen]!);
  x[tongueOut] = unitInterval(displacement[45]! / amount(tongueOut, 45));
  eyes.forEach((eye, side) => {
    readGaze(eye, displacement, x);
    readLids(eye, lidAmounts[side]!, displacement, x);
  });
  return Float32Array.from(x);
}

/** Converts a frame to ARKit's 52 coefficients in order, each in 0..1. Rules: core/bridges/README.md. */
export function toArkit(frame: FaceFrame, steps: QuantizerSteps = standardQuantizers): Float32Array {
  return arkitOfValues(valuesOf(frame, steps));
}
