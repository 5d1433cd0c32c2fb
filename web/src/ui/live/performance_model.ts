import { problemOf } from '../../net/problem.ts';
import type { AbsentFap, FapPlaying, Playing, PlayOptions, Problem, StreamInfo } from '../../net/types.ts';
import { excerptAt, type ExcerptLine } from '../documents/document_place.ts';
import type { LiveModel } from './live_model.ts';
import { Signal } from '../shared/signal.ts';
import type { Studio } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

/** The text of a document or file to play. */
export interface Script {
  kind: 'performance' | 'fap';
  title: string;
  text: string;
}

/** The server's reason for not playing a script. */
export interface Refusal {
  problem: Problem;
  excerpt: ExcerptLine[];
  /** The present source of the stream, when that is the reason; else null. */
  holder: string | null;
}

/** A performance document or .fap file, the target stream, and the playback state on the server. */
export class PerformanceModel {
  readonly script = new Signal<Script | null>(null);
  /** Id of the target stream; empty: a new stream. */
  readonly target = new Signal('');
  /** The playback into the target stream, started by any client. */
  readonly playing = new Signal<Playing | null>(null);
  readonly refusal = new Signal<Refusal | null>(null);
  readonly busy = new Signal(false);
  /** The value of a FAP that a frame of a .fap file omits. */
  readonly absent = new Signal<AbsentFap>('zero');
  /** The server's warnings about the played .fap file. */
  readonly warnings = new Signal<readonly string[]>([]);
  loop = false;
  /** Start position, ms. */
  from = 0;
  private heard = 0;
  private own: string | null = null;

  constructor(
    private readonly studio: Studio,
    private readonly live: LiveModel,
    private readonly now: () => number = () => performance.now(),
  ) {
    live.following.watch((id) => {
      if (id !== null && this.ownStreams.some((stream) => stream.id === id)) this.target.set(id);
    });
    live.streams.watch((streams) => {
      if (streams !== null && this.target.value !== '' && !streams.some(({ id }) => id === this.target.value))
        this.target.set('');
      this.hear();
    });
    this.target.watch(() => {
      this.refusal.set(null);
      this.hear();
    });
  }

  get ownStreams(): readonly StreamInfo[] {
    return this.live.ownStreams;
  }

  /** Whether this page started the current playback with the current script, so that it may seek and restart it. */
  get mine(): boolean {
    return this.own !== null && this.playing.value?.id === this.own;
  }

  /** Playback position, ms, extrapolated from the server's last response. */
  get position(): number {
    const playing = this.playing.value;
    if (!playing) return 0;
    const position = playing.position + this.now() - this.heard;
    if (playing.duration === null || playing.duration <= 0) return position;
    return playing.loop ? position % playing.duration : Math.min(position, playing.duration);
  }

  choose(script: Script): void {
    this.own = null;
    this.refusal.set(null);
    this.warnings.set([]);
    this.script.set(script);
  }

  async play(options: Partial<PlayOptions> = {}): Promise<void> {
    const script = this.script.value;
    if (!script || this.busy.value) return;
    this.refusal.set(null);
    this.busy.set(true);
    try {
      const stream = await this.openTarget();
      if (stream === null) return;
      // This page's own playback may be replaced without a question to the user.
      const whole = { loop: this.loop, from: this.from, take_over: this.mine, ...options };
      const { api } = this.studio;
      const body = new Blob([script.text]);
      const playing: Playing & Partial<FapPlaying> = await (script.kind === 'fap'
        ? api.playFap(stream, body, whole, this.absent.value)
        : api.playPerformance(stream, body, whole));
      this.own = playing.id;
      this.warnings.set(playing.warnings ?? []);
      this.take(playing);
    } catch (error) {
      const problem = problemOf(error);
      await this.live.refresh();
      this.refusal.set({
        problem,
        excerpt: excerptAt(script.text, problem.pointer),
        holder: problem.status === 409 ? this.holder() : null,
      });
    } finally {
      this.busy.set(false);
    }
    await this.live.refresh();
  }

  async stop(): Promise<void> {
    const playing = this.playing.value;
    if (!playing) return;
    await this.studio.attempt(t('The performance was not stopped'), () =>
    this.studio.api.stopPlaying(this.target.value, playing.id),
    );
    await this.live.refresh();
  }

  /** Call a few times a second: refreshes the state when a performance has reached its end. */
  tick(): void {
    const playing = this.playing.value;
    if (playing && !playing.loop && playing.duration !== null && this.position >= playing.duration) {
      this.take(null);
      void this.live.refresh();
    }
  }

  private async openTarget(): Promise<string | null> {
    const id = await this.live.openFor(this.target.value);
    if (id !== null) this.target.set(id);
    return id;
  }

  private hear(): void {
    const stream = this.live.streams.value?.find(({ id }) => id === this.target.value);
    this.take(stream?.playing ?? null);
  }

  private take(playing: Playing | null): void {
    this.heard = this.now();
    this.playing.set(playing);
  }

  private holder(): string {
    const id = this.target.value;
    if (this.playing.value) return t('“{performance}” plays into this stream.', { performance: this.playing.value.name || t('A performance') });
    if (this.live.sending.value === id) return t('You publish your sliders to this stream.');
    return t('Another client publishes to this stream.');
  }
}
