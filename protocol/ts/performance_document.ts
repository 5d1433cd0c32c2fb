import { faps, expressions, visemes } from './generated/mpeg4.ts';
import { JsonCursor, parseJsonObject } from './json_cursor.ts';

export type EasingName = 'linear' | 'ease_in' | 'ease_out' | 'ease_in_out' | 'step';
/** x1, y1, x2, y2: a cubic Bezier curve from (0, 0) to (1, 1) */
export type Easing = EasingName | readonly [number, number, number, number];

/** The target of a cue, with numbers in place of names. Degrees as in section 9 of SPEC.md. */
export type CueTarget =
  | { kind: 'fap'; fap: number }
  | { kind: 'viseme'; viseme: number; other: number }
  | { kind: 'expression'; expression: number }
  | { kind: 'look_at'; yaw: number; pitch: number; distance: number; headShare: number }
  | { kind: 'blink'; left: boolean; right: boolean }
  | { kind: 'head'; pitch: number; yaw: number; roll: number };

/** A cue with all defaults filled in. Times in ms. */
export interface Cue {
  time: number;
  duration: number;
  attack: number;
  release: number;
  easing: Easing;
  target: CueTarget;
  value: number;
  /** [ms after time, value]; empty: `value` */
  keys: readonly (readonly [number, number])[];
}

export interface IdleLife {
  seed: number;
  blinksPerMinute: number;
  head: number;
  eyes: number;
}

export interface PerformanceScript {
  name: string;
  /** Duration, ms; 0: idle life only, endless. */
  duration: number;
  idle: IdleLife | null;
  cues: readonly Cue[];
}

const maxBytes = 16 * 1024 * 1024;
const maxCues = 100_000;
const maxKeys = 1_000_000;
const maxMs = 86_400_000;
const maxText = 1000;
const targetNames = ['fap', 'viseme', 'expression', 'look_at', 'blink', 'head'] as const;
const easingNames: readonly string[] = ['linear', 'ease_in', 'ease_out', 'ease_in_out', 'step'];
/** Default attack and release of a cue, ms. */
export const usualRamps = {
  fap: [100, 100],
  viseme: [70, 70],
  expression: [300, 500],
  look_at: [80, 80],
  blink: [80, 160],
  head: [400, 400],
} as const;
/** Where performances shut the lids, FAP units: FAPs 19 and 20, 21 and 22. */
export const shutLidUnits = { upper: 940, lower: 84 } as const;
/** How far performances turn an eye: sideways, and up or down. */
export const largestEyeTurnDegrees = { yaw: 45, pitch: 35 } as const;
const blinkMs = usualRamps.blink[0] + usualRamps.blink[1];

/**
 * Reads a performance document. Throws ProtocolError with the JSON pointer. Unlike the server it does not detect
 * duplicate members, and it does not limit the number of simultaneous cues.
 */
export function readPerformance(text: string): PerformanceScript {
  const root = parseJsonObject(text, maxBytes);
  known(root, ['format', 'version', 'name', 'note', 'duration', 'idle', 'cues']);
  const format = root.member('format');
  if (format.text(64) !== 'semblante.performance') format.fail('unsupported', 'must be "semblante.performance"');
  const version = root.member('version');
  if (version.number() !== 1) version.fail('unsupported', 'the supported version is 1');
  root.optional('note')?.text(maxText);
  const idle = readIdle(root.optional('idle'));
  const list = idle ? root.optional('cues') : root.member('cues');
  const cues: Cue[] = [];
  let end = 0;
  let before = 0;
  let keys = 0;
  for (const at of list?.elements(0, maxCues) ?? []) {
    const cue = readCue(at);
    if (cue.time < before) at.member('time').fail('out_of_range', `is out of order: ${cue.time} after ${before}`);
    before = cue.time;
    end = Math.max(end, cue.time + cue.duration);
    keys += cue.keys.length;
    if (keys > maxKeys) at.member('keys').fail('too_large', `more than ${maxKeys} keys in all`);
    cues.push(cue);
  }
  const length = root.optional('duration');
  const duration = length?.number(0, maxMs) ?? end;
  if (length && (duration <= 0 || duration < end)) length.fail('out_of_range', `is shorter than the cues, ${end} ms`);
  return { name: root.optional('name')?.text(maxText) ?? '', duration, idle, cues };
}

