import { StreamClient, type FaceFrame } from '@client/index.ts';
import type { EndReason } from '@protocol/messages.ts';
import { MissedFrames } from './missed_frames.ts';
import { serverWords, t } from '../words/words.ts';

export interface LinkStatus {
  kind: 'off' | 'connecting' | 'open' | 'waiting' | 'ended';
  title?: string;
  reason?: string;
}

/** Measurements of a subscription; rates are means over about the last second. */
export interface LiveStats {
  framesPerSecond: number;
  bytesPerSecond: number;
  /** The stream's clock now, ms; null while its estimate is too uncertain. */
  mediaTime: number | null;
  sequence: number;
  /** Frames that the server left out because this connection was too slow for them, or while it was lost. */
  dropped: number;
}

const endings: Record<EndReason, string> = {
  other: t('The stream ended.'),
  finished: t('The performance has ended.'),
  deleted: t('The stream was deleted.'),
  shutdown: t('The server is shutting down.'),
  replaced: t('Another connection took over.'),
  slow: t('This connection was too slow for the stream.'),
};

/** Converts a client's events into one status for display. */
function report(client: StreamClient, title: string, onStatus: (status: LinkStatus) => void): void {
  let ended: string | null = null;
  let named = title;
  client.on('header', (header) => (named = header.title || title));
  client.on('end', ({ reason }) => (ended = endings[reason]));
  client.on('error', ({ message, where }) => {
    const words = serverWords(message);
    onStatus({ kind: 'open', title: named, reason: where ? `${words} (${where})` : words });
  });
  client.on('state', (state) => {
    if (state === 'closed') onStatus(ended === null ? { kind: 'off' } : { kind: 'ended', title: named, reason: ended });
    else if (state === 'waiting')
      onStatus({ kind: 'waiting', title: named, reason: ended ?? t('The connection was lost; reconnecting.') });
    else {
      ended = null;
      onStatus({ kind: state, title: named });
    }
  });
}

/** A WebSocket class that counts the received bytes. */
function countingSocket(count: (bytes: number) => void): typeof WebSocket {
  return class extends WebSocket {
    constructor(url: string | URL, protocols?: string | string[]) {
      super(url, protocols);
      this.addEventListener('message', (event: MessageEvent<ArrayBuffer | string>) =>
        count(typeof event.data === 'string' ? event.data.length : event.data.byteLength),
      );
    }
  };
}

/** A clock estimate with a larger uncertainty than this, ms, is not displayed. */
const worstUncertainty = 125;

/** A subscription to one stream. `client` feeds the player of the face. */
export class LiveSubscriber {
  readonly client: StreamClient;
  readonly stats: LiveStats = { framesPerSecond: 0, bytesPerSecond: 0, mediaTime: null, sequence: 0, dropped: 0 };
  /** The newest frame received; null before the first. */
  newest: FaceFrame | null = null;
  private readonly missed = new MissedFrames();
  private frames = 0;
  private bytes = 0;
  private ticker: ReturnType<typeof setInterval> | null = null;

  /** `hasSound`: its sound is asked for too. */
  constructor(
    url: string,
    title: string,
    onStatus: (status: LinkStatus) => void,
    readonly hasSound = false,
  ) {
    this.client = new StreamClient(url, { sound: hasSound, WebSocket: countingSocket((bytes) => (this.bytes += bytes)) });
    report(this.client, title, onStatus);
    this.client.on('frames', (batch) => {
      this.frames += batch.frames.length;
      this.newest = batch.frames.at(-1)?.state ?? this.newest;
      this.stats.sequence = batch.sequence + batch.frames.length - 1;
      this.missed.frames(this.stats.sequence);
    });
    this.client.on('header', ({ epoch }) => this.missed.header(epoch));
    this.client.on('keyframe', ({ sequence, state }) => {
      this.newest = state;
      this.stats.dropped = this.missed.keyframe(sequence);
    });
  }

  open(): void {
    this.client.connect();
    let before = performance.now();
    this.ticker = setInterval(() => {
      const now = performance.now();
      const seconds = (now - before) / 1000;
      before = now;
      this.stats.framesPerSecond += (this.frames / seconds - this.stats.framesPerSecond) * 0.6;
      this.stats.bytesPerSecond += (this.bytes / seconds - this.stats.bytesPerSecond) * 0.6;
      const { streamClock } = this.client;
      this.stats.mediaTime = streamClock.uncertainty <= worstUncertainty ? streamClock.at(now) : null;
      this.frames = 0;
      this.bytes = 0;
    }, 1000);
  }

  close(): void {
    if (this.ticker !== null) clearInterval(this.ticker);
    this.client.close();
  }
}

const sendInterval = 40;

/**
 * Publishes the frame set with the sliders to a stream, after each change, at most 25 times a second, and a voice with it. Both have the
 * page's clock, performance.now().
 */
export class LivePublisher {
  private readonly client: StreamClient;
  /** When the frame became what it is; null: it is sent. */
  private changed: number | null = performance.now();
  private timer: ReturnType<typeof setInterval> | null = null;

  constructor(
    url: string,
    private readonly frame: FaceFrame,
    onStatus: (status: LinkStatus) => void,
  ) {
    this.client = new StreamClient(url, { role: 'publish', sound: true });
    report(this.client, '', onStatus);
    this.client.on('header', () => this.touch());
  }

  open(): void {
    this.client.connect();
    this.timer = setInterval(() => {
      if (this.changed !== null && this.client.publish([{ time: 0, state: this.frame }], this.changed)) this.changed = null;
    }, sendInterval);
  }

  /** The frame has changed; `time`: the moment that it shows. */
  touch(time = performance.now()): void {
    this.changed = time;
  }

  /** Sends one Opus packet of a voice that was heard from `time` on. */
  say(packet: Uint8Array, time: number): void {
    this.client.publishSound(packet, time);
  }

  close(): void {
    if (this.timer !== null) clearInterval(this.timer);
    this.client.close();
  }
}
