import type { TimedFrame } from '@client/index.ts';
import { copyFrame } from '@protocol/face_frame.ts';
import type { QuantizerSteps } from '@protocol/quantizers.ts';
import { FrameClip, type Clip } from './clip.ts';

/** Frames per second of a written file. */
export const writtenRate = 25;
/** An endless clip is written up to this time, ms; so is a longer one. */
export const longestMotion = 600_000;
const endlessMotion = 60_000;

export interface Motion {
  frames: readonly TimedFrame[];
  steps: QuantizerSteps;
  /** Frames per second; 0: by the times of the frames. */
  rate: number;
}

/** The frames of a whole clip, for a file: its own, or 25 a second. An endless clip gives its first minute. */
export function framesOfClip(clip: Clip): Motion {
  if (clip instanceof FrameClip) return { frames: clip.frames, steps: clip.steps, rate: 0 };
  const end = clip.duration === Infinity ? endlessMotion : Math.min(clip.duration, longestMotion);
  const count = Math.floor((end * writtenRate) / 1000) + 1;
  const frames = Array.from({ length: count }, (_, i): TimedFrame => {
    const time = (i * 1000) / writtenRate;
    const { from, to, t } = clip.momentAt(time);
    return { time, state: copyFrame((t < 0.5 ? from : to).state) };
  });
  return { frames, steps: clip.steps, rate: writtenRate };
}