function known(at: JsonCursor, names: readonly string[]): void {
  for (const [name, member] of at.members()) {
    if (!names.includes(name)) member.fail('invalid_argument', 'unknown member');
  }
}

function readIdle(at: JsonCursor | undefined): IdleLife | null {
  if (!at) return null;
  known(at, ['seed', 'blinks_per_minute', 'head', 'eyes']);
  return {
    seed: at.optional('seed')?.integer(0, 0xffffffff) ?? 0,
    blinksPerMinute: at.optional('blinks_per_minute')?.number(0, 40) ?? 15,
    head: at.optional('head')?.number(0, 1) ?? 0.3,
    eyes: at.optional('eyes')?.number(0, 1) ?? 0.5,
  };
}

/** Reads a number, or a name in a table of the standard as its number. */
function numbered(at: JsonCursor, names: readonly string[], first: number, least: number): number {
  if (at.isText) {
    const found = names.indexOf(at.text(64)) + first;
    return found < Math.max(first, least) ? at.fail('invalid_argument', 'there is none of this name') : found;
  }
  return at.integer(least, first + names.length - 1);
}

const fapNames = faps.map((fap) => fap.name);
const visemeNames = visemes.map((viseme) => viseme.name);
const expressionNames = expressions.map((expression) => expression.name);

function readTarget(cue: JsonCursor): CueTarget {
  const given = targetNames.filter((name) => cue.optional(name));
  if (given.length > 1) cue.member(given[1]!).fail('invalid_argument', 'a cue has one target, and this is its second');
  const kind = given[0] ?? cue.fail('missing', `has no target: ${targetNames.join(', ')}`);
  const at = cue.member(kind);
  switch (kind) {
    case 'fap':
      return { kind, fap: numbered(at, fapNames, 1, 3) };
    case 'viseme': {
      if (!at.isArray) return { kind, viseme: numbered(at, visemeNames, 0, 0), other: 0 };
      const [viseme, other] = at.elements(2, 2).map((one) => numbered(one, visemeNames, 0, 0));
      return { kind, viseme: viseme!, other: other! };
    }
    case 'expression':
      return { kind, expression: numbered(at, expressionNames, 0, 1) };
    case 'look_at':
      return readLook(at);
    case 'blink': {
      const side = at.text(16);
      if (!['both', 'left', 'right'].includes(side)) at.fail('invalid_argument', 'must be both, left or right');
      return { kind, left: side !== 'right', right: side !== 'left' };
    }
    case 'head':
      known(at, ['pitch', 'yaw', 'roll']);
      return { kind, pitch: degrees(at, 'pitch'), yaw: degrees(at, 'yaw'), roll: degrees(at, 'roll') };
  }
}

function degrees(at: JsonCursor, name: string): number {
  return at.optional(name)?.number(-90, 90) ?? 0;
}

function readLook(at: JsonCursor): CueTarget {
  known(at, ['yaw', 'pitch', 'distance', 'point', 'head_share']);
  const kind = 'look_at';
  const headShare = at.optional('head_share')?.number(0, 1) ?? 0.25;
  const point = at.optional('point');
  if (!point) {
    const distance = at.optional('distance')?.number(1) ?? Infinity;
    return { kind, yaw: degrees(at, 'yaw'), pitch: degrees(at, 'pitch'), distance, headShare };
  }
  for (const name of ['yaw', 'pitch', 'distance'])
    at.optional(name)?.fail('invalid_argument', 'is not allowed beside point');
  const xyz = point.elements(3, 3);
  const x = xyz[0]!.number(-1e6, 1e6);
  const y = xyz[1]!.number(-1e6, 1e6);
  const z = xyz[2]!.number(0.1, 1e6);
  const distance = Math.hypot(x, y, z);
  if (distance < 1) point.fail('out_of_range', 'is nearer than one eye distance');
  const perRadian = 180 / Math.PI;
  const yaw = Math.atan2(x, z) * perRadian;
  return { kind, yaw, pitch: Math.atan2(-y, Math.hypot(x, z)) * perRadian, distance, headShare };
}

