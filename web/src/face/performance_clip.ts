import type { TimedFrame } from '@client/index.ts';
import type { Performance } from '@client/motion/index.ts';
import type { Clip, ClipMoment } from './clip.ts';
import { fineSteps } from './fine_steps.ts';

/** Sampling interval of a performance, ms; the face is interpolated linearly between samples. */
const interval = 20;

/** A performance document as a clip: frames are evaluated on demand. */
export class PerformanceClip implements Clip {
  readonly duration: number;
  readonly steps = fineSteps;
  private readonly moment: ClipMoment;
  private lap = 0;

  /** `document`: the text that `performance` was made of. */
  constructor(
    private readonly performance: Performance,
    readonly document: string,
  ) {
    this.duration = performance.duration > 0 ? performance.duration : Infinity;
    const first = this.frameAt(0);
    this.moment = { from: first, to: first, t: 0 };
  }

  momentAt(position: number, lap = 0): ClipMoment {
    const { moment } = this;
    const at = Math.min(Math.max(position, 0), this.duration);
    const begin = Math.floor(at / interval) * interval;
    const end = Math.min(begin + interval, this.duration);
    if (lap !== this.lap) {
      this.lap = lap;
      moment.from = moment.to = this.frameAt(begin);
    } else if (moment.from.time !== begin) {
      moment.from = moment.to.time === begin ? moment.to : this.frameAt(begin);
    }
    if (moment.to.time !== end) moment.to = end > begin ? this.frameAt(end) : moment.from;
    moment.t = end > begin ? (at - begin) / (end - begin) : 0;
    return moment;
  }

  /** A loop restarts the cues, but not idle life. */
  private frameAt(time: number): TimedFrame {
    const idle = this.lap > 0 ? time + this.lap * this.duration : time;
    return { time, state: this.performance.frameAt(time, idle, this.steps) };
  }
}
