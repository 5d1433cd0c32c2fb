import type { StreamInfo } from '../../net/types.ts';
import { h, setText } from '../shared/dom.ts';
import type { LiveModel } from './live_model.ts';
import { t } from '../../words/words.ts';

const sourceWords: Record<NonNullable<StreamInfo['active_source']>, string> = {
  connection: t('A publisher'),
  request: t('Frames by REST'),
  performance: t('A performance'),
  fap: t('A .fap file'),
  recording: t('A recording'),
  demo: t('The server’s demo'),
};

/** The active source of a stream as text. */
export function fedBy({ active_source: source, playing }: StreamInfo): string {
  if (source === null) return t('No source');
  return playing?.name ? `${sourceWords[source]}: ${playing.name}` : sourceWords[source];
}

/** Facts about the subscribed stream. */
export class StreamFacts {
  readonly element = h('dl', { class: 'facts', 'aria-label': t('About the stream') });
  private readonly fed = this.fact(t('Source'));
  private readonly watching = this.fact(t('Subscribers'));
  private readonly batch = this.fact(t('Batch interval'));
  private readonly share = this.fact(t('Viseme share'));

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
    setText(this.batch, batch === 0 ? t('None') : t('{batch} ms', { batch }));
    setText(this.share, share === null ? t('Default of the head') : `${Math.round(share * 100)} %`);
  }
}