function readEasing(at: JsonCursor | undefined): Easing {
  if (!at) return 'ease_in_out';
  if (at.isArray) {
    const [x1, y1, x2, y2] = at.elements(4, 4);
    return [x1!.number(0, 1), y1!.number(-1, 2), x2!.number(0, 1), y2!.number(-1, 2)];
  }
  const name = at.text(64);
  if (!easingNames.includes(name)) at.fail('invalid_argument', `must be ${easingNames.join(', ')} or four numbers`);
  return name as EasingName;
}

function readCue(at: JsonCursor): Cue {
  const target = readTarget(at);
  const { kind } = target;
  const valued = kind !== 'look_at' && kind !== 'head';
  const members = ['time', 'duration', 'attack', 'release', 'easing', 'note', kind];
  if (valued) members.push('value');
  if (valued && kind !== 'blink') members.push('keys');
  known(at, members);
  at.optional('note')?.text(maxText);
  const time = at.member('time').number(0, maxMs);
  const easing = readEasing(at.optional('easing'));
  const given = at.optional('keys');
  const value = at.optional('value');
  const most = kind === 'fap' ? 32767 * faps[target.fap - 1]!.quantizerStep : 1;
  const least = kind === 'fap' ? -most : 0;
  if (given) value?.fail('invalid_argument', 'is not allowed beside keys');
  else if (kind === 'fap' && !value) at.fail('missing', 'has neither value nor keys');
  const keys = readKeys(given, least, most);
  const length = at.optional('duration');
  let duration: number;
  if (length) duration = length.number(0, maxMs);
  else if (keys.length > 0) duration = keys.at(-1)![0];
  else duration = kind === 'blink' ? blinkMs : at.member('duration').number();
  const wrongLength = !(duration > 0) || time + duration > maxMs;
  if (wrongLength) new JsonCursor(0, `${at.pointer}/duration`).fail('out_of_range', 'must be above 0 and within a day');
  if (keys.length > 0 && keys.at(-1)![0] > duration) {
    new JsonCursor(0, `${given!.pointer}/${keys.length - 1}/0`).fail('out_of_range', 'comes after the end of its cue');
  }
  const [attack, release] = fitRamps(at, keys.length > 0 ? [0, 0] : usualRamps[kind], duration);
  return { time, duration, attack, release, easing, target, value: value?.number(least, most) ?? 1, keys };
}

function readKeys(at: JsonCursor | undefined, least: number, most: number): [number, number][] {
  let before = -1;
  return (at?.elements(1, maxKeys) ?? []).map((key) => {
    const [time, value] = key.elements(2, 2);
    const ms = time!.number(0, maxMs);
    if (ms <= before) time!.fail('out_of_range', 'times of keys must increase');
    before = ms;
    return [ms, value!.number(least, most)];
  });
}

/** Attack and release: given values must fit into the duration; defaults are shortened to the remaining time. */
function fitRamps(at: JsonCursor, usual: readonly [number, number], duration: number): [number, number] {
  const attack = at.optional('attack')?.number(0, duration);
  const release = at.optional('release')?.number(0, duration);
  if (attack !== undefined && release !== undefined) {
    if (attack + release > duration) {
      at.member('release').fail('invalid_argument', 'attack and release together are longer than the cue');
    }
    return [attack, release];
  }
  if (attack !== undefined) return [attack, Math.min(usual[1], duration - attack)];
  if (release !== undefined) return [Math.min(usual[0], duration - release), release];
  const shrink = Math.min(1, duration / Math.max(1e-9, usual[0] + usual[1]));
  return [usual[0] * shrink, usual[1] * shrink];
}
