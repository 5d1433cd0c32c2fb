import { standardQuantizers, quantize, quantizersOf, type QuantizerSteps } from '@protocol/quantizers.ts';
import { neutralFrame as neutralState, type FaceFrame as FaceState, type ResumePoint } from '@protocol/messages.ts';
import { neutralFrame, type FaceFrame } from '../face/frame.ts';
import { StreamLink, type LinkStatus } from './link.ts';
import { Playout, type PlayoutSample } from './playout.ts';

export type { LinkStatus } from './link.ts';

/** How a subscription goes. Rates are means over the last second or so. */
export interface LiveStats {
  framesPerSecond: number;
  bytesPerSecond: number;
  /** From the stream's clock to the display, as far as pings tell; null before the first answer. */
  latencyMs: number | null;
  sequence: number;
}

/** Follows a stream and plays it out evenly. */
export class LiveSubscriber {
  readonly stats: LiveStats = { framesPerSecond: 0, bytesPerSecond: 0, latencyMs: null, sequence: 0 };
  private readonly playout = new Playout();
  private readonly link: StreamLink;
  private steps: QuantizerSteps = standardQuantizers;
  private last: ResumePoint | null = null;
  private epoch = 0;
  private frames = 0;
  private ticker: ReturnType<typeof setInterval> | null = null;
  private pings = 0;
  /** Media clock minus local clock, by the quickest of the recent pings. */
  private clockOffset: number | null = null;
  private bestRoundTrip = Infinity;

  constructor(url: string, title: string, onStatus: (status: LinkStatus) => void) {
    this.link = new StreamLink(url, title, 'subscribe', () => this.last, {
      onStatus,
      onHeader: (header) => {
        this.steps = quantizersOf(header);
        if (!header.recovered || header.epoch !== this.epoch) this.playout.reset();
        this.epoch = header.epoch;
        this.bestRoundTrip = Infinity;
        this.ping();
      },
      onMessage: (message) => {
        const now = performance.now();
        if (message.type === 'keyframe') this.take(message.media_time, message.sequence, message.state, now);
        else if (message.type === 'frames') message.frames.forEach((frame, i) => this.take(message.media_time + frame.time, message.sequence + i, frame.state, now));
        else if (message.type === 'pong') {
          const roundTrip = now - message.client_time;
          if (roundTrip <= this.bestRoundTrip * 1.2) {
            this.bestRoundTrip = Math.min(this.bestRoundTrip, roundTrip);
            this.clockOffset = message.media_time - (message.client_time + now) / 2;
          }
        }
      },
    });
  }

  open(): void {
    this.link.open();
    let before = performance.now();
    let ticks = 0;
    this.ticker = setInterval(() => {
      const now = performance.now();
      const seconds = (now - before) / 1000;
      before = now;
      this.stats.framesPerSecond += (this.frames / seconds - this.stats.framesPerSecond) * 0.6;
      this.stats.bytesPerSecond += (this.link.bytes / seconds - this.stats.bytesPerSecond) * 0.6;
      this.frames = 0;
      this.link.bytes = 0;
      const { playing } = this.playout;
      this.stats.latencyMs = this.clockOffset === null || playing === null ? null : Math.max(0, now + this.clockOffset - playing);
      ticks += 1;
      if (ticks % 5 === 0) this.ping();
    }, 1000);
  }

  close(): void {
    if (this.ticker !== null) clearInterval(this.ticker);
    this.link.close();
  }

  /** What to show at `now` (performance.now()); false while nothing has come. Allocates nothing. */
  sample(now: number, out: PlayoutSample): boolean {
    return this.playout.sample(now, out);
  }

  private take(time: number, sequence: number, state: FaceState, now: number): void {
    this.frames += 1;
    this.stats.sequence = sequence;
    this.last = { epoch: this.epoch, sequence };
    this.playout.push(time, fromState(state, this.steps), now);
  }

  private ping(): void {
    this.pings += 1;
    this.link.send({ type: 'ping', id: this.pings, client_time: performance.now() });
  }
}

const sendInterval = 40;
const mostPending = 16_384;

/** Sends frames set by hand to a stream: the newest, at most 25 a second. */
export class LivePublisher {
  private readonly link: StreamLink;
  private readonly newest = neutralState();
  private changed = true;
  private started = false;
  private timer: ReturnType<typeof setInterval> | null = null;
  private steps: QuantizerSteps = standardQuantizers;

  constructor(url: string, onStatus: (status: LinkStatus) => void) {
    this.link = new StreamLink(url, '', 'publish', () => null, {
      onStatus: (status) => {
        if (status.kind !== 'open') this.started = false;
        onStatus(status);
      },
      onHeader: (header) => {
        this.steps = quantizersOf(header);
        this.started = true;
        this.keyframe();
      },
      onMessage: () => {},
    });
  }

  open(): void {
    this.link.open();
    this.timer = setInterval(() => {
      if (!this.started || !this.changed || this.link.pending > mostPending) return;
      this.changed = !this.link.send({ type: 'frames', sequence: 0, media_time: 0, frames: [{ time: 0, state: this.newest }] });
    }, sendInterval);
  }

  close(): void {
    if (this.timer !== null) clearInterval(this.timer);
    this.link.close();
  }

  push(frame: FaceFrame): void {
    toState(frame, this.steps, this.newest);
    this.changed = true;
  }

  private keyframe(): void {
    this.changed = !this.link.send({ type: 'keyframe', sequence: 0, media_time: 0, state: this.newest });
  }
}

/** Quantized levels -> FAP units. */
export function fromState(state: FaceState, steps: QuantizerSteps): FaceFrame {
  const frame = neutralFrame();
  Object.assign(frame.viseme, state.viseme);
  Object.assign(frame.expression, state.expression);
  for (let number = 3; number <= 68; number += 1) frame.faps[number] = state.levels[number]! * steps[number]!;
  return frame;
}

/** FAP units -> quantized levels, to the nearest. */
export function toState(frame: FaceFrame, steps: QuantizerSteps, out: FaceState): void {
  Object.assign(out.viseme, frame.viseme);
  Object.assign(out.expression, frame.expression);
  for (let number = 3; number <= 68; number += 1) out.levels[number] = quantize(frame.faps[number]!, steps[number]!) ?? 0;
}
