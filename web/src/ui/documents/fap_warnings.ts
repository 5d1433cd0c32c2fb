import { h } from '../shared/dom.ts';

/** A collapsed list of a .fap file's deviations from the usual form; null when there are none. */
export function fapWarnings(sentences: readonly string[]): HTMLElement | null {
  if (sentences.length === 0) return null;
  return h(
    'details',
    { class: 'notice clip-warnings' },
    h('summary', {}, `${sentences.length} ${sentences.length === 1 ? 'deviation' : 'deviations'} from the usual form`),
    h(
      'ul',
      {},
      sentences.map((sentence) => h('li', {}, sentence)),
    ),
  );
}
