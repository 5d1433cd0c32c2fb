import { Performance, type Library } from '@client/motion/index.ts';
import { PerformanceClip } from '../../face/performance_clip.ts';
import type { SpokenClip } from '../../face/speech_clock.ts';
import type { Api } from '../../net/api.ts';
import type { Speech, SpeechRequest, Timeline } from '../../net/types.ts';
import { messageOf } from '../shared/message_of.ts';
import { Signal } from '../shared/signal.ts';
import type { FaceDriver } from '../stage/face_driver.ts';
import { t } from '../../words/words.ts';

/** What the panel needs of an audio element: its clock is that of the face. */
export type Sound = Pick<HTMLAudioElement, 'src' | 'currentTime' | 'paused' | 'play' | 'pause' | 'addEventListener'>;

export type SpeakState =
  | { kind: 'empty' }
  | { kind: 'making' }
  | { kind: 'ready'; speech: Speech; timeline: Timeline }
  | { kind: 'failed'; message: string };

/** Has texts spoken by the server, and plays their sound together with the face on this page. */
export class SpeakModel {
  readonly state = new Signal<SpeakState>({ kind: 'empty' });
  readonly playing = new Signal(false);
  private clip: SpokenClip | null = null;
  private made: Speech | null = null;
  private newest = 0;

  /** `load` gives the library that evaluates performances. */
  constructor(
    private readonly api: Pick<Api, 'createSpeech' | 'speechTimeline' | 'speechPerformance' | 'speechUrl' | 'deleteSpeech'>,
    private readonly driver: FaceDriver,
    private readonly sound: Sound,
    private readonly load: () => Promise<Library>,
  ) {
    sound.addEventListener('ended', () => this.stop());
    sound.addEventListener('error', () => {
      if (this.clip) this.fail(t('The sound cannot be played.'));
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
  async say(request: SpeechRequest): Promise<void> {
    const number = (this.newest += 1);
    this.stop();
    this.clip = null;
    this.forget();
    this.state.set({ kind: 'making' });
    let speech: Speech | null = null;
    try {
      const library = await this.load();
      speech = await this.api.createSpeech(request);
      const [timeline, document] = await Promise.all([
        this.api.speechTimeline(speech.id),
        this.api.speechPerformance(speech.id),
      ]);
      if (number !== this.newest) return this.remove(speech);
      this.made = speech;
      this.clip = { clip: new PerformanceClip(new Performance(library, document)), now: () => this.position };
      this.sound.src = this.api.speechUrl(speech.id, 'audio');
      this.state.set({ kind: 'ready', speech, timeline });
      await this.play();
    } catch (error) {
      if (number === this.newest) this.fail(messageOf(error));
      if (speech !== null && speech !== this.made) this.remove(speech);
    }
  }

  /** From the beginning. */
  async play(): Promise<void> {
    const { clip } = this;
    if (!clip) return;
    this.sound.currentTime = 0;
    await this.sound.play();
    if (clip !== this.clip) return; // another one was made meanwhile
    this.driver.bySpeech(clip);
    this.playing.set(true);
  }

  stop(): void {
    this.silence();
    this.driver.release('speech');
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
    if (this.made) this.remove(this.made);
    this.made = null;
  }

  private fail(message: string): void {
    this.stop();
    this.clip = null;
    this.forget();
    this.state.set({ kind: 'failed', message });
  }
}
