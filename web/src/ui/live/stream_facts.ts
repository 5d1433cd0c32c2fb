import type { StreamCoding } from '@protocol/messages.ts';
import type { StreamInfo } from '../../net/types.ts';
import { h, setText } from '../shared/dom.ts';
import type { LiveModel } from './live_model.ts';

const sourceWords: Record<NonNullable<StreamInfo['active_source']>, string> = {
  connection: 'A publisher',
  request: 'Frames by REST',
  performance: 'A performance',
  fap: 'A .fap file',
  recording: 'A recording',
  demo: 'The server’s demo',
};

const codingWords: Record<StreamCoding, string> = { plain: 'Plain', packed: 'Packed' };

/** The active source of a stream, in words. */
export function fedBy({ active_source: source, playing }: StreamInfo): string {
  if (source === null) return 'Nobody';
  return playing?.name ? `${sourceWords[source]}: ${playing.name}` : sourceWords[source];
}

/** Facts about the stream that is followed: from the server, and the coding of this subscription. */
export class StreamFacts {
  readonly element = h('dl', { class: 'facts', 'aria-label': 'About the stream' });
  private readonly fed = this.fact('Fed by');
  private readonly watching = this.fact('Watching');
  private readonly batch = this.fact('Gathered for');
  private readonly coding = this.fact('Coding');
  private readonly share = this.fact('Share of visemes');

  constructor(private readonly live: LiveModel) {
    for (const signal of [live.streams, live.following, live.status]) signal.watch(() => this.draw());
  }

  private fact(term: string): HTMLElement {
    const value = h('dd');
    this.element.append(h('div', {}, h('dt', {}, term), value));
    return value;
  }

  private draw(): void {
    const stream = this.live.streams.value?.find(({ id }) => id === this.live.following.value);
    this.element.hidden = !stream;
    if (!stream) return;
    setText(this.fed, fedBy(stream));
    setText(this.watching, String(stream.subscribers));
    const { batch_interval: batch, viseme_share: share } = stream;
    setText(this.batch, batch === 0 ? 'Not at all' : `${batch} ms`);
    const header = this.live.status.value.kind === 'open' ? this.live.subscriber.value?.client.header : null;
    setText(this.coding, header ? codingWords[header.coding] : '–');
    setText(this.share, share === null ? 'As the head has it' : `${Math.round(share * 100)} %`);
  }
}
