import { neutralFrame, type TimedFrame } from '@client/index.ts';
import type { Performance } from '@client/motion/index.ts';
import type { Clip, ClipMoment } from './clip.ts';
import { fineSteps } from './fine_steps.ts';

/** A performance document as a clip: each moment is evaluated on demand, into one frame. */
export class PerformanceClip implements Clip {
  readonly duration: number;
  readonly steps = fineSteps;
  private readonly frame: TimedFrame = { time: 0, state: neutralFrame() };
  private readonly moment: ClipMoment = { from: this.frame, to: this.frame, t: 0 };

  /** `document`: the text that `performance` was made of. */
  constructor(
    private readonly performance: Performance,
    readonly document: string,
  ) {
    this.duration = performance.duration > 0 ? performance.duration : Infinity;
  }

  /** A loop restarts the cues, but not idle life. Allocates nothing; the next call changes the frame. */
  momentAt(position: number, lap = 0): ClipMoment {
    const { performance, duration, steps, frame } = this;
    frame.time = Math.min(Math.max(position, 0), duration);
    performance.frameAt(frame.time, lap > 0 ? frame.time + lap * duration : frame.time, steps, frame.state);
    return this.moment;
  }
}
