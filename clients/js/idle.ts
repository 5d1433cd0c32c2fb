import type { IdleLife } from '../../protocol/ts/performance_document.ts';

/** The motion that idle life adds at one moment. Degrees, with the signs of the FAPs; lid closure 0..1. */
export interface IdleMotion {
  lidClosure: number;
  eyeYaw: number;
  eyePitch: number;
  headPitch: number;
  headYaw: number;
  headRoll: number;
}

// The same numbers as in core/performance/idle.cpp; the golden frames test both.
const glanceYaw = 7;
const glancePitch = 3.5;
const driftPitch = 3;
const driftYaw = 5;
const driftRoll = 2;
const glanceInterval = 1100;
const glanceJump = 45;
const blinkClosing = 80;
const blinkOpening = 160;
const eventsPerBlock = 16;
const channel = { blinkGaps: 0, glanceGaps: 1, glanceYaws: 2, glancePitches: 3, firstDrift: 4 } as const;

/** x^2 (3 - 2x), clamped. */
export function smoothStep(x: number): number {
  const s = Math.max(0, Math.min(1, x));
  return s * s * (3 - 2 * s);
}

function mix(x: number): number {
  x ^= x >>> 16;
  x = Math.imul(x, 0x7feb352d);
  x ^= x >>> 15;
  x = Math.imul(x, 0x846ca68b);
  return (x ^ (x >>> 16)) >>> 0;
}

/** A pseudo-random number 0..1 from a seed and indices. */
function uniform(seed: number, of: number, block: number, index: number): number {
  const base = mix((seed + Math.imul(of, 0x9e3779b9)) >>> 0);
  return mix((mix((base + block) >>> 0) + index) >>> 0) / 4294967296;
}

interface Event {
  block: number;
  index: number;
  /** ms since the event */
  since: number;
}

function newestEvent(seed: number, of: number, mean: number, ms: number): Event {
  const length = mean * eventsPerBlock;
  const number = Math.floor(ms / length);
  const block = number % 4294967296;
  const gaps: number[] = [];
  let sum = 0;
  for (let i = 0; i < eventsPerBlock; ++i) {
    const u = uniform(seed, of, block, i);
    gaps.push(0.25 + 2.25 * u * u);
    sum += gaps[i]!;
  }
  const within = ms - number * length;
  let at = 0;
  let index = 0;
  for (; index + 1 < eventsPerBlock; ++index) {
    const next = at + (gaps[index]! / sum) * length;
    if (within < next) break;
    at = next;
  }
  return { block, index, since: Math.max(0, within - at) };
}

function closureAt(idle: IdleLife, ms: number): number {
  if (idle.blinksPerMinute <= 0) return 0;
  const mean = 60_000 / idle.blinksPerMinute;
  if (!Number.isFinite(mean * eventsPerBlock)) return 0; // a rate so small that no event ever occurs
  const blink = newestEvent(idle.seed, channel.blinkGaps, mean, ms);
  if (blink.block === 0 && blink.index === 0) return 0;
  if (blink.since < blinkClosing) return smoothStep(blink.since / blinkClosing);
  return smoothStep(1 - (blink.since - blinkClosing) / blinkOpening);
}

function aim(seed: number, of: number, block: number, index: number): number {
  const u = 2 * uniform(seed, of, block >>> 0, index) - 1;
  return u * Math.abs(u);
}

function glanceAt(idle: IdleLife, event: Event, of: number): number {
  const now = aim(idle.seed, of, event.block, event.index);
  const before =
    event.index === 0
      ? aim(idle.seed, of, event.block - 1, eventsPerBlock - 1)
      : aim(idle.seed, of, event.block, event.index - 1);
  return before + (now - before) * smoothStep(event.since / glanceJump);
}

function noise(seed: number, of: number, period: number, ms: number): number {
  const cell = Math.floor(ms / period);
  const x = ms / period - cell;
  const number = cell % 4294967296;
  const a = 2 * uniform(seed, of, number, 0) - 1;
  const b = 2 * uniform(seed, of, (number + 1) >>> 0, 0) - 1;
  return a + (b - a) * (x * x * x * (x * (x * 6 - 15) + 10));
}

function drift(idle: IdleLife, of: number, ms: number): number {
  return 0.7 * noise(idle.seed, of, 2900, ms) + 0.3 * noise(idle.seed, of + 1, 1300, ms);
}

/** Idle motion at a time (ms, not negative): a pure function, the same as in core/performance/idle.h. */
export function idleAt(idle: IdleLife, time: number): IdleMotion {
  const ms = Math.max(time, 0);
  const motion: IdleMotion = {
    lidClosure: closureAt(idle, ms),
    eyeYaw: 0,
    eyePitch: 0,
    headPitch: 0,
    headYaw: 0,
    headRoll: 0,
  };
  if (idle.head > 0) {
    motion.headPitch = idle.head * driftPitch * drift(idle, channel.firstDrift, ms);
    motion.headYaw = idle.head * driftYaw * drift(idle, channel.firstDrift + 2, ms);
    motion.headRoll = idle.head * driftRoll * drift(idle, channel.firstDrift + 4, ms);
    motion.eyePitch = -motion.headPitch;
    motion.eyeYaw = -motion.headYaw;
  }
  if (idle.eyes > 0) {
    const glance = newestEvent(idle.seed, channel.glanceGaps, glanceInterval, ms);
    motion.eyeYaw += idle.eyes * glanceYaw * glanceAt(idle, glance, channel.glanceYaws);
    motion.eyePitch += idle.eyes * glancePitch * glanceAt(idle, glance, channel.glancePitches);
  }
  return motion;
}
