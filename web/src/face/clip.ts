import type { TimedFrame } from '@client/index.ts';
import { standardQuantizers, type QuantizerSteps } from '@protocol/quantizers.ts';

/** One moment of a clip: the interpolation parameter `t` (0..1) between two frames. */
export interface ClipMoment {
  from: TimedFrame;
  to: TimedFrame;
  t: number;
}

/** An animation with random access to any moment, unlike a live stream. */
export interface Clip {
  /** Duration, ms; Infinity for an endless clip. */
  readonly duration: number;
  /** Quantizer steps of the frames: FAP units per level. */
  readonly steps: QuantizerSteps;
  /** `lap`: number of completed loops. Returns the same object at each call. */
  momentAt(position: number, lap?: number): ClipMoment;
}

/** A clip of frames held in memory, from 0 to `duration` ms. */
export class FrameClip implements Clip {
  readonly duration: number;
  readonly steps = standardQuantizers;
  private readonly moment: ClipMoment;
  private at = 0;

  constructor(readonly frames: readonly TimedFrame[]) {
    const first = frames[0];
    if (!first) throw new RangeError('a clip needs at least one frame');
    this.duration = frames.at(-1)!.time;
    this.moment = { from: first, to: first, t: 0 };
  }

  /** Allocates nothing. */
  momentAt(position: number): ClipMoment {
    const { frames, moment } = this;
    if (position < frames[this.at]!.time) this.at = this.search(position);
    while (this.at + 1 < frames.length && frames[this.at + 1]!.time <= position) this.at += 1;
    moment.from = frames[this.at]!;
    moment.to = frames[Math.min(this.at + 1, frames.length - 1)]!;
    const span = moment.to.time - moment.from.time;
    moment.t = span > 0 ? Math.min(1, Math.max(0, (position - moment.from.time) / span)) : 0;
    return moment;
  }

  /** Index of the last frame at or before `position`. */
  private search(position: number): number {
    let low = 0;
    let high = this.frames.length - 1;
    while (low < high) {
      const middle = Math.ceil((low + high) / 2);
      if (this.frames[middle]!.time <= position) low = middle;
      else high = middle - 1;
    }
    return low;
  }
}

/** Playback state of a clip: play, pause, seek, loop. Needs no server. */
export class ClipPlayer {
  loop = false;
  /** ms */
  position = 0;
  private current: Clip | null = null;
  private lap = 0;
  private on = false;
  private changed = false;

  /** `onEnd` is called when the clip reaches its end and does not loop. */
  constructor(private readonly onEnd: () => void = () => undefined) {}

  get clip(): Clip | null {
    return this.current;
  }

  get playing(): boolean {
    return this.on;
  }

  /** Replaces the clip. `keepPlace` keeps position and playback: for the same file read with another option. */
  load(clip: Clip | null, keepPlace = false): void {
    this.current = clip;
    if (!keepPlace || !clip) {
      this.position = 0;
      this.lap = 0;
      this.on = false;
    }
    this.changed = keepPlace;
  }

  play(): void {
    if (!this.current) return;
    if (this.position >= this.current.duration) this.position = 0;
    this.on = true;
    this.changed = true;
  }

  pause(): void {
    this.on = false;
    this.changed = false;
  }

  seek(position: number): void {
    if (!this.current) return;
    this.position = Math.min(this.current.duration, Math.max(0, position));
    this.changed = true;
  }

  /** Advances by one displayed frame, seconds. Returns the moment to show, or null when nothing changed. */
  step(deltaSeconds: number): ClipMoment | null {
    if (!this.current || (!this.on && !this.changed)) return null;
    if (this.on && !this.changed) this.advance(this.current.duration, deltaSeconds * 1000);
    this.changed = false;
    return this.current.momentAt(this.position, this.lap);
  }

  private advance(duration: number, elapsed: number): void {
    this.position += elapsed;
    if (this.position < duration) return;
    if (this.loop && duration > 0) {
      this.lap += Math.floor(this.position / duration);
      this.position %= duration;
      return;
    }
    this.position = duration;
    this.on = false;
    this.onEnd();
  }
}
