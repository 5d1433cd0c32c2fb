import { problemOf, wordsOf } from '../../net/problem.ts';
import { recordingEndings } from '../../net/recording_endings.ts';
import type { Problem, Recording, RecordingFormat } from '../../net/types.ts';
import type { FaceDriver } from '../stage/face_driver.ts';
import { formatTime } from '../shared/format.ts';
import type { LiveModel } from '../live/live_model.ts';
import { Signal } from '../shared/signal.ts';
import type { Studio } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

/** A moment of a recording that is displayed. */
export interface ShownMoment {
  id: string;
  /** ms after the first frame. */
  at: number;
}

/** Recordings: start and stop, play, show single moments, download. */
export class RecordingsModel {
  /** Id of the stream whose recordings are listed; empty: all streams, including deleted ones. */
  readonly stream = new Signal('');
  /** Newest first; null until the first response. */
  readonly recordings = new Signal<readonly Recording[] | null>(null);
  readonly problem = new Signal<Problem | null>(null);
  /** Id of the stream to play into; empty: a new stream. */
  readonly target = new Signal('');
  /** The request in progress: the id of its recording, or `record`; null: none. */
  readonly busy = new Signal<string | null>(null);
  readonly look = new Signal<ShownMoment | null>(null);
  private looking = false;

  constructor(
    private readonly studio: Studio,
    private readonly live: LiveModel,
    private readonly driver: FaceDriver,
    private readonly save: (blob: Blob, name: string) => void,
  ) {
    driver.onTake((source) => {
      if (source !== 'recording') this.look.set(null);
    });
    live.following.watch((id) => {
      if (id === null) return;
      this.stream.set(id);
      if (live.ownStreams.some((stream) => stream.id === id)) this.target.set(id);
    });
    live.streams.watch((streams) => {
      const gone = (id: string): boolean => id !== '' && streams !== null && !streams.some((one) => one.id === id);
      if (gone(this.stream.value)) this.stream.set('');
      if (gone(this.target.value)) this.target.set('');
    });
    this.stream.watch(() => {
      this.recordings.set(null);
      void this.refresh();
    });
  }

  get running(): readonly Recording[] {
    return (this.recordings.value ?? []).filter(({ state }) => state === 'recording');
  }

  async refresh(): Promise<void> {
    const stream = this.stream.value;
    try {
      const recordings = (await this.studio.api.listRecordings(stream === '' ? null : stream)).reverse();
      if (stream !== this.stream.value) return;
      this.problem.set(null);
      if (JSON.stringify(recordings) !== JSON.stringify(this.recordings.value)) this.recordings.set(recordings);
    } catch (error) {
      if (stream === this.stream.value) this.problem.set(problemOf(error));
    }
  }

  async record(): Promise<void> {
    await this.work('record', t('The recording was not started'), async () => {
      await this.studio.api.startRecording(this.stream.value);
    });
  }

  async stop(recording: Recording): Promise<void> {
    await this.work('record', t('The recording was not stopped'), async () => {
      await this.studio.api.stopRecording(recording.id);
    });
  }

  async remove(recording: Recording): Promise<void> {
    await this.work(recording.id, t('{name} was not deleted', { name: recording.name }), () =>
      this.studio.api.deleteRecording(recording.id),
    );
  }

  /** Plays a recording into the target. Resolves with the reason when another source holds the stream, else null. */
  async play(recording: Recording, takeOver: boolean): Promise<string | null> {
    let held: string | null = null;
    await this.work(recording.id, t('{name} was not played', { name: recording.name }), async () => {
      const stream = await this.live.openFor(this.target.value);
      if (stream === null) return;
      this.target.set(stream);
      try {
        await this.studio.api.playRecording(stream, recording.id, { loop: false, from: 0, take_over: takeOver });
        this.driver.byStream();
      } catch (error) {
        const problem = problemOf(error);
        // Other conflicts concern the recording itself and are not resolved by taking the stream over.
        await this.live.refresh();
        if (problem.status !== 409 || takeOver || !this.taken(stream)) throw error;
        held = wordsOf(problem);
      }
      await this.live.refresh();
    });
    return held;
  }

  async stopPlaying(): Promise<void> {
    const stream = this.live.streams.value?.find(({ id }) => id === this.target.value);
    const playing = stream?.playing;
    if (!playing) return;
    await this.studio.attempt(t('The playback was not stopped'), () => this.studio.api.stopPlaying(stream.id, playing.id));
    await this.live.refresh();
  }

  async download(recording: Recording, format: RecordingFormat): Promise<void> {
    const model = this.studio.selected.value?.id ?? null;
    await this.work(recording.id, t('{name} was not downloaded', { name: recording.name }), async () => {
      const content = await this.studio.api.recordingContent(recording.id, format, model);
      this.save(content, `${fileName(recording.name)}${recordingEndings[format]}`);
    });
  }

  /** Shows a moment, on this page only. Calls during a pending request replace each other; the newest is shown. */
  async lookAt(recording: Recording, at: number): Promise<void> {
    this.look.set({ id: recording.id, at });
    if (this.looking) return;
    this.looking = true;
    await this.studio.attempt(t('That moment cannot be shown'), async () => {
      for (let shown: ShownMoment | null = null; this.look.value && shown !== this.look.value; ) {
        shown = this.look.value;
        const frame = await this.studio.api.recordedFrame(shown.id, shown.at);
        if (this.look.value) this.driver.byRecording(frame);
      }
    });
    this.looking = false;
  }

  /** Description of the displayed moment; null when none is displayed. */
  get looksAt(): string | null {
    const look = this.look.value;
    if (!look) return null;
    const name = this.recordings.value?.find(({ id }) => id === look.id)?.name ?? t('Recording');
    // The time comes first, because a long name is truncated.
    return t('{at} of {name}', { at: formatTime(look.at), name });
  }

  private taken(id: string): boolean {
    const stream = this.live.streams.value?.find((one) => one.id === id);
    return stream !== undefined && stream.active_source !== null;
  }

  private async work(what: string, failed: string, action: () => Promise<void>): Promise<void> {
    if (this.busy.value !== null) return;
    this.busy.set(what);
    await this.studio.attempt(failed, action);
    this.busy.set(null);
    await this.refresh();
  }
}

/** Converts a title to a file name that is valid on every file system. */
const fileName = (name: string): string =>
  name
    .replaceAll(/[^\p{L}\p{N}._ -]+/gu, '-')
    .slice(0, 80)
    .trim() || 'recording';
