import {
  largestEyeTurnDegrees,
  shutLidUnits,
  usualRamps,
  type Cue,
  type Easing,
  type PerformanceScript,
} from '../../protocol/ts/performance_document.ts';
import { maxBlend, neutralFrame, type FaceFrame } from '../../protocol/ts/face_frame.ts';
import { quantize, standardQuantizers, type QuantizerSteps } from '../../protocol/ts/quantizers.ts';
import { idleAt, smoothStep } from './idle.ts';

/** The face at one moment, in FAP units. */
export interface PerformedFace {
  viseme: FaceFrame['viseme'];
  expression: FaceFrame['expression'];
  /** by FAP number */
  faps: Float64Array;
}

const unitsPerDegree = 1745.3292519943296; // AU: 1e-5 rad
const { yaw: largestEyeYaw, pitch: largestEyePitch } = largestEyeTurnDegrees;
const upperLidUnits = shutLidUnits.upper;
const lowerLidUnits = shutLidUnits.lower;
const headRamp = usualRamps.head[0];

/** The playback span of a cue; `held` when the next cue on its target takes over from it. */
interface Span {
  cue: Cue;
  end: number;
  held: boolean;
}

/** The contribution of a look cue, degrees: gaze, convergence of each eye, and the slower turn of the head. */
interface LookOffset {
  yaw: number;
  pitch: number;
  eyeYaw: [number, number];
  eyePitch: [number, number];
  headYaw: number;
  headPitch: number;
  headAttack: number;
  headRelease: number;
}

/**
 * A performance played locally: the face as a function of time by the rules of section 9 of SPEC.md, with the same
 * results as the server. Any time may be requested; increasing times are fastest.
 */
export class Performance {
  readonly script: PerformanceScript;
  private readonly tracks = new Map<string, Span[]>();
  private readonly longest = new Map<string, number>();
  private readonly looks = new Map<Cue, LookOffset>();

  constructor(script: PerformanceScript) {
    this.script = script;
    for (const cue of script.cues) {
      for (const name of tracksOf(cue)) {
        const track = this.tracks.get(name) ?? [];
        track.push({ cue, end: cue.time + cue.duration, held: false });
        this.tracks.set(name, track);
      }
      if (cue.target.kind === 'look_at') this.looks.set(cue, wayOf(cue));
    }
    for (const [name, track] of this.tracks) {
      for (let i = 0; i < track.length; ++i) this.hold(track, i);
      this.longest.set(
        name,
        track.reduce((most, { cue, end }) => Math.max(most, end - cue.time), 0),
      );
    }
  }

  /** Duration, ms; 0 for an endless performance. */
  get duration(): number {
    return this.script.duration;
  }

  /** The face at `ms` after the start; `idleMs` is the time of idle life, which a loop of the cues does not restart. */
  at(ms: number, idleMs = ms): PerformedFace {
    const faps = new Float64Array(69);
    const { idle } = this.script;
    const alone = idle ? idleAt(idle, idleMs) : null;
    this.setGaze(faps, ms, alone);
    for (const name of this.tracks.keys()) {
      if (!name.startsWith('fap ')) continue;
      const fap = Number(name.slice(4));
      this.visit(name, ms, ({ cue }, weight) => (faps[fap] = over(faps[fap]!, weight, valueOf(cue, ms))));
    }
    for (const eye of [0, 1]) {
      let lid = 0;
      this.visit(`blink ${eye}`, ms, ({ cue }, weight) => (lid = over(lid, clamp01(weight), valueOf(cue, ms))));
      lid = Math.max(lid, alone?.lidClosure ?? 0);
      if (lid <= 0) continue;
      faps[19 + eye] = over(faps[19 + eye]!, lid, upperLidUnits);
      faps[21 + eye] = over(faps[21 + eye]!, lid, lowerLidUnits);
    }
    return { viseme: this.viseme(ms), expression: this.expression(ms), faps };
  }

  /** The face as the frame that a stream would send. */
  frameAt(ms: number, idleMs = ms, steps: QuantizerSteps = standardQuantizers): FaceFrame {
    const { viseme, expression, faps } = this.at(ms, idleMs);
    const frame = neutralFrame();
    for (let n = 3; n < faps.length; ++n) {
      frame.levels[n] = quantize(faps[n]!, steps[n]!) ?? Math.sign(faps[n]!) * 32767;
    }
    return { ...frame, viseme, expression };
  }

  private arrival(cue: Cue): number {
    return Math.max(cue.attack, this.looks.get(cue)?.headAttack ?? 0);
  }

