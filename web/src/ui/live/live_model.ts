import { problemOf } from '../../net/problem.ts';
import { LivePublisher, LiveSubscriber, type LinkStatus, type LiveStats } from '../../net/live.ts';
import type { Problem, StreamInfo, NewStream } from '../../net/types.ts';
import type { FaceFrame } from '@client/index.ts';
import type { FaceDriver } from '../stage/face_driver.ts';
import { Signal } from '../shared/signal.ts';
import type { Studio } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

const off: LinkStatus = { kind: 'off' };
const noStats: LiveStats = { framesPerSecond: 0, bytesPerSecond: 0, mediaTime: null, sequence: 0, dropped: 0 };

/** ms that a speech waits for the sound of this page to begin: a browser may never allow it. */
const soundPatience = 5000;

/** Streams to choose from: their ids and what they are called. */
export const streamOptions = (streams: readonly StreamInfo[]): [id: string, name: string][] => streams.map(({ id, title }) => [id, title || id]);

/** All streams, the stream that this page subscribes to, and the stream that the sliders are published to. */
export class LiveModel {
  /** null until the first response. */
  readonly streams = new Signal<readonly StreamInfo[] | null>(null);
  readonly problem = new Signal<Problem | null>(null);
  readonly following = new Signal<string | null>(null);
  readonly status = new Signal<LinkStatus>(off);
  readonly sending = new Signal<string | null>(null);
  readonly sendStatus = new Signal<LinkStatus>(off);
  readonly subscriber = new Signal<LiveSubscriber | null>(null);
  /** Whether streams are to be heard. Only a subscription made since then has sound: it takes twenty times the bytes of the face. */
  readonly sound = new Signal(false);
  /** Resolves when the followed stream is heard, or cannot be. */
  untilHeard = (): Promise<void> => Promise.resolve();
  private publisher: LivePublisher | null = null;
  /** The streams that this page has created to play into. */
  private readonly made = new Set<string>();

  constructor(
    private readonly studio: Studio,
    /** The frame set with the sliders; published while `sending` names a stream. */
    private readonly frame: FaceFrame,
    readonly driver: FaceDriver,
  ) {}

  get stats(): LiveStats {
    return this.subscriber.value?.stats ?? noStats;
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
    this.subscriber.value?.close();
    this.following.set(id);
    this.driver.byStream();
    const subscriber = new LiveSubscriber(this.studio.api.streamUrl(id), title, (status) => {
      if (this.subscriber.value === subscriber) this.status.set(status);
    }, this.sound.value);
    this.subscriber.set(subscriber);
    subscriber.open();
    void this.refresh();
  }

  /** Lets the followed stream be heard, or not. Call by a tap or a key: browsers let nothing be heard before. */
  listen(on: boolean): void {
    this.sound.set(on);
    const { following } = this;
    if (on && following.value !== null && !this.hasWantedSound) this.subscribe(following.value, this.titleOf(following.value));
  }

  /** The stream that shows what the server can do; null where it has none, or before the first response. */
  get demo(): StreamInfo | null {
    return this.streams.value?.find((stream) => stream.source === 'demo') ?? null;
  }

  /** Streams that may be played into: all except the demo, which all users share. */
  get ownStreams(): readonly StreamInfo[] {
    return (this.streams.value ?? []).filter((stream) => stream.source !== 'demo');
  }

  titleOf(id: string): string {
    return this.streams.value?.find((stream) => stream.id === id)?.title || id;
  }

  /** Subscribes to the stream to play into (`target` empty: one for this head, created if needed). Returns its id. */
  async openFor(target: string): Promise<string | null> {
    let id: string | null = target;
    if (id === '') {
      // A free stream of an earlier visit is reused, so that streams do not accumulate.
      const title = t('{name}, performing', { name: this.studio.selected.value?.name ?? t('Head') });
      const model = this.studio.selected.value?.id ?? null;
      const free = (stream: StreamInfo): boolean => stream.publishers === 0 && !stream.playing && stream.model === model;
      id = this.ownStreams.find((stream) => stream.title === title && free(stream))?.id ?? null;
      if (id === null) {
        id = await this.create(title);
        if (id === null) return null;
        this.made.add(id);
      }
    }
    if (this.following.value === id && this.status.value.kind !== 'ended' && this.hasWantedSound) this.driver.byStream();
    else this.subscribe(id, this.titleOf(id));
    await this.opened();
    // What is played before the page can be heard is lost, and a short speech would be over.
    if (this.sound.value) await Promise.race([this.untilHeard(), new Promise((wake) => setTimeout(wake, soundPatience))]);
    return id;
  }

  private get hasWantedSound(): boolean {
    return !this.sound.value || this.subscriber.value?.hasSound !== false;
  }

  /** Resolves when the subscription is open, or after a timeout of `patience` ms. */
  async opened(patience = 2000): Promise<void> {
    const end = performance.now() + patience;
    while (this.status.value.kind !== 'open' && performance.now() < end)
      await new Promise((wake) => setTimeout(wake, 20));
  }

  unsubscribe(): void {
    this.subscriber.value?.close();
    this.subscriber.set(null);
    this.following.set(null);
    this.status.set(off);
    this.driver.release('stream');
    void this.refresh();
  }

  async create(title: string, options: NewStream = {}): Promise<string | null> {
    let id: string | null = null;
    await this.studio.attempt(t('The stream was not created'), async () => {
      id = (await this.studio.api.createStream(title, this.studio.selected.value?.id ?? null, options)).id;
      await this.refresh();
    });
    return id;
  }

  async remove(id: string): Promise<void> {
    if (this.following.value === id) this.unsubscribe();
    if (this.sending.value === id) this.send(null);
    await this.studio.attempt(t('The stream was not deleted'), () => this.studio.api.deleteStream(id));
    await this.refresh();
  }

  /** Whether a stream ends with this page: one that it created to play into, which nobody else watches or feeds. A loop goes on. */
  private endsWithPage({ id, subscribers, publishers, playing }: StreamInfo): boolean {
    const own = this.following.value === id ? 1 : 0;
    return this.made.has(id) && subscribers <= own && publishers === 0 && playing?.loop !== true;
  }

  /** Whether it is to be known who watches the streams: some may end with this page. */
  get hasMade(): boolean {
    return this.made.size > 0;
  }

  /** The page closes. */
  leave(): void {
    for (const stream of this.streams.value ?? [])
      if (this.endsWithPage(stream)) void this.studio.api.deleteStream(stream.id, true).catch(() => undefined);
  }

  /** Starts (id) or stops (null) publishing the frame set with the sliders. */
  send(id: string | null): void {
    this.publisher?.close();
    this.publisher = null;
    this.sendStatus.set(off);
    this.sending.set(id);
    if (id === null) return;
    const publisher = new LivePublisher(this.studio.api.streamUrl(id), this.frame, (status) => {
      if (this.publisher !== publisher) return;
      this.sendStatus.set(status);
      if (status.kind === 'ended') this.sending.set(null);
    });
    this.publisher = publisher;
    publisher.open();
  }

  /** Call after each change of the frame; `time`: the moment that it shows, by performance.now(). */
  touch(time?: number): void {
    this.publisher?.touch(time);
  }

  /** Sends an Opus packet of a voice with the frame, if that is published. */
  say(packet: Uint8Array, time: number): void {
    this.publisher?.say(packet, time);
  }
}
