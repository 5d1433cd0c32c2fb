import { lastLowLevelFap, maxBlend, type FaceFrame } from '../face_frame.ts';
import { arkitSettings, arkitShapes } from '../generated/arkit.ts';
import { faps as allFaps } from '../generated/mpeg4.ts';
import { standardQuantizers, type QuantizerSteps } from '../quantizers.ts';
import {
  amount,
  arkitCount,
  arkitNames,
  eyes,
  findArkit,
  fullTurn,
  jawOpen,
  lidsShut,
  lowerLidShut,
  mouthClose,
  mouthFunnel,
  mouthPucker,
  tongueOut,
  type Eye,
} from './arkit_shapes.ts';
import { axisDisplacements } from './axis_displacements.ts';
import { clamp, frameOf, neutralValues, type FaceValues } from './face_values.ts';

/** All 52 coefficients in order, or some by name (the others are 0). */
export type ArkitInput = ArrayLike<number> | Readonly<Record<string, number>>;

export interface FromArkit {
  frame: FaceFrame;
  /** Number of coefficients outside 0..1, which were clamped. */
  clamped: number;
}

function coefficientsOf(input: ArkitInput): { c: Float64Array; clamped: number } {
  const c = new Float64Array(arkitCount);
  if ('length' in input && typeof input.length === 'number') {
    if (input.length !== arkitCount) throw new RangeError(`must be ${arkitCount} coefficients, not ${input.length}`);
    c.set(input as ArrayLike<number>);
  } else {
    for (const [name, value] of Object.entries(input)) {
      const shape = findArkit(name);
      if (shape === undefined) throw new RangeError(`${name} is not a shape of ARKit`);
      c[shape] = value;
    }
  }
  let clamped = 0;
  for (let s = 0; s < arkitCount; ++s) {
    if (!Number.isFinite(c[s])) throw new RangeError(`${arkitNames[s]} is not a finite number`);
    if (c[s]! < 0 || c[s]! > 1) ++clamped;
    c[s] = clamp(c[s]!, 0, 1);
  }
  return { c, clamped };
}

/** Limits mouthClose to jawOpen, and raises jawOpen where tongueOut needs an open mouth. */
function settleTheMouth(c: Float64Array): void {
  const closed = Math.min(c[mouthClose]!, c[jawOpen]!);
  const parted = Math.max(c[jawOpen]! - closed, arkitSettings.tongue_parting * c[tongueOut]!);
  c[mouthClose] = closed;
  c[jawOpen] = closed + parted;
}

/** A blink moves the lids from their current position to the closed position. */
function closeLids(eye: Eye, c: Float64Array, faps: Float64Array): void {
  const crossed = Math.max(faps[eye.upperLid]! + faps[eye.lowerLid]! - lidsShut, 0);
  let upper = faps[eye.upperLid]! - crossed / 2;
  let lower = faps[eye.lowerLid]! - crossed / 2;
  const blink = c[eye.blink]!;
  const meet = Math.max(lower, lowerLidShut);
  upper += blink * (lidsShut - meet - upper);
  lower += blink * (meet - lower);
  faps[eye.upperLid] = upper;
  faps[eye.lowerLid] = lower;
}

function turnEye(eye: Eye, c: Float64Array, faps: Float64Array): void {
  faps[eye.yaw] = eye.outwards * (c[eye.lookOut]! - c[eye.lookIn]!) * fullTurn;
  faps[eye.pitch] = (c[eye.lookDown]! - c[eye.lookUp]!) * fullTurn;
}

/** Limits how far the lips press into each other when several shapes close them. */
function stopLips(faps: Float64Array): void {
  for (const [upper, lower] of [[4, 5], [8, 10], [9, 11]] as const) {
    const over = Math.max(faps[upper]! + faps[lower]! - arkitSettings.lip_overlap, 0);
    faps[upper]! -= over / 2;
    faps[lower]! -= over / 2;
  }
}

const visemeA = 10;
const visemeU = 14;

function ofViseme(select1: number, blend: number): Float64Array {
  const values = neutralValues();
  values.viseme = { select1, select2: 0, blend };
  return axisDisplacements(values);
}
const open = ofViseme(visemeA, maxBlend)[3]!;
const forward = ofViseme(visemeU, maxBlend)[16]!;

/** Uses FAP 1 for motion without a low-level FAP: "a" for an open jaw or "u" for protruded lips, the stronger one. */
function carryByViseme(c: Float64Array, faps: Float64Array, values: FaceValues): void {
  const share = (part: number, full: number): number => (full > 0 ? clamp(part / full, 0, 1) : 0);
  const pushed = c[mouthPucker]! * amount(mouthPucker, 16) + c[mouthFunnel]! * amount(mouthFunnel, 16);
  // An "a" also parts the lips at points without a FAP; with closed lips it only lowers the chin, a little.
  const shut = c[jawOpen]! > 0 ? c[mouthClose]! / c[jawOpen]! : 0;
  const carried = 1 - (1 - arkitSettings.carried_when_shut) * shut;
  const moreOpen = carried * share(faps[3]!, open) - share(pushed, forward);
  const blend = Math.round(Math.abs(moreOpen) * maxBlend);
  if (blend === 0) return;
  values.viseme = { select1: moreOpen > 0 ? visemeA : visemeU, select2: 0, blend };
}

/** Sets the smallest level for FAPs that only the viseme would move: a FAP of 0 would not override the viseme. */
function holdAgainstViseme(values: FaceValues): void {
  if (values.viseme.blend === 0) return;
  const moved = ofViseme(values.viseme.select1, values.viseme.blend);
  for (const fap of allFaps) {
    if (fap.kind !== 'translation' || fap.group === 6 || moved[fap.number] === 0) continue;
    if (Math.abs(values.faps[fap.number]!) < fap.quantizerStep) values.faps[fap.number] = fap.quantizerStep;
  }
}

/** Like fromArkit, in FAP units. */
export function valuesFromArkit(input: ArkitInput): { values: FaceValues; clamped: number } {
  const { c, clamped } = coefficientsOf(input);
  settleTheMouth(c);
  const sum = new Float64Array(lastLowLevelFap + 1);
  arkitShapes.forEach((shape, s) => {
    for (const [fap, value] of shape.faps) sum[fap]! += c[s]! * value;
  });
  for (const eye of eyes) {
    closeLids(eye, c, sum);
    turnEye(eye, c, sum);
  }
  stopLips(sum);
  const values = neutralValues();
  for (const fap of allFaps) {
    // float32, as in all implementations.
    if (fap.number > 2) values.faps[fap.number] = Math.fround(clamp(sum[fap.number]!, fap.min, fap.max));
  }
  carryByViseme(c, sum, values);
  holdAgainstViseme(values);
  return { values, clamped };
}

/**
 * Converts ARKit's coefficients to a frame for any head. Values outside 0..1 are clamped and counted; NaN, infinity, an
 * unknown name or a wrong number of coefficients throws RangeError. Rules: core/bridges/README.md.
 */
export function fromArkit(input: ArkitInput, steps: QuantizerSteps = standardQuantizers): FromArkit {
  const { values, clamped } = valuesFromArkit(input);
  return { frame: frameOf(values, steps), clamped };
}
