import type { Api } from '../../net/api.ts';
import { problemOf, wordsOf } from '../../net/problem.ts';
import type { Playing, Recording, StreamSpeech } from '../../net/types.ts';
import type { LiveModel } from '../live/live_model.ts';
import { messageOf } from '../shared/message_of.ts';
import { Signal } from '../shared/signal.ts';
import { t } from '../../words/words.ts';

export type StreamSpeechState =
  | { kind: 'off' }
  | { kind: 'starting' }
  | { kind: 'speaking'; stream: string; recording: Recording | null }
  /** `failure`: why not all of it was said; null: all was. */
  | { kind: 'done'; recording: Recording | null; failure: string | null }
  | { kind: 'failed'; message: string };

/** ms between two looks at whether it still speaks. */
const lookInterval = 500;

/** Lets the face of a stream say a text, which this page follows with its sound, and records it. */
export class StreamSpeechModel {
  readonly state = new Signal<StreamSpeechState>({ kind: 'off' });
  /** Id of the stream that speaks; empty: one for this head, created if there is none. */
  readonly target = new Signal('');
  /** Whether what is said is recorded. */
  readonly records = new Signal(true);
  private playing: Playing | null = null;
  /** The stored speech that is said; null: a text. */
  private speech: string | null = null;
  private watch: ReturnType<typeof setInterval> | null = null;

  constructor(
    private readonly api: Pick<Api, 'speakIntoStream' | 'stopPlaying' | 'startRecording' | 'stopRecording' | 'deleteRecording' | 'deleteSpeech'>,
    private readonly live: LiveModel,
  ) {
    live.following.watch((id) => {
      if (id !== null && live.ownStreams.some((stream) => stream.id === id)) this.target.set(id);
    });
    live.streams.watch((streams) => {
      if (streams !== null && this.target.value !== '' && !streams.some(({ id }) => id === this.target.value)) this.target.set('');
    });
  }

  /**
   * Has it said; call by a tap or a key, because browsers let nothing be heard before. `make` gives what to say. Resolves, when it
   * begins, with the reason if another source holds the stream, else null.
   */
  async say(make: () => Promise<StreamSpeech>, takeOver: boolean): Promise<string | null> {
    if (this.state.value.kind === 'starting') return null;
    await this.end();
    this.state.set({ kind: 'starting' });
    this.live.sound.set(true);
    let recording: Recording | null = null;
    let held: string | null = null;
    try {
      const speech = await make();
      this.speech = speech.speech ?? null;
      const stream = await this.live.openFor(this.target.value);
      if (stream === null) throw new Error(t('The stream was not created'));
      this.target.set(stream);
      if (this.records.value) recording = await this.api.startRecording(stream);
      this.playing = await this.api.speakIntoStream(stream, { ...speech, take_over: takeOver });
      this.state.set({ kind: 'speaking', stream, recording });
      this.watch = setInterval(() => void this.look(), lookInterval);
      await this.live.refresh();
    } catch (error) {
      if (recording) await this.drop(recording);
      this.forget();
      const problem = problemOf(error);
      await this.live.refresh();
      const taken = this.live.streams.value?.some(({ id, active_source }) => id === this.target.value && active_source !== null);
      if (problem.status === 409 && !takeOver && taken) held = wordsOf(problem);
      this.state.set(held === null ? { kind: 'failed', message: messageOf(error) } : { kind: 'off' });
    }
    return held;
  }

  /** Stops what is being said; its recording is kept. */
  async stop(): Promise<void> {
    await this.end();
    await this.live.refresh();
  }

  /** The page closes: its recording ends. */
  leave(): void {
    const { value: state } = this.state;
    if (state.kind === 'speaking' && state.recording) void this.api.stopRecording(state.recording.id, true).catch(() => undefined);
  }

  private async end(): Promise<void> {
    const { playing, state } = this;
    if (!playing || state.value.kind !== 'speaking') return;
    // One that has ended by itself meanwhile is no fault.
    await this.api.stopPlaying(state.value.stream, playing.id).catch(() => undefined);
    await this.finish(null);
  }

  private async look(): Promise<void> {
    const { playing } = this;
    await this.live.refresh();
    const { value: state } = this.state;
    if (state.kind !== 'speaking' || playing === null || playing !== this.playing || this.live.problem.value) return;
    const stream = this.live.streams.value?.find(({ id }) => id === state.stream);
    if (stream?.playing?.id === playing.id) return;
    await this.finish(stream?.failed?.id === playing.id ? stream.failed.failure : null);
  }

  private async finish(failure: string | null): Promise<void> {
    const { value: state } = this.state;
    if (state.kind !== 'speaking' || this.playing === null) return;
    this.playing = null;
    if (this.watch !== null) clearInterval(this.watch);
    let { recording } = state;
    if (recording) recording = await this.api.stopRecording(recording.id).catch(() => recording);
    this.forget();
    this.state.set({ kind: 'done', recording, failure });
  }

  /** A stored speech was made for this page alone. */
  private forget(): void {
    if (this.speech !== null) void this.api.deleteSpeech(this.speech).catch(() => undefined);
    this.speech = null;
  }

  /** Nothing was said: there is nothing to keep. */
  private async drop({ id }: Recording): Promise<void> {
    await this.api.stopRecording(id).then(
      () => this.api.deleteRecording(id),
      () => undefined,
    ).catch(() => undefined);
  }
}
