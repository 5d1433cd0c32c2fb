/** ms; of a published voice, as of the server's own: section 2.1 of SPEC.md. */
export const packetDuration = 60;
/** ms by which Opus delays the sound that it codes: the lookahead of libopus, which Ogg files call pre-skip. */
const lookahead = 6.5;
/** The clocks of the sound and of the page differ by at most this share. */
const mostDrift = 0.0005;

/** Chromium's; the declarations of the DOM do not have it. */
declare class MediaStreamTrackProcessor {
  constructor(init: { track: MediaStreamTrack });
  readonly readable: ReadableStream<AudioData>;
}

/** A packet and the moment at which its first sample was spoken: ms of performance.now(). */
export type OnPacket = (packet: Uint8Array, time: number) => void;

/**
 * When samples were spoken. Each block comes as late as the page is busy, so the block that came with the least delay tells how the
 * clock of the sound and that of the page differ.
 */
export class SpokenTime {
  private offset = Infinity;
  private before = -Infinity;
  private ends = -Infinity;

  /** The end of a block by the clock of the sound, and when it came by the page's; ms. */
  came(end: number, now: number): void {
    this.offset = Math.min(this.offset + (now - this.before) * mostDrift, now - end);
    this.before = now;
  }

  /** When a packet begins by the page's clock: not before the end of the one before it, which has been sent. */
  place(begin: number, duration: number): number {
    const time = Math.max(begin + this.offset, this.ends);
    this.ends = time + duration;
    return time;
  }
}

/** What the worker tells: a packet with its beginning, and the newest block's end and when it came; or why there is none. */
export type WorkerMessage = { packet: Uint8Array; begin: number; end: number; now: number } | { fault: string };

/** Makes Opus packets of a microphone's track. Silence makes none. */
export class VoiceEncoder {
  private readonly worker = new Worker(new URL('./voice_worker.ts', import.meta.url), { type: 'module' });
  private readonly time = new SpokenTime();

  constructor(track: MediaStreamTrack, onPacket: OnPacket, onFault: (error: Error) => void) {
    this.worker.onmessage = ({ data }: MessageEvent<WorkerMessage>) => {
      if ('fault' in data) return onFault(new Error(data.fault));
      this.time.came(data.end, data.now - performance.timeOrigin);
      onPacket(data.packet, this.time.place(data.begin - lookahead, packetDuration));
    };
    this.worker.onerror = ({ message }) => onFault(new Error(message));
    const { readable } = new MediaStreamTrackProcessor({ track });
    this.worker.postMessage(readable, [readable]);
  }

  close(): void {
    this.worker.terminate();
  }
}
