import { wordsOf, wordTimes, type Word } from '../../../protocol/ts/speech_score.ts';
import { Emitter } from '../emitter.ts';
import { frameLayout } from '../generated/layouts.ts';
import type { Runtime } from '../runtime.ts';
import type { StreamClient } from '../stream_client.ts';
import type { SpokenText } from '../stream_types.ts';
import { loadSpeakers, type SpeakerLibrary } from './library.ts';

/** `off`: not asked for. `ready`: text comes, and is said. `failed`: there is no voice, or it did not speak: frames come. */
export type SpeechState = 'off' | 'ready' | 'failed';

/** ms that a browser may take to tell its voices */
const voicesPatience = 1500;
/** ms that a voice may take to begin a text */
const startPatience = 4000;
/** A voice that takes longer than this for a text, for each ms that was estimated, and `startPatience` more, has stopped. */
const longest = 4;
/** ms: so often at most the server is told where the voice is */
const tellInterval = 1000;
/** ms; a word that is so much too late is left out, as who comes late does not say what was said */
const latest = 300;
/** bytes: SPEC.md, section 2.2 */
const largestScore = 4000;
const slowest = 0.7;
const fastest = 1.6;

/** What lies in the memory of the library. */
interface SpeakerMemory {
  readonly library: SpeakerLibrary;
  readonly speaker: number;
  readonly score: number;
  /** A copy of the frame that is shown. */
  readonly laid: number;
}

/** A text that the voice says or is going to say. */
interface Saying {
  readonly text: SpokenText;
  readonly words: readonly Word[];
  /** The word with which it begins. */
  readonly first: number;
  utterance: SpeechSynthesisUtterance | null;
  begun: number;
  reached: number;
}

/**
 * Says the text of a stream by the browser's own voice (Web Speech), and makes the face that says it: it follows the voice word by
 * word, by what the voice tells of its boundaries.
 *
 *     const client = new StreamClient(url);
 *     const player = new Player(kernel, { overlay: (runtime, frame) => speech.show(runtime, frame) });
 *     const speech = new StreamSpeech(client);
 *     button.onclick = () => speech.start();  // browsers ask for a tap
 *
 * Without a voice of the language, or when it does not speak, the server sends frames as before, and sound if the client asked for it.
 */
export class StreamSpeech extends Emitter<{ state: SpeechState }> {
  state: SpeechState = 'off';

  private readonly waiting: Saying[] = [];
  private saying: Saying | null = null;
  private newest = 0;
  private epoch = NaN;
  private rate = 1;
  private told = -Infinity;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private starter: ReturnType<typeof setTimeout> | undefined;
  private memory: SpeakerMemory | null = null;
  private isDisposed = false;
  private readonly stops: (() => void)[];

  constructor(
    private readonly client: StreamClient,
    /** ms behind the stream's clock at which the page shows faces */
    private readonly delay: () => number = () => 0,
    private readonly synthesis: SpeechSynthesis | undefined = globalThis.speechSynthesis,
    private readonly now: () => number = () => performance.now(),
    private readonly load: () => Promise<SpeakerLibrary> = loadSpeakers,
  ) {
    super();
    this.stops = [
      client.on('text', (text) => this.take(text)),
      client.on('header', ({ epoch }) => {
        if (epoch !== this.epoch) {
          this.silence(); // other texts, with numbers of their own
          this.newest = 0;
        }
        this.epoch = epoch;
      }),
      client.on('end', () => this.silence()),
    ];
  }

  static get isSupported(): boolean {
    return typeof speechSynthesis === 'object' && typeof SpeechSynthesisUtterance === 'function';
  }

  /** To call by a tap or a key. Whether text is asked for now: false where the browser has no voice, or the library is not loaded. */
  async start(): Promise<boolean> {
    if (!this.synthesis || (await voicesOf(this.synthesis)).length === 0 || !(await this.prepare())) {
      this.become('failed');
      return false;
    }
    this.become('ready');
    this.client.spoken('ready');
    return true;
  }

