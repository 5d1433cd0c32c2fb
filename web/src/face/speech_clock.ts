import type { Clip, ClipMoment } from './clip.ts';

/** A clip on the clock of a sound: the moment to show is that which is heard. */
export interface SpokenClip {
  readonly clip: Clip;
  /** ms of the sound. */
  now(): number;
}

/** The moment of a spoken clip to show now. */
export function momentOf({ clip, now }: SpokenClip): ClipMoment {
  return clip.momentAt(Math.min(clip.duration, Math.max(0, now())));
}
