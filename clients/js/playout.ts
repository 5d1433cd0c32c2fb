import type { Header } from '../../protocol/ts/messages.ts';
import { ClockEstimate } from './clock_estimate.ts';

export interface PlayoutOptions {
  /** Fixed delay behind the stream's clock, ms; without it the delay adapts to the lateness of the frames. */
  delay?: number;
  /** Whether one more frame ahead is needed, for `eased` interpolation. */
  eased?: boolean;
}

/** Statistics of a playout. Times in ms. */
export interface PlayoutStats {
  /** Current delay behind the stream's clock, and the target that it approaches. */
  delay: number;
  wantedDelay: number;
  /** Interarrival jitter (RFC 3550). */
  jitter: number;
  /** Playhead minus its target by the clock estimate; below 0 while the playhead is held. */
  error: number;
  /** How often frames arrived too late, and the total time without frames. */
  starved: number;
  starvedTime: number;
  snaps: number;
}

const maxSpeedChange = 0.05;
/** The part of `maxSpeedChange` that may be used for changes of the delay. */
const delayRate = 0.04;
/** Time in which an error is corrected, within the limits of the speed, ms. */
const correctionTime = 1000;
/** When the playhead is farther behind than this, ms, it jumps. */
const snapThreshold = 500;
const leastDelay = 60;
const greatestDelay = 2000;
/** Safety margin added to the measured lateness, ms. */
const margin = 15;
/**
 * The maximum lateness of each second is kept for this many seconds. The second largest of them determines the delay;
 * in the first few seconds, the largest.
 */
const secondsKept = 60;
const secondsForSecondWorst = 5;
/** Frames farther apart than this, ms, or than 2.5 frames of a slow stream, have a rest (no motion) between them. */
const leastRest = 250;
/** Duration of the motion towards the first frame after a rest, ms, if that frame arrives in time. */
const motionAfterRest = 100;

const clamp = (value: number, low: number, high: number): number => Math.max(low, Math.min(high, value));

/**
 * Computes the media time to show: the stream's clock minus the delay that lets frames arrive in time. The playhead's
 * speed varies little and is never negative. Handles times only, not frames. Times in ms; `now` is the client's clock.
 * Specification: protocol/SPEC.md, 7.2. clients/native/client/playout.h is the same in C++; protocol/vectors/clock
 * tests both.
 */
export class Playout {
  clock = new ClockEstimate();
  /** Media time to show, ms; NaN before the first frame. */
  playhead = NaN;
  /** Media time of the newest frame. */
  newest = NaN;
  /** ms behind the stream's clock; NaN before the first frame. */
  delay = NaN;
  readonly stats: PlayoutStats = { delay: 0, wantedDelay: 0, jitter: 0, error: 0, starved: 0, starvedTime: 0, snaps: 0 };

  private readonly fixedDelay: number | undefined;
  private readonly eased: boolean;
  private epoch: number | null = null;
  // From the header; 0: unknown.
  private messageInterval = 0;
  private frameInterval = 0;
  private measuredInterval = 0;
  /** Frames up to this media time were sent before the subscription; their lateness is meaningless. */
  private historyUntil = 0;
  private beforeNewest = NaN;
  private transit = NaN;
  private wantedDelay = NaN;
  private seconds: { number: number; worst: number }[] = [];

  constructor(options: PlayoutOptions = {}) {
    this.fixedDelay = options.delay;
    this.eased = options.eased ?? false;
  }

  /** Handles the header of a new connection. Returns true for another epoch, which is another time line. */
  begin(header: Header): boolean {
    this.frameInterval = header.fps_hint > 0 ? 1000 / header.fps_hint : 0;
    this.messageInterval = header.batch_interval > 0 ? header.batch_interval : this.frameInterval;
    this.historyUntil = header.media_time;
    const another = this.epoch !== null && this.epoch !== header.epoch;
    if (another) this.clear();
    this.epoch = header.epoch;
    return another;
  }

  /** Drops the frames; keeps the clock estimate. */
  clear(): void {
    this.playhead = this.newest = this.beforeNewest = this.transit = this.delay = this.wantedDelay = NaN;
    this.measuredInterval = 0;
    this.seconds = [];
  }

