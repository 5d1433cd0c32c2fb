/** Round trips older than this (ms) no longer count. */
const window = 60_000;
/** How fast two clocks part at most beyond what is known of them, ms per ms. */
const driftSlack = 300e-6;
const greatestDrift = 500e-6;
/** Clocks are compared over this time (ms) at least before their drift is told, and this at most. */
const driftLeastSpan = 120_000;
const driftSpan = 600_000;
const driftStep = 30_000;
/** Frames come at most so far (ms) ahead of the stream's clock: the server takes none that are farther. */
const farthestAhead = 10_000;
/** Without any round trip the earliest arrival within this time (ms) counts. */
const heardWindow = 10_000;

/** The stream's clock minus ours was between these two when ours was at `at`. */
interface Bounds {
  at: number;
  low: number;
  high: number;
}

/**
 * The stream's clock as a client knows it: its distance from the client's own clock, from the round trips of hello and
 * header and of ping and pong. Times in ms; the client's clock may have any origin but must not be set by hand.
 * protocol/SPEC.md, 7.1; clients/native/client/clock_estimate.h is the same, and protocol/vectors/clock holds the two
 * together.
 */
export class ClockEstimate {
  /** How much faster the stream's clock goes than ours, ms per ms; 0 until it is known. */
  drift = 0;
  /** Of the newest answer, ms; NaN before the first. */
  roundTrip = NaN;
  /** The estimate is off by at most this, ms; NaN before the first answer. */
  uncertainty = NaN;
  /** How often the clocks turned out to have been set, or one of them to have slept. */
  steps = 0;

  private answers: Bounds[] = [];
  /** Estimates `driftStep` apart. */
  private past: { at: number; offset: number }[] = [];
  private nowAt = NaN;
  private offset = NaN;
  private heardAt = NaN;

  /**
   * A message sent at `sent` was answered by one that came at `received` and says that the stream's clock was at
   * `mediaTime`, whole ms, in between.
   */
  answered(sent: number, received: number, mediaTime: number): void {
    if (!(received >= sent)) return;
    // The answer says whole ms, cut off.
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

  /** The newest frame of a message that came at `received` is of `mediaTime`. All there is until the first answer. */
  heard(received: number, mediaTime: number): void {
    const offset = mediaTime - received;
    if (this.answers.length > 0) {
      if (offset <= this.offset + this.uncertainty + farthestAhead) return;
      // No server sends this: our clock has slept. Until the next answer the frames are all we know.
      const steps = this.steps + 1;
      this.clear();
      this.steps = steps;
    }
    if (Number.isNaN(this.nowAt) || offset >= this.offset || received - this.heardAt > heardWindow) {
      this.offset = offset;
      this.nowAt = this.heardAt = received;
    }
  }

  /** Forgets everything: another stream or epoch. */
  clear(): void {
    this.answers = [];
    this.past = [];
    this.nowAt = this.offset = this.heardAt = this.roundTrip = this.uncertainty = NaN;
    this.drift = this.steps = 0;
  }

  /** The stream's clock when ours is at `local`; NaN before anything came. */
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
 * ms from one ping to the next: quick at first, since the clock is all but unknown then, and less rare where answers
 * jitter. `sent`: pings sent since the header. `steady`: the longest.
 */
export function pingPause(sent: number, uncertainty: number, steady = 5000): number {
  if (sent < 5) return 200;
  if (sent < 15) return 1000;
  return uncertainty > 10 ? 0.4 * steady : steady;
}
