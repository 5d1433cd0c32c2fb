import { Performance, type Library } from '@client/motion/index.ts';
import { PerformanceClip } from '../../face/performance_clip.ts';
import type { SpokenClip } from '../../face/speech_clock.ts';
import type { Api } from '../../net/api.ts';
import type { RecordingRequest, Speech, SpeechRequest, Timeline } from '../../net/types.ts';
import { messageOf } from '../shared/message_of.ts';
import { Signal } from '../shared/signal.ts';
import type { FaceDriver } from '../stage/face_driver.ts';
import { t } from '../../words/words.ts';

/** What the panel needs of an audio element: its clock is that of the face. */
export type Sound = Pick<HTMLAudioElement, 'src' | 'currentTime' | 'paused' | 'play' | 'pause' | 'load' | 'removeAttribute' | 'addEventListener'>;

export type SpeakState =
  | { kind: 'empty' }
  | { kind: 'making' }
  | { kind: 'ready'; speech: Speech; timeline: Timeline }
  | { kind: 'failed'; message: string };

/** A speech that is ready to be played. */
interface Take {
  speech: Speech;
  timeline: Timeline;
  clip: SpokenClip;
}

/** A seam is this long before the first word after it, ms. */
const seam = 40;

/**
 * Has texts spoken by the server, and plays their sound together with the face on this page. Of a long text the first sentences
 * are made and played first; the whole is made meanwhile, and goes on where they end: up to there both have the same times.
 */
export class SpeakModel {
  readonly state = new Signal<SpeakState>({ kind: 'empty' });
  readonly playing = new Signal(false);
  private take: Take | null = null;
  /** The whole of the text whose first sentences `take` is. */
  private whole: Promise<Take> | null = null;
  private newest = 0;

  /** `load` gives the library that evaluates performances. */
  constructor(
    private readonly api: Pick<Api, 'createSpeech' | 'createSpeechOfRecording' | 'speechTimeline' | 'speechPerformance' | 'speechUrl' | 'deleteSpeech'>,
    private readonly driver: FaceDriver,
    private readonly sound: Sound,
    private readonly load: () => Promise<Library>,
  ) {
    sound.addEventListener('ended', () => void this.goOn());
    sound.addEventListener('error', () => {
      if (this.take) this.fail(t('The sound cannot be played.'));
    });
    driver.onTake((source) => {
      if (source !== 'speech') this.silence();
    });
  }

  /** ms of the sound. */
  get position(): number {
    return this.sound.currentTime * 1000;
  }

  /** Makes a speech and plays it. What was made before is removed from the server: this page alone knows of it. */
  say(request: SpeechRequest): Promise<void> {
    return this.begin(
      () => this.api.createSpeech({ ...request, part: true }),
      () => this.api.createSpeech(request),
    );
  }

  /** The same of a text that somebody says in a sound file. */
  sayRecording(options: RecordingRequest, sound: File): Promise<void> {
    const create = (): Promise<Speech> => this.api.createSpeechOfRecording(options, sound);
    return this.begin(create, create);
  }

  /** `create`: the speech, or its first sentences; `createWhole`: all of it, when it has a rest. */
  private async begin(create: () => Promise<Speech>, createWhole: () => Promise<Speech>): Promise<void> {
    const number = (this.newest += 1);
    this.stop();
    this.forget();
    this.state.set({ kind: 'making' });
    try {
      const take = await this.make(create, (speech) => {
        // The sound is on its way while its face is fetched.
        if (number === this.newest) this.sound.src = this.api.speechUrl(speech.id, 'audio');
      });
      if (number !== this.newest) return this.remove(take.speech);
      this.take = take;
      this.state.set({ kind: 'ready', speech: take.speech, timeline: take.timeline });
      if (take.speech.rest !== '') this.makeWhole(createWhole, number);
      await this.play();
    } catch (error) {
      if (number === this.newest) this.fail(messageOf(error));
    }
  }

  /** From the beginning; the whole, if it has been made. */
  async play(): Promise<void> {
    const { state, whole } = this;
    const known = state.value.kind === 'ready' && state.value.speech !== this.take?.speech;
    if (whole && known) this.use(await whole);
    await this.playFrom(0);
  }

  stop(): void {
    this.silence();
    this.driver.release('speech');
  }

  /** The page closes: nobody will ask for its speech again. */
  leave(): void {
    this.newest += 1; // one that is being made is removed when it is done
    this.forget();
  }

  private async playFrom(ms: number): Promise<void> {
    const { take } = this;
    if (!take) return;
    this.sound.currentTime = ms / 1000;
    await this.sound.play();
    if (take !== this.take) return; // another one was made meanwhile
    this.driver.bySpeech(take.clip);
    this.playing.set(true);
  }

  /** `onSpeech`: as soon as the server has it. What is made and cannot be used is removed. */
  private async make(create: () => Promise<Speech>, onSpeech?: (speech: Speech) => void): Promise<Take> {
    const library = this.load();
    library.catch(() => undefined); // it is awaited below
    const speech = await create();
    try {
      onSpeech?.(speech);
      const [timeline, document] = await Promise.all([
        this.api.speechTimeline(speech.id),
        this.api.speechPerformance(speech.id),
      ]);
      const clip = new PerformanceClip(new Performance(await library, document), document);
      return { speech, timeline, clip: { clip, now: () => this.position } };
    } catch (error) {
      this.remove(speech);
      throw error;
    }
  }

  private makeWhole(create: () => Promise<Speech>, number: number): void {
    const whole = this.make(create);
    this.whole = whole;
    void whole.then(
      (take) => {
        if (number === this.newest && this.whole === whole)
          this.state.set({ kind: 'ready', speech: take.speech, timeline: take.timeline });
      },
      () => undefined, // goOn() tells it
    );
  }

  /** The sound has ended: that of all, or of the first sentences. */
  private async goOn(): Promise<void> {
    const { take: first, whole } = this;
    if (!first || !whole || !this.playing.value) return this.stop();
    try {
      const take = await whole;
      if (this.whole !== whole) return;
      this.use(take);
      if (!this.playing.value) return;
      const next = take.timeline.words[first.timeline.words.length];
      await this.playFrom(Math.min(first.timeline.duration, next ? next.time - seam : Infinity));
    } catch (error) {
      if (this.whole === whole) this.fail(messageOf(error));
    }
  }

  /** Takes the place of the first sentences. */
  private use(take: Take): void {
    const part = this.take;
    this.take = take;
    this.whole = null;
    this.sound.src = this.api.speechUrl(take.speech.id, 'audio');
    if (part) this.remove(part.speech);
  }

  private silence(): void {
    if (!this.playing.value) return;
    this.sound.pause();
    this.playing.set(false);
  }

  /** The server keeps it until it is removed; one that is gone already is no fault. */
  private remove(speech: Speech): void {
    void this.api.deleteSpeech(speech.id).catch(() => undefined);
  }

  private forget(): void {
    // Before the speech is removed: the browser may still be loading its sound.
    this.sound.removeAttribute('src');
    this.sound.load();
    if (this.take) this.remove(this.take.speech);
    this.whole?.then((take) => this.remove(take.speech), () => undefined);
    this.take = this.whole = null;
  }

  private fail(message: string): void {
    this.stop();
    this.forget();
    this.state.set({ kind: 'failed', message });
  }
}