  /**
   * Handles arrived frames: media times of the first, the last but one (equal to the first if there is only one) and
   * the last. The caller omits frames at or before `newest`. Returns the media time at which the motion towards the
   * first frame begins: usually that of the frame before.
   */
  arrived(first: number, beforeLast: number, last: number, now: number): number {
    this.clock.heard(now, last);
    const clock = this.clock.at(now);
    const before = this.newest;
    const base = this.eased ? this.beforeNewest : before;
    this.newest = last;
    this.beforeNewest = beforeLast < last ? beforeLast : before;
    this.measureJitter(clock - last);
    if (Number.isNaN(before)) {
      this.beforeNewest = beforeLast;
      this.delay = this.wantedDelay = this.firstDelay();
      this.playhead = Math.min(clock - this.delay, last);
      return first;
    }
    const rested = first - before > this.rest();
    this.measureInterval(first - before);
    const wanted = clock - this.delay;
    // The playhead is held at the previously newest frame, behind its target.
    const held = this.playhead >= before && wanted > this.playhead;
    if (before >= this.historyUntil) this.countLateness(clock - (rested ? first - motionAfterRest : base), now);
    if (rested) {
      // Nothing moved in between, so continuing at the target is not a visible jump.
      if (held) this.playhead = Math.max(this.playhead, Math.min(wanted, first - motionAfterRest / 2));
      return Math.max(before, first - motionAfterRest, held ? this.playhead : before);
    }
    if (!held) return before;
    this.stats.starved += 1;
    this.stats.starvedTime += wanted - this.playhead;
    if (this.fixedDelay === undefined) {
      // A small lag is kept and corrected slowly.
      const behind = clock - this.playhead;
      this.delay = behind - this.wantedDelay > snapThreshold ? this.wantedDelay : behind;
    }
    return before;
  }

  /** Advances by one display frame, `elapsed` after the previous one. */
  advance(now: number, elapsed: number): void {
    if (Number.isNaN(this.playhead)) return;
    elapsed = Math.max(0, elapsed);
    const step = clamp(this.wantedDelay - this.delay, -delayRate * elapsed, delayRate * elapsed); // change of the delay
    this.delay += step;
    const wanted = this.clock.at(now) - this.delay;
    const error = wanted - (this.playhead + elapsed - step);
    let next = this.playhead;
    if (error > snapThreshold) {
      next = wanted;
    } else if (error >= -snapThreshold) {
      const most = maxSpeedChange * elapsed;
      next += elapsed + clamp((error * elapsed) / correctionTime - step, -most, most);
    }
    next = Math.max(this.playhead, Math.min(next, this.newest));
    if (next - this.playhead > elapsed + snapThreshold / 2) this.stats.snaps += 1;
    this.playhead = next;
    this.stats.delay = this.delay;
    this.stats.wantedDelay = this.wantedDelay;
    this.stats.error = this.playhead - wanted;
  }

  /**
   * Sets the playhead by an external clock, such as the sound's, limited to the available frames. It goes back only by
   * more than the snap threshold.
   */
  moveTo(mediaTime: number): void {
    if (Number.isNaN(this.newest)) return;
    const back = this.playhead - mediaTime;
    if (!(back > 0 && back <= snapThreshold)) this.playhead = Math.min(mediaTime, this.newest);
  }

  private firstDelay(): number {
    if (this.fixedDelay !== undefined) return this.fixedDelay;
    const intervals = (this.eased ? 3 : 2) * this.messageInterval;
    return Math.min(greatestDelay, Math.max(leastDelay, intervals) + (this.clock.uncertainty || 0));
  }

  private rest(): number {
    return Math.max(leastRest, 2.5 * (this.frameInterval || this.measuredInterval));
  }

  private measureInterval(gap: number): void {
    if (gap < 1000) this.measuredInterval += this.measuredInterval > 0 ? (gap - this.measuredInterval) / 10 : gap;
  }

  private measureJitter(transit: number): void {
    if (!Number.isNaN(this.transit)) {
      this.stats.jitter += (Math.abs(transit - this.transit) - this.stats.jitter) / 16;
    }
    this.transit = transit;
  }

  private countLateness(lateness: number, now: number): void {
    const { seconds } = this;
    const second = Math.floor(now / 1000);
    while (seconds.length > 0 && seconds[0]!.number <= second - secondsKept) seconds.shift();
    const newest = seconds.at(-1);
    if (newest?.number !== second) seconds.push({ number: second, worst: lateness });
    else newest.worst = Math.max(newest.worst, lateness);
    if (this.fixedDelay !== undefined) return;
    let worst = -Infinity;
    let secondWorst = -Infinity;
    for (const each of seconds) {
      secondWorst = Math.max(secondWorst, Math.min(worst, each.worst));
      worst = Math.max(worst, each.worst);
    }
    const counts = seconds.length < secondsForSecondWorst ? worst : secondWorst;
    this.wantedDelay = clamp(counts + margin, leastDelay, greatestDelay);
    if (seconds.length < 2) this.wantedDelay = Math.max(this.wantedDelay, this.firstDelay());
  }
}
