import type { FaceFrame } from '../face/frame.ts';

/** Two frames and how far the display stands between them (0 at `from`, 1 at `to`). */
export interface PlayoutSample {
  from: FaceFrame;
  to: FaceFrame;
  share: number;
}

interface Timed {
  /** ms on the stream's media clock */
  time: number;
  frame: FaceFrame;
}

const maxHeld = 256;
const mostCorrection = 0.05;
/** Farther off than this, catching up by 5 % would take too long: jump. Milliseconds. */
const jumpBeyond = 1500;

/**
 * Turns frames that arrive in bursts into a steady flow: plays about two send intervals behind the newest, runs up to
 * 5 % faster or slower to stay there, and jumps when it is hopelessly off. Times are milliseconds; `now` is any steady
 * local clock. Sampling allocates nothing.
 */
export class Playout {
  private readonly held: Timed[] = [];
  private position: number | null = null;
  private lastNow = 0;
  private interval = 40;
  private newestArrival = 0;
  private lastArrivalTime: number | null = null;

  /** Starts anew: after a break, or when another stream begins. */
  reset(): void {
    this.held.length = 0;
    this.position = null;
    this.lastArrivalTime = null;
  }

  /** How far behind the newest frame the display should be. */
  get delay(): number {
    return Math.min(600, Math.max(50, 2 * this.interval));
  }

  /** Media time on display, or null before the first frame. */
  get playing(): number | null {
    return this.position;
  }

  push(time: number, frame: FaceFrame, now: number): void {
    const last = this.held[this.held.length - 1];
    // A clock that goes back belongs to a performance that began again.
    if (last && time < last.time - 1) this.reset();
    else if (last && time <= last.time) {
      last.frame = frame;
      return;
    }
    this.held.push({ time, frame });
    if (this.held.length > maxHeld) this.held.splice(0, this.held.length - maxHeld);
    // Frames of one batch arrive together: the span between arrivals is what the buffer has to cover.
    if (this.lastArrivalTime === null) this.lastArrivalTime = now;
    else if (now - this.lastArrivalTime > 4) {
      const span = Math.min(500, now - this.lastArrivalTime);
      this.interval += (span - this.interval) * 0.1;
      this.lastArrivalTime = now;
    }
    this.newestArrival = now;
  }

  /** Advances to `now` and fills `out`; false while there is nothing to show. */
  sample(now: number, out: PlayoutSample): boolean {
    const { held } = this;
    const newest = held[held.length - 1];
    if (!newest) return false;
    const goal = newest.time + (now - this.newestArrival) - this.delay;
    if (this.position === null || Math.abs(goal - this.position) > jumpBeyond) this.position = goal;
    else {
      const elapsed = now - this.lastNow;
      const error = goal - this.position - elapsed;
      const correction = Math.max(-mostCorrection, Math.min(mostCorrection, error / 1000));
      this.position += elapsed * (1 + correction);
    }
    this.lastNow = now;
    while (held.length > 2 && held[1]!.time <= this.position) held.shift();
    const from = held[0]!;
    const to = held[1] ?? from;
    out.from = from.frame;
    out.to = to.frame;
    out.share = to.time > from.time ? Math.min(1, Math.max(0, (this.position - from.time) / (to.time - from.time))) : 1;
    return true;
  }
}
