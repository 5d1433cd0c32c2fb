import type { Clip, ClipMoment } from './clip.ts';

/** A clip on the clock of a sound: the moment to show is that which is heard. */
export interface SpokenClip {
  readonly clip: Clip;
  /** ms of the sound. */
  now(): number;
}

/** ms of the clip to show now. */
export const positionOf = ({ clip, now }: SpokenClip): number => Math.min(clip.duration, Math.max(0, now()));

/** The moment of a spoken clip to show now. */
export const momentOf = (spoken: SpokenClip): ClipMoment => spoken.clip.momentAt(positionOf(spoken));
