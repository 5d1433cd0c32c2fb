/**
 * Counts the frames of a stream that the server left out for this connection: a keyframe beyond the newest frame replaces the
 * frames between (SPEC.md, section 2). Sequence numbers count within one epoch only.
 */
export class MissedFrames {
  private count = 0;
  private epoch: number | null = null;
  /** The newest sequence number that was received; null: none of this epoch yet. */
  private newest: number | null = null;

  header(epoch: number): void {
    if (epoch !== this.epoch) this.newest = null;
    this.epoch = epoch;
  }

  /** `last`: number of the last frame of a batch. */
  frames(last: number): void {
    this.newest = last;
  }

  /** Returns the count so far. */
  keyframe(sequence: number): number {
    if (this.newest !== null) this.count += Math.max(0, sequence - this.newest);
    this.newest = sequence;
    return this.count;
  }
}