  /** Frames again; what is being said stops. */
  stop(): void {
    if (this.state !== 'ready') return;
    this.silence();
    this.become('off');
    this.client.spoken('failed');
  }

  dispose(): void {
    for (const stop of this.stops) stop();
    this.silence();
    this.isDisposed = true;
    this.memory = null; // the library is this object's own
  }

  /** For the option `overlay` of the player: the mouth that speaks, in a frame of the library. False: nothing is said. */
  show(runtime: Runtime, frame: number): boolean {
    const { memory } = this;
    if (memory === null) return false;
    const { library, speaker, laid } = memory;
    library.bytes.set(runtime.bytes.subarray(frame, frame + frameLayout.bytes), laid);
    if (library.functions.semblante_speaker_show(speaker, this.now(), laid) === 0) return false;
    runtime.bytes.set(library.bytes.subarray(laid, laid + frameLayout.bytes), frame);
    return true;
  }

  private become(state: SpeechState): void {
    if (state === this.state) return;
    this.state = state;
    this.emit('state', state);
  }

  private fail(): void {
    if (this.state !== 'ready') return;
    this.silence();
    this.become('failed');
    this.client.spoken('failed');
  }

  private silence(): void {
    clearTimeout(this.timer);
    this.timer = undefined;
    this.waiting.length = 0;
    if (this.saying === null) return;
    this.finish(this.saying);
    this.synthesis?.cancel();
  }

  private take(text: SpokenText): void {
    if (this.state !== 'ready' || text.speech <= this.newest) return; // known: after a new connection it comes again
    this.newest = text.speech;
    if (text.text === '') return this.silence();
    const words = wordsOf(text.text);
    const times = wordTimes(text.score);
    const shown = this.shown();
    const first = times.findIndex((time) => !(text.mediaTime + time < shown - latest));
    if (first < 0) return;
    this.waiting.push({ text, words, first, utterance: null, begun: NaN, reached: -1 });
    this.schedule();
  }

  /** The media time that the page shows. */
  private shown(): number {
    const delay = this.delay();
    return this.client.streamClock.mediaTime - (Number.isFinite(delay) ? delay : 0);
  }

  /** The next text begins at its time, or when the one before it has been said. */
  private schedule(): void {
    const [next] = this.waiting;
    if (this.saying || !next || this.timer !== undefined) return;
    const wait = next.text.mediaTime + (wordTimes(next.text.score)[next.first] ?? 0) - this.shown();
    this.timer = setTimeout(() => {
      this.timer = undefined;
      const saying = this.waiting.shift();
      if (saying) this.say(saying);
    }, Number.isFinite(wait) ? Math.max(0, wait) : 0);
  }

  private say(saying: Saying): void {
    const { synthesis } = this;
    const { text, words, first } = saying;
    const voice = synthesis ? voiceFor(synthesis.getVoices(), text.language) : null;
    if (!synthesis || !voice) return this.fail();
    const from = words[first]?.begin ?? 0;
    const utterance = new SpeechSynthesisUtterance(text.text.slice(from));
    utterance.voice = voice;
    utterance.lang = voice.lang;
    utterance.rate = this.rate;
    saying.utterance = utterance;
    this.saying = saying;
    const current = (call: () => void) => (): void => {
      if (this.saying === saying) call();
    };
    utterance.onstart = current(() => this.begin(saying));
    utterance.onboundary = (event) => {
      if (this.saying === saying && event.name !== 'sentence') this.reach(saying, from + event.charIndex);
    };
    utterance.onend = current(() => this.end(saying));
    utterance.onerror = (event) => {
      if (this.saying !== saying) return;
      if (event.error === 'interrupted' || event.error === 'canceled') this.end(saying);
      else this.fail();
    };
    this.starter = setTimeout(current(() => this.fail()), startPatience);
    synthesis.speak(utterance);
  }

