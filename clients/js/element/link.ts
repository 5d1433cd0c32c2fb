import { StreamClient, streamUrl } from '../stream_client.ts';
import type { StreamEvents } from '../stream_types.ts';
import { Emitter } from '../emitter.ts';
import type { Source } from './loader.ts';

export type LinkState = 'connecting' | 'open' | 'lost' | 'ended';

/** ms; a stream sends pongs at least every 5 s */
const silence = 12_000;
/** ms to answer after this page has slept, or the network has changed */
const answerTime = 3_000;

/**
 * The connection of a page to its stream. Adds to StreamClient what a page on a phone needs: it notices a connection that
 * is open and dead (the phone slept, the network changed), and connects at once when there is reason to hope.
 */
export class Link extends Emitter<{ state: LinkState }> {
  readonly client: StreamClient;
  state: LinkState = 'connecting';
  private heard = performance.now();
  private readonly timer: ReturnType<typeof setInterval>;
  private answer: ReturnType<typeof setTimeout> | undefined;
  private ended = false;
  private readonly stops: (() => void)[];

  constructor(source: Source, sound: boolean) {
    super();
    const token = source.token === null ? {} : { token: source.token };
    this.client = new StreamClient(streamUrl(source.base, source.stream), { sound, ...token });
    const hear = (): void => {
      this.heard = performance.now();
      clearTimeout(this.answer);
      this.answer = undefined;
    };
    this.stops = [
      this.client.on('message', hear),
      this.client.on('end', ({ reason }) => (this.ended = reason === 'finished' || reason === 'deleted')),
      this.client.on('state', (state) => this.take(state)),
    ];
    this.timer = setInterval(() => {
      if (this.state === 'open' && performance.now() - this.heard > silence) this.renew();
    }, 1000);
  }

  open(): void {
    this.ended = false;
    this.client.connect();
  }

  /** To call when the page is shown again, or the network is back. */
  check(): void {
    if (this.state === 'lost') return this.client.connect();
    if (this.state !== 'open' || this.answer !== undefined) return;
    this.client.measureClock();
    this.answer = setTimeout(() => {
      this.answer = undefined;
      this.renew();
    }, answerTime);
  }

  close(): void {
    clearInterval(this.timer);
    clearTimeout(this.answer);
    for (const stop of this.stops) stop();
    this.client.dispose();
  }

  /** Drops a dead connection, which may not notice for minutes, for a new one that resumes. */
  private renew(): void {
    this.client.close();
    this.client.connect();
    this.become('lost');
  }

  private take(state: StreamEvents['state']): void {
    if (state === 'open') this.become('open');
    else if (state === 'waiting') this.become('lost');
    else if (state === 'closed') this.become(this.ended ? 'ended' : 'lost');
  }

  private become(state: LinkState): void {
    if (state === this.state) return;
    this.state = state;
    this.emit('state', state);
  }
}
