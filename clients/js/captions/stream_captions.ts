import { Emitter } from '../emitter.ts';
import type { StreamClient } from '../stream_client.ts';
import type { SpokenText } from '../stream_types.ts';
import { cuesOf, type Cue } from './cues.ts';

/** Cues that are kept; a text of the stream has at most some thirty. */
const mostKept = 200;
/** ms by which the time does not go back: sound that begins again after a gap may be this much behind the picture. */
const mostBack = 2000;

/**
 * What a stream says, as captions: asks for the texts, and tells which words belong to the picture that is shown.
 *
 *     const captions = new StreamCaptions(client, () => client.streamClock.mediaTime - player.delay);
 *     captions.on('cue', (cue) => (line.textContent = cue?.text ?? ''));
 *     captions.start();
 *     // with each picture: captions.update();
 */
export class StreamCaptions extends Emitter<{ cue: Cue | null }> {
  isOn = false;
  /** What is shown now. */
  cue: Cue | null = null;

  private cues: Cue[] = [];
  /** The latest that was shown. */
  private time = NaN;
  private newest = 0;
  private epoch = NaN;
  private readonly stops: (() => void)[];

  constructor(
    private readonly client: StreamClient,
    /** ms of the stream's clock that the page shows, and lets hear. */
    private readonly shown: () => number,
  ) {
    super();
    this.takeEpoch(client.header?.epoch ?? NaN);
    this.stops = [client.on('text', (text) => this.take(text)), client.on('header', ({ epoch }) => this.takeEpoch(epoch)), client.on('end', () => this.clear())];
  }

  start(): void {
    this.isOn = true;
    // What unpacks texts is there before the first one, for which the frames would wait else.
    void import('../speech/library.ts').then(({ loadUnpacking }) => loadUnpacking()).catch(() => undefined);
    this.client.setCaptions(true);
    this.update();
  }

  stop(): void {
    this.isOn = false;
    this.client.setCaptions(false);
    this.update();
  }

  dispose(): void {
    for (const stop of this.stops) stop();
    this.clear();
  }

  /** To call with each picture. */
  update(): void {
    const now = this.isOn ? this.shown() : NaN;
    // Words that were replaced do not come again.
    if (!(now < this.time && now > this.time - mostBack)) this.time = now;
    const { time } = this;
    const cue = this.cues.filter(({ begin, end }) => begin <= time && time < end).at(-1) ?? null;
    if (cue === this.cue) return;
    this.cue = cue;
    this.emit('cue', cue);
  }

  private take(text: SpokenText): void {
    if (text.speech <= this.newest) return; // known: after a new connection it comes again
    this.newest = text.speech;
    const { mediaTime } = text;
    if (text.text !== '') return void (this.cues = [...this.cues, ...cuesOf(text)].slice(-mostKept));
    this.cues = this.cues.filter(({ begin }) => begin < mediaTime);
    for (const cue of this.cues) cue.end = Math.min(cue.end, mediaTime);
  }

  private takeEpoch(epoch: number): void {
    if (epoch !== this.epoch) {
      this.time = NaN;
      this.clear(); // other texts, with numbers and times of their own
      this.newest = 0;
    }
    this.epoch = epoch;
  }

  private clear(): void {
    this.cues = [];
    this.update();
  }
}
