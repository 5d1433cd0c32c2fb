import { expressions, faps, visemes } from '@protocol/generated/mpeg4.ts';
import { performanceHeader } from './performance_header.ts';

/** A cue of a performance document as it is written; a document that the library has read has only valid ones. */
export interface Cue {
  time: number;
  duration?: number;
  attack?: number;
  release?: number;
  value?: number;
  keys?: [number, number][];
  fap?: number | string;
  viseme?: number | string | [number | string, number | string];
  expression?: number | string;
  look_at?: object;
  blink?: string;
  head?: object;
  [member: string]: unknown;
}

export interface CueDocument {
  format: string;
  version: number;
  duration?: number;
  cues?: Cue[];
  [member: string]: unknown;
}

/** What a cue drives; cues with the same name belong to one track. `number`: of the FAP or expression, else 0. */
export interface CueTarget {
  kind: 'viseme' | 'expression' | 'fap' | 'look_at' | 'head' | 'blink';
  number: number;
}

/** Shortest cue, ms. */
export const shortestCue = 20;
const blinkDuration = 240;
const latest = 86_400_000;

export const numberOfViseme = (viseme: number | string): number =>
  typeof viseme === 'number' ? viseme : visemes.findIndex(({ name }) => name === viseme);

export function targetOf(cue: Cue): CueTarget {
  if (cue.viseme !== undefined) return { kind: 'viseme', number: 0 };
  if (cue.expression !== undefined) {
    const { expression } = cue;
    const number = typeof expression === 'number' ? expression : expressions.findIndex(({ name }) => name === expression);
    return { kind: 'expression', number };
  }
  if (cue.fap !== undefined) {
    const { fap } = cue;
    return { kind: 'fap', number: typeof fap === 'number' ? fap : (faps.find(({ name }) => name === fap)?.number ?? 0) };
  }
  return { kind: cue.look_at ? 'look_at' : cue.head ? 'head' : 'blink', number: 0 };
}

export const durationOf = (cue: Cue): number => cue.duration ?? cue.keys?.at(-1)?.[0] ?? blinkDuration;
export const endOf = (cue: Cue): number => cue.time + durationOf(cue);

const clamp = (value: number, low: number, high: number): number => Math.min(high, Math.max(low, value));

/** The cue from `start` to `end`, ms. Keys keep their places in it; attack and release are shortened until they fit. */
export function placed(cue: Cue, start: number, end: number): Cue {
  const time = Math.round(clamp(start, 0, latest - shortestCue));
  const duration = Math.round(clamp(end - time, shortestCue, latest - time));
  const share = duration / durationOf(cue);
  const next: Cue = { ...cue, time };
  if (share === 1) return next;
  next.duration = duration;
  if (cue.keys) next.keys = cue.keys.map(([at, value]) => [at * share, value]);
  const ramps = (cue.attack ?? 0) + (cue.release ?? 0);
  if (ramps > duration) {
    if (cue.attack !== undefined) next.attack = (cue.attack * duration) / ramps;
    if (cue.release !== undefined) next.release = (cue.release * duration) / ramps;
  }
  return next;
}

/** The document with other cues, which are put into the order of their times; it becomes longer with them, never shorter. */
export function withCues(document: CueDocument, cues: readonly Cue[]): CueDocument {
  const sorted = [...cues].sort((a, b) => a.time - b.time);
  const next: CueDocument = { ...document, cues: sorted };
  if (document.duration !== undefined) next.duration = Math.max(document.duration, ...sorted.map(endOf));
  return next;
}

/** A document with nothing in it but its length. */
export const emptyDocument = (name: string): CueDocument => ({
  ...performanceHeader,
  name,
  duration: 5000,
  cues: [],
});