  /** Marks cue `i` as held if the next cue starts before the end of its release and ends later than it. */
  private hold(track: Span[], i: number): void {
    const span = track[i]!;
    const { end } = span;
    for (let j = i + 1, seen = 0; j < track.length && track[j]!.cue.time <= end; ++j) {
      if (++seen > 128) return;
      const next = track[j]!.cue;
      const arrived = next.time + this.arrival(next);
      if (next.time + next.duration <= end || arrived <= end - span.cue.release) continue;
      span.end = arrived;
      span.held = true;
      return;
    }
  }

  private visit(name: string, ms: number, f: (span: Span, weight: number) => void): void {
    const track = this.tracks.get(name);
    if (!track) return;
    let low = 0;
    let high = track.length;
    const earliest = ms - this.longest.get(name)!;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (track[middle]!.cue.time < earliest) low = middle + 1;
      else high = middle;
    }
    for (let i = low; i < track.length && track[i]!.cue.time <= ms; ++i) {
      const span = track[i]!;
      if (ms < span.end) f(span, weightOf(span, ms, span.cue.attack, span.cue.release));
    }
  }

  private viseme(ms: number): FaceFrame['viseme'] {
    const weights = new Float64Array(15);
    weights[0] = 1;
    let pair: { viseme: number; other: number } | null = null;
    let share = 0;
    let whole = false;
    this.visit('viseme', ms, ({ cue }, given) => {
      if (cue.target.kind !== 'viseme') return;
      const weight = clamp01(given);
      pair = cue.target;
      share = clamp01(valueOf(cue, ms));
      whole = weight >= 1;
      for (let v = 0; v < weights.length; ++v) weights[v]! *= 1 - weight;
      weights[cue.target.viseme]! += weight * share;
      weights[cue.target.other]! += weight * (1 - share);
    });
    const none = { select1: 0, select2: 0, blend: 0 };
    if (!pair) return none;
    const only = pair as { viseme: number; other: number };
    if (whole) return { select1: only.viseme, select2: only.other, blend: sixtyThirds(share) };
    let [first, second] = strongestTwo(weights, 0);
    if (first === 0) [first, second] = [second, first];
    if (weights[first]! <= 0) return none;
    share = weights[first]! / (weights[first]! + weights[second]!);
    return { select1: first, select2: weights[second]! > 0 ? second : 0, blend: sixtyThirds(share) };
  }

  private expression(ms: number): FaceFrame['expression'] {
    const intensity = new Float64Array(7);
    for (let e = 1; e < intensity.length; ++e) {
      this.visit(`expression ${e}`, ms, ({ cue }, weight) => {
        intensity[e] = over(intensity[e]!, clamp01(weight), valueOf(cue, ms));
      });
    }
    let first = 0;
    let second = 0;
    for (let e = 1; e < intensity.length; ++e) {
      if (intensity[e]! > intensity[first]!) [first, second] = [e, first];
      else if (intensity[e]! > intensity[second]!) second = e;
    }
    const intensity1 = sixtyThirds(intensity[first]!);
    const intensity2 = sixtyThirds(intensity[second]!);
    return { select1: intensity1 > 0 ? first : 0, intensity1, select2: intensity2 > 0 ? second : 0, intensity2 };
  }

  private setGaze(faps: Float64Array, ms: number, idle: ReturnType<typeof idleAt> | null): void {
    let yaw = 0;
    let pitch = 0;
    let held = 0;
    let headYaw = 0;
    let headPitch = 0;
    const eyeYaw = [0, 0];
    const eyePitch = [0, 0];
    this.visit('look', ms, (span, weight) => {
      const look = this.looks.get(span.cue)!;
      const slow = weightOf(span, ms, look.headAttack, look.headRelease);
      yaw = over(yaw, weight, look.yaw);
      pitch = over(pitch, weight, look.pitch);
      held = over(held, weight, 1);
      for (const eye of [0, 1]) {
        eyeYaw[eye] = over(eyeYaw[eye]!, weight, look.eyeYaw[eye]!);
        eyePitch[eye] = over(eyePitch[eye]!, weight, look.eyePitch[eye]!);
      }
      headPitch = over(headPitch, slow, look.headPitch);
      headYaw = over(headYaw, slow, look.headYaw);
    });
    const turn = [0, 0, 0];
    this.visit('head', ms, ({ cue }, weight) => {
      if (cue.target.kind !== 'head') return;
      turn[0] = over(turn[0]!, weight, cue.target.pitch);
      turn[1] = over(turn[1]!, weight, cue.target.yaw);
      turn[2] = over(turn[2]!, weight, cue.target.roll);
    });
    for (const eye of [0, 1]) {
      const aside = eyeYaw[eye]! + yaw - headYaw - held * turn[1]! + (idle?.eyeYaw ?? 0);
      const down = eyePitch[eye]! + pitch - headPitch - held * turn[0]! + (idle?.eyePitch ?? 0);
      faps[23 + eye] = unitsPerDegree * Math.max(-largestEyeYaw, Math.min(largestEyeYaw, aside));
      faps[25 + eye] = unitsPerDegree * Math.max(-largestEyePitch, Math.min(largestEyePitch, down));
    }
    faps[48] = unitsPerDegree * (headPitch + turn[0]! + (idle?.headPitch ?? 0));
    faps[49] = unitsPerDegree * (headYaw + turn[1]! + (idle?.headYaw ?? 0));
    faps[50] = unitsPerDegree * (turn[2]! + (idle?.headRoll ?? 0));
  }
}

