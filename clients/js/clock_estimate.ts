/** Age limit of the round trips that the estimate uses, ms. */
const window = 60_000;
/** Bound of the unknown part of the drift between the two clocks, ms per ms. */
const driftSlack = 300e-6;
const greatestDrift = 500e-6;
/** Minimum and maximum time over which the drift is measured, ms. */
const driftLeastSpan = 120_000;
const driftSpan = 600_000;
const driftStep = 30_000;
/** How far frames can be ahead of the stream's clock, ms: the server refuses frames that are farther ahead. */
const farthestAhead = 10_000;
/** Without any round trip, the estimate uses the earliest arrival within this time, ms. */
const heardWindow = 10_000;

/** Bounds of the stream's clock minus the client's clock, at the client's time `at`. */
interface Bounds {
  at: number;
  low: number;
  high: number;
}

/**
 * A client's estimate of the stream's clock: its offset from the client's own clock, from the round trips of hello and
 * header and of ping and pong. Times in ms; the client's clock may have any origin but must be monotonic.
 * Specification: protocol/SPEC.md, 7.1. clients/native/client/clock_estimate.h is the same in C++;
 * protocol/vectors/clock tests both.
 */
export class ClockEstimate {
  /** Drift: how much faster the stream's clock runs than the client's, ms per ms; 0 until it is known. */
  drift = 0;
  /** Round trip of the newest pong or header, ms; NaN before the first. */
  roundTrip = NaN;
  /** Bound of the estimate's error, ms; NaN before the first round trip. */
  uncertainty = NaN;
  /** Number of detected clock steps: a clock was set, or a machine slept. */
  steps = 0;

  private answers: Bounds[] = [];
  /** Past estimates, `driftStep` apart. */
  private past: { at: number; offset: number }[] = [];
  private nowAt = NaN;
  private offset = NaN;
  private heardAt = NaN;

  /**
   * Adds a round trip: a request sent at `sent` and its response received at `received`, which says that the stream's
   * clock was at `mediaTime` (whole ms) at some moment in between.
   */
  answered(sent: number, received: number, mediaTime: number): void {
    if (!(received >= sent)) return;
    // The media time is truncated to whole ms.
    const bounds = { at: received, low: mediaTime - received, high: mediaTime + 1 - sent };
    if (this.answers.length > 0) {
      const before = this.boundsAt(received);
      if (bounds.low > before.high || bounds.high < before.low) {
        this.answers = [];
        this.past = [];
        this.drift = 0;
        this.steps += 1;
      }
    }
    while (this.answers.length > 0 && received - this.answers[0]!.at > window) this.answers.shift();
    this.answers.push(bounds);
    const { low, high } = this.boundsAt(received);
    this.nowAt = received;
    this.offset = (low + high) / 2;
    this.uncertainty = (high - low) / 2;
    this.roundTrip = received - sent;
    this.measureDrift();
  }

  /** Adds a message received at `received` whose newest frame has `mediaTime`; used until the first round trip. */
  heard(received: number, mediaTime: number): void {
    const offset = mediaTime - received;
    if (this.answers.length > 0) {
      if (offset <= this.offset + this.uncertainty + farthestAhead) return;
      // No server sends frames this far ahead: the client's clock has slept. Use arrivals until the next round trip.
      const steps = this.steps + 1;
      this.clear();
      this.steps = steps;
    }
    if (Number.isNaN(this.nowAt) || offset >= this.offset || received - this.heardAt > heardWindow) {
      this.offset = offset;
      this.nowAt = this.heardAt = received;
    }
  }

  /** Resets the estimate, for another stream or epoch. */
  clear(): void {
    this.answers = [];
    this.past = [];
    this.nowAt = this.offset = this.heardAt = this.roundTrip = this.uncertainty = NaN;
    this.drift = this.steps = 0;
  }

  /** The stream's clock at the client's time `local`; NaN before the first message. */
  at(local: number): number {
    return local + this.offset + this.drift * (local - this.nowAt);
  }

  private boundsAt(local: number): Bounds {
    let low = -Infinity;
    let high = Infinity;
    for (const each of this.answers) {
      const age = local - each.at;
      low = Math.max(low, each.low + (this.drift - driftSlack) * age);
      high = Math.min(high, each.high + (this.drift + driftSlack) * age);
    }
    return { at: local, low, high };
  }

  private measureDrift(): void {
    const { nowAt, offset, past } = this;
    while (past.length > 0 && nowAt - past[0]!.at > driftSpan) past.shift();
    if (past.length === 0 || nowAt - past.at(-1)!.at >= driftStep) past.push({ at: nowAt, offset });
    const span = nowAt - past[0]!.at;
    if (span >= driftLeastSpan) {
      this.drift = Math.max(-greatestDrift, Math.min(greatestDrift, (offset - past[0]!.offset) / span));
    }
  }
}

/**
 * Time to the next ping, ms: short at first, while the clock is uncertain, and shorter when round trips jitter. `sent`:
 * pings sent since the header. `steady`: the longest interval.
 */
export function pingPause(sent: number, uncertainty: number, steady = 5000): number {
  if (sent < 5) return 200;
  if (sent < 15) return 1000;
  return uncertainty > 10 ? 0.4 * steady : steady;
}
