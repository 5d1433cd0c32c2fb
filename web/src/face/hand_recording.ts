import type { TimedFrame } from '@client/index.ts';
import { copyFrame, type FaceFrame } from '@protocol/face_frame.ts';
import { longestMotion, writtenRate } from './motion_frames.ts';

/**
 * The frames of a face while somebody moves it, 25 a second by the clock: a late sample also fills the frames that were missed.
 * Ten minutes at most.
 */
export class HandRecording {
  readonly frames: TimedFrame[] = [];
  private readonly interval = 1000 / writtenRate;

  /** `start`: when it begins, ms. */
  constructor(private readonly start: number) {}

  /** Whether there is no room for more. */
  get full(): boolean {
    return this.frames.length * this.interval >= longestMotion;
  }

  /** The face at a time, ms of the same clock. */
  add(now: number, shown: FaceFrame): void {
    const state = copyFrame(shown);
    while (!this.full && this.frames.length * this.interval <= now - this.start)
      this.frames.push({ time: this.frames.length * this.interval, state });
  }
}