function tracksOf({ target }: Cue): string[] {
  switch (target.kind) {
    case 'fap':
      return [`fap ${target.fap}`];
    case 'expression':
      return [`expression ${target.expression}`];
    case 'blink':
      return [...(target.left ? ['blink 0'] : []), ...(target.right ? ['blink 1'] : [])];
    case 'look_at':
      return ['look'];
    default:
      return [target.kind];
  }
}

function wayOf(cue: Cue): LookOffset {
  if (cue.target.kind !== 'look_at') throw new TypeError('the target of the cue is not look_at');
  const { yaw, pitch, distance, headShare } = cue.target;
  const look: LookOffset = {
    yaw,
    pitch,
    eyeYaw: [0, 0],
    eyePitch: [0, 0],
    headYaw: headShare * yaw,
    headPitch: headShare * pitch,
    headAttack: Math.min(Math.max(cue.attack, headRamp), 0.5 * cue.duration),
    headRelease: Math.min(Math.max(cue.release, headRamp), 0.5 * cue.duration),
  };
  if (!Number.isFinite(distance)) return look;
  const perRadian = 180 / Math.PI;
  const [a, b] = [yaw / perRadian, pitch / perRadian];
  const z = distance * Math.cos(b) * Math.cos(a);
  for (const eye of [0, 1] as const) {
    const x = distance * Math.cos(b) * Math.sin(a) - (eye === 0 ? 0.5 : -0.5);
    look.eyeYaw[eye] = Math.atan2(x, z) * perRadian - yaw;
    look.eyePitch[eye] = Math.atan2(distance * Math.sin(b), Math.hypot(x, z)) * perRadian - pitch;
  }
  return look;
}

function weightOf({ cue, end, held }: Span, ms: number, attack: number, release: number): number {
  if (ms < cue.time || ms >= end) return 0;
  const since = ms - cue.time;
  const rise = attack > 0 ? ease(cue.easing, since / attack) : 1;
  return held || release <= 0 ? rise : rise * ease(cue.easing, (cue.duration - since) / release);
}

function valueOf({ time, keys, value, easing }: Cue, ms: number): number {
  if (keys.length === 0) return value;
  const since = ms - time;
  let low = 0;
  let high = keys.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (keys[middle]![0] <= since) low = middle + 1;
    else high = middle;
  }
  if (low === 0) return keys[0]![1];
  const [from, below] = keys[low - 1]!;
  if (low === keys.length || easing === 'step') return below;
  const [to, above] = keys[low]!;
  return below + ease(easing, (since - from) / (to - from)) * (above - below);
}

/** The easing function: maps progress 0..1 to 0..1. */
export function ease(easing: Easing, x: number): number {
  if (easing === 'step' || x >= 1) return 1;
  if (x <= 0) return 0;
  switch (easing) {
    case 'linear':
      return x;
    case 'ease_in':
      return x * x;
    case 'ease_out':
      return 1 - (1 - x) * (1 - x);
    case 'ease_in_out':
      return smoothStep(x);
    default: {
      const [x1, y1, x2, y2] = easing;
      let low = 0;
      let high = 1;
      for (let round = 0; round < 40; ++round) {
        const middle = 0.5 * (low + high);
        if (bezier(x1, x2, middle) < x) low = middle;
        else high = middle;
      }
      return bezier(y1, y2, 0.5 * (low + high));
    }
  }
}

function bezier(a: number, b: number, s: number): number {
  const r = 1 - s;
  return 3 * r * r * s * a + 3 * r * s * s * b + s * s * s;
}

function strongestTwo(weights: Float64Array, from: number): [number, number] {
  let first = from;
  let second = from + 1;
  if (weights[second]! > weights[first]!) [first, second] = [second, first];
  for (let i = from + 2; i < weights.length; ++i) {
    if (weights[i]! > weights[first]!) [first, second] = [i, first];
    else if (weights[i]! > weights[second]!) second = i;
  }
  return [first, second];
}

function over(below: number, weight: number, value: number): number {
  return below + weight * (value - below);
}

function clamp01(x: number): number {
  return Math.max(0, Math.min(1, x));
}

function sixtyThirds(share: number): number {
  return Math.round(maxBlend * clamp01(share));
}
