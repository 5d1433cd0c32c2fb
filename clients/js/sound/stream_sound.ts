import type { PlayoutStats } from '../player.ts';
import type { StreamClient } from '../stream_client.ts';
import type { SoundPacket } from '../stream_types.ts';
import { rounding, SoundSchedule } from './schedule.ts';

/** Packets that may wait for the decoder: more than a second of sound. */
const mostWaiting = 24;

/**
 * Lets the sound of a stream be heard, by the browser's own Opus decoder, and tells the player the time to show:
 *
 *     const client = new StreamClient(url, { sound: true });
 *     const player = new Player(kernel, { clock: () => sound.mediaTime });
 *     const sound = new StreamSound(client, player);
 *     button.onclick = () => sound.start();  // browsers ask for a tap
 */
export class StreamSound {
  private schedule = new SoundSchedule();
  private context: AudioContext | null = null;
  private out: GainNode | null = null;
  private decoder: AudioDecoder | null = null;
  /** Media time at which what the decoder was given ends. */
  private given = NaN;
  /** What is played and is to be played. */
  private readonly nodes = new Set<AudioBufferSourceNode>();
  private epoch = NaN;
  private readonly stops: (() => void)[];

  constructor(
    private readonly client: StreamClient,
    private readonly player: { readonly stats: Readonly<Pick<PlayoutStats, 'delay' | 'clock'>> },
  ) {
    this.stops = [
      client.on('sound', (packet) => this.decode(packet)),
      client.on('header', ({ epoch }) => {
        if (epoch !== this.epoch) this.silence(); // it has another clock
        this.epoch = epoch;
      }),
    ];
  }

  /** Whether this browser decodes Opus and lets pages make sound. */
  static get isSupported(): boolean {
    return typeof AudioDecoder === 'function' && typeof AudioContext === 'function';
  }

  get isOn(): boolean {
    return this.context?.state === 'running';
  }

  /** What is heard, for whoever records it; null before the first `start`. */
  get output(): AudioNode | null {
    return this.out;
  }

  /** The media time that is heard now, for the option `clock` of the player; NaN while nothing is heard. */
  get mediaTime(): number {
    const { context } = this;
    return context && this.isOn ? this.schedule.heardAt(context.currentTime * 1000 - latency(context)) : NaN;
  }

  /** To call by a tap or a key. Rejects where the browser does not allow sound or does not decode Opus. */
  async start(): Promise<void> {
    const { rate, channels } = this.client.header?.sound ?? { rate: 48_000, channels: 1 };
    // A browser needs about 100 ms for its first decoder. Made for the first packet, it would give that packet too late.
    this.decoderOf(rate, channels);
    // The rate of Opus: otherwise each packet would be resampled by itself, which is heard at its ends.
    if (!this.context) {
      this.context = new AudioContext({ sampleRate: rate, latencyHint: 'interactive' });
      this.schedule = new SoundSchedule(this.context.sampleRate);
      this.out = this.context.createGain();
      this.out.connect(this.context.destination);
    }
    await this.context.resume();
  }

  async stop(): Promise<void> {
    this.silence();
    await this.context?.suspend();
  }

  dispose(): void {
    for (const stop of this.stops) stop();
    if (this.decoder?.state !== 'closed') this.decoder?.close();
    void this.context?.close();
    this.context = this.out = this.decoder = null;
  }

  private silence(): void {
    this.schedule.clear();
    for (const node of this.nodes) node.stop();
    this.nodes.clear();
  }

  private decode({ mediaTime, duration, packet }: SoundPacket): void {
    const sound = this.client.header?.sound;
    if (!this.isOn || sound?.codec !== 'opus') return;
    // The times of what a decoder gives go on through a gap as if there were none (Chromium counts samples from its first packet).
    if (!(Math.abs(mediaTime - this.given) <= rounding)) this.endPhrase();
    const decoder = this.decoderOf(sound.rate, sound.channels);
    if (decoder.decodeQueueSize >= mostWaiting) return;
    this.given = mediaTime + duration;
    decoder.decode(new EncodedAudioChunk({ type: 'key', timestamp: mediaTime * 1000, data: packet }));
  }

  /** The next packet gets another decoder; this one still gives what it has. */
  private endPhrase(): void {
    const { decoder } = this;
    this.decoder = null;
    if (decoder?.state !== 'configured') return;
    const close = (): void => void (decoder.state !== 'closed' && decoder.close());
    decoder.flush().then(close, close);
  }

  private decoderOf(sampleRate: number, numberOfChannels: number): AudioDecoder {
    if (this.decoder && this.decoder.state === 'configured') return this.decoder;
    // After a packet that it cannot decode a decoder is closed: the next packet gets another one.
    this.decoder = new AudioDecoder({ output: (data) => this.hear(data), error: () => undefined });
    this.decoder.configure({ codec: 'opus', sampleRate, numberOfChannels });
    return this.decoder;
  }

  private hear(data: AudioData): void {
    const { context } = this;
    const { delay, clock } = this.player.stats;
    const shown = (clock?.mediaTime ?? NaN) - delay;
    const packet = { mediaTime: data.timestamp / 1000, duration: (data.numberOfFrames / data.sampleRate) * 1000 };
    // Of the context's time, because the latency changes, at first from 0, while what was placed stays where it is.
    const placed = context && this.isOn ? this.schedule.place(packet, context.currentTime * 1000, shown + latency(context)) : null;
    if (context && this.out && placed) {
      const buffer = new AudioBuffer({ length: placed.samples, numberOfChannels: data.numberOfChannels, sampleRate: context.sampleRate });
      const samples = new Float32Array(data.numberOfFrames);
      for (let channel = 0; channel < data.numberOfChannels; channel += 1) {
        data.copyTo(samples, { planeIndex: channel, format: 'f32-planar' });
        stretch(samples, buffer.getChannelData(channel));
      }
      const node = new AudioBufferSourceNode(context, { buffer });
      node.connect(this.out);
      node.onended = () => this.nodes.delete(node);
      this.nodes.add(node);
      node.start(placed.at / 1000);
    }
    data.close();
  }
}

/** ms from a sample's time in the context until it is heard */
function latency(context: AudioContext): number {
  return (context.outputLatency || context.baseLatency || 0) * 1000;
}

/** All samples in more or fewer places, between neighbours linearly; a copy for as many. */
function stretch(from: Float32Array, to: Float32Array): void {
  if (from.length === to.length) return to.set(from);
  const step = (from.length - 1) / (to.length - 1);
  for (let i = 0; i < to.length; i += 1) {
    const at = Math.min(Math.floor(i * step), from.length - 2);
    to[i] = from[at]! + (from[at + 1]! - from[at]!) * (i * step - at);
  }
}