  private begin(saying: Saying): void {
    if (!Number.isNaN(saying.begun)) return;
    clearTimeout(this.starter);
    this.starter = setTimeout(() => {
      if (this.saying === saying) this.fail();
    }, startPatience + longest * saying.text.duration);
    saying.begun = this.now();
    if (!this.memory) return;
    const { library, speaker, score } = this.memory;
    library.bytes.set(saying.text.score, score);
    library.functions.semblante_speaker_say(speaker, score, saying.text.score.length, saying.first, saying.begun);
  }

  private reach(saying: Saying, place: number): void {
    this.begin(saying); // some voices tell words before the beginning
    const word = saying.words.findIndex(({ begin, end }) => begin <= place && place < end);
    if (word <= saying.reached) return;
    saying.reached = word;
    const now = this.now();
    if (this.memory) this.memory.library.functions.semblante_speaker_reach(this.memory.speaker, word, now);
    if (now - this.told < tellInterval) return;
    this.told = now;
    this.client.spoken('reached', saying.text.speech, codePoints(saying.text.text, saying.words[word]!.begin));
  }

  private end(saying: Saying): void {
    const took = this.now() - saying.begun;
    this.finish(saying);
    this.client.spoken('ended', saying.text.speech, codePoints(saying.text.text, saying.text.text.length));
    // A voice that needs longer than was estimated would fall behind more with each text.
    const wanted = saying.text.duration - (wordTimes(saying.text.score)[saying.first] ?? 0);
    if (took > 0 && wanted > 500) this.rate = Math.min(fastest, Math.max(slowest, (this.rate * took) / wanted));
    this.schedule();
  }

  private finish(saying: Saying): void {
    clearTimeout(this.starter);
    if (saying === this.saying) this.saying = null;
    if (this.memory) this.memory.library.functions.semblante_speaker_end(this.memory.speaker, this.now());
  }

  /** Whether the library is there. */
  private async prepare(): Promise<boolean> {
    if (this.memory) return true;
    try {
      const library = await this.load();
      const seed = Math.floor(Math.random() * 4294967296);
      const speaker = library.made((handle, error) => library.functions.semblante_speaker_create(seed, handle, error), refused);
      if (this.isDisposed) return false;
      this.memory = { library, speaker, score: library.alloc(largestScore), laid: library.alloc(frameLayout.bytes) };
      return true;
    } catch {
      return false;
    }
  }
}

const refused = (_: number, where: string, words: string): Error => new Error(`${where}: ${words}`);

/** The browser's voices; some browsers know them only after a while. */
async function voicesOf(synthesis: SpeechSynthesis): Promise<SpeechSynthesisVoice[]> {
  if (synthesis.getVoices().length === 0) {
    await new Promise<void>((wake) => {
      const timer = setTimeout(wake, voicesPatience);
      synthesis.addEventListener('voiceschanged', () => (clearTimeout(timer), wake()), { once: true });
    });
  }
  return synthesis.getVoices();
}

/** A voice of the language, one of the region and of this device first; of an unknown language the browser's usual one. */
export function voiceFor(voices: readonly SpeechSynthesisVoice[], language: string): SpeechSynthesisVoice | null {
  const tag = (of: string): string => of.toLowerCase().replaceAll('_', '-');
  const wanted = tag(language);
  const [primary] = wanted.split('-');
  const points = (voice: SpeechSynthesisVoice): number => {
    const has = tag(voice.lang);
    if (wanted !== '' && has.split('-')[0] !== primary) return -1;
    return (has === wanted ? 4 : 0) + (voice.localService ? 2 : 0) + (voice.default ? 1 : 0);
  };
  const best = [...voices].sort((a, b) => points(b) - points(a))[0];
  return best && points(best) >= 0 ? best : null;
}

/** How many code points a text has before a place in UTF-16 units. */
function codePoints(text: string, place: number): number {
  return Array.from(text.slice(0, place)).length;
}
