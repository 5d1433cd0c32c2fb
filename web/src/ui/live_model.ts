import { problemOf } from '../net/problem.ts';
import { LivePublisher, LiveSubscriber, type LinkStatus, type LiveStats } from '../net/live.ts';
import type { Problem, StreamInfo } from '../net/types.ts';
import type { FaceFrame } from '../face/frame.ts';
import { Signal } from './signal.ts';
import type { Studio } from './studio.ts';

const off: LinkStatus = { kind: 'off' };
const noStats: LiveStats = { framesPerSecond: 0, bytesPerSecond: 0, latencyMs: null, sequence: 0 };

/** The stream the face follows, the one the sliders feed, and the list of all. */
export class LiveModel {
  /** null until the first answer. */
  readonly streams = new Signal<readonly StreamInfo[] | null>(null);
  readonly problem = new Signal<Problem | null>(null);
  readonly following = new Signal<string | null>(null);
  readonly status = new Signal<LinkStatus>(off);
  readonly sending = new Signal<string | null>(null);
  readonly sendStatus = new Signal<LinkStatus>(off);
  /** Whether the face shows the stream (or what is done by hand, while the stream goes on underneath). */
  readonly driving = new Signal(false);
  /** What the stream says now, to be sampled once per displayed frame. */
  subscriber: LiveSubscriber | null = null;
  private publisher: LivePublisher | null = null;

  constructor(private readonly studio: Studio) {}

  get stats(): LiveStats {
    return this.subscriber?.stats ?? noStats;
  }

  async refresh(): Promise<void> {
    try {
      const streams = await this.studio.api.listStreams();
      this.problem.set(null);
      if (JSON.stringify(streams) !== JSON.stringify(this.streams.value)) this.streams.set(streams);
    } catch (error) {
      this.problem.set(problemOf(error));
    }
  }

  subscribe(id: string, title: string): void {
    this.subscriber?.close();
    this.following.set(id);
    this.driving.set(true);
    const subscriber = new LiveSubscriber(this.studio.api.streamUrl(id), title, (status) => {
      if (this.subscriber === subscriber) this.status.set(status);
    });
    this.subscriber = subscriber;
    subscriber.open();
    void this.refresh();
  }

  unsubscribe(): void {
    this.subscriber?.close();
    this.subscriber = null;
    this.following.set(null);
    this.status.set(off);
    this.driving.set(false);
    void this.refresh();
  }

  async create(title: string): Promise<string | null> {
    let id: string | null = null;
    await this.studio.attempt('The stream was not made', async () => {
      id = (await this.studio.api.createStream(title, this.studio.selected.value?.id ?? null)).id;
      await this.refresh();
    });
    return id;
  }

  async remove(id: string): Promise<void> {
    if (this.following.value === id) this.unsubscribe();
    if (this.sending.value === id) this.send(null);
    await this.studio.attempt('The stream was not deleted', () => this.studio.api.deleteStream(id));
    await this.refresh();
  }

  /** Starts or stops sending the frames of `publish`. */
  send(id: string | null): void {
    this.publisher?.close();
    this.publisher = null;
    this.sendStatus.set(off);
    this.sending.set(id);
    if (id === null) return;
    const publisher = new LivePublisher(this.studio.api.streamUrl(id), (status) => {
      if (this.publisher !== publisher) return;
      this.sendStatus.set(status);
      if (status.kind === 'ended') this.sending.set(null);
    });
    this.publisher = publisher;
    publisher.open();
  }

  publish(frame: FaceFrame): void {
    this.publisher?.push(frame);
  }
}
