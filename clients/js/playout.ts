import type { Header } from '../../protocol/ts/messages.ts';
import { ClockEstimate } from './clock_estimate.ts';

export interface PlayoutOptions {
  /** ms behind the stream's clock, whatever the network does; without it the delay adapts to how late frames come. */
  delay?: number;
  /** One frame more is wanted beyond the shown moment: a curve has to know where it goes after the pair it is in. */
  eased?: boolean;
}

/** How a playout goes. Times in ms. */
export interface PlayoutStats {
  /** Behind the stream's clock now, and where that is going. */
  delay: number;
  wantedDelay: number;
  /** Mean change from one arrival to the next (RFC 3550). */
  jitter: number;
  /** What is shown minus what should be, by our own estimate; below 0 while held. */
  error: number;
  /** How often frames were not there in time, and for how long together. */
  starved: number;
  starvedTime: number;
  snaps: number;
}

const maxSpeedChange = 0.05;
/** Of that, for the delay's sake. */
const delayRate = 0.04;
/** ms in which an error is played away, as far as the speed allows. */
const correctionTime = 1000;
/** Farther behind than this (ms) it jumps. */
const snapThreshold = 500;
const leastDelay = 60;
const greatestDelay = 2000;
/** ms added to the lateness that is to be waited for. */
const margin = 15;
/**
 * Lateness is kept as the worst of each second for this many of them; the second worst of those counts, and in the first
 * few seconds the worst.
 */
const secondsKept = 60;
const secondsForSecondWorst = 5;
/** Frames farther apart than this (ms), or than 2.5 frames of a slow stream, have a rest between them. */
const leastRest = 250;
/** After a rest the motion towards the next frame takes this long (ms), if it arrives in time. */
const motionAfterRest = 100;

const clamp = (value: number, low: number, high: number): number => Math.max(low, Math.min(high, value));

/**
 * Which media time to show when: the stream's clock less a delay that frames need to be there in time, at a speed that
 * changes by little, never back. Knows times only. Times in ms, "now" is of the client's clock. protocol/SPEC.md, 7.2;
 * clients/native/client/playout.h is the same, and protocol/vectors/clock holds the two together.
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
  // As the header says; 0: unknown.
  private messageInterval = 0;
  private frameInterval = 0;
  private measuredInterval = 0;
  /** What is older than this was sent before we were there: its lateness says nothing. */
  private historyUntil = 0;
  private beforeNewest = NaN;
  private transit = NaN;
  private wantedDelay = NaN;
  private seconds: { number: number; worst: number }[] = [];

  constructor(options: PlayoutOptions = {}) {
    this.fixedDelay = options.delay;
    this.eased = options.eased ?? false;
  }

  /** A header came, at first or after a lost connection. Another epoch is another time line: true if so. */
  begin(header: Header): boolean {
    this.frameInterval = header.fps_hint > 0 ? 1000 / header.fps_hint : 0;
    this.messageInterval = header.batch_interval > 0 ? header.batch_interval : this.frameInterval;
    this.historyUntil = header.media_time;
    const another = this.epoch !== null && this.epoch !== header.epoch;
    if (another) this.clear();
    this.epoch = header.epoch;
    return another;
  }

  /** Forgets the frames; the clock stays. */
  clear(): void {
    this.playhead = this.newest = this.beforeNewest = this.transit = this.delay = this.wantedDelay = NaN;
    this.measuredInterval = 0;
    this.seconds = [];
  }

  /**
   * Frames came: the media times of the first and the last, and of the one before the last (equal to the first when
   * there is one only). Frames at or before the newest known are not to be given. Returns the media time at which the
   * motion towards the first of them begins: mostly that of the frame before.
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
    // The playhead stands at the newest frame there was, and should be farther.
    const held = this.playhead >= before && wanted > this.playhead;
    if (before >= this.historyUntil) this.countLateness(clock - (rested ? first - motionAfterRest : base), now);
    if (rested) {
      // Nothing moved in between: going on at the right moment is no jump that could be seen.
      if (held) this.playhead = Math.max(this.playhead, Math.min(wanted, first - motionAfterRest / 2));
      return Math.max(before, first - motionAfterRest, held ? this.playhead : before);
    }
    if (!held) return before;
    this.stats.starved += 1;
    this.stats.starvedTime += wanted - this.playhead;
    if (this.fixedDelay === undefined) {
      // What was shown late stays so much behind and is caught up slowly, if it is little enough.
      const behind = clock - this.playhead;
      this.delay = behind - this.wantedDelay > snapThreshold ? this.wantedDelay : behind;
    }
    return before;
  }

  /** Moves on by a display frame that is shown `elapsed` after the one before. */
  advance(now: number, elapsed: number): void {
    if (Number.isNaN(this.playhead)) return;
    elapsed = Math.max(0, elapsed);
    const step = clamp(this.wantedDelay - this.delay, -delayRate * elapsed, delayRate * elapsed); // of the delay
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
   * Shows this moment, as far as frames go: another clock leads, such as the sound's. Back only from farther than the
   * snap threshold.
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
