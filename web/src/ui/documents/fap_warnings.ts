import { h } from '../shared/dom.ts';

/** What a .fap file does that the usual form does not, to unfold; null where it does nothing such. */
export function fapWarnings(sentences: readonly string[]): HTMLElement | null {
  if (sentences.length === 0) return null;
  return h(
    'details',
    { class: 'notice clip-warnings' },
    h('summary', {}, `${sentences.length} ${sentences.length === 1 ? 'peculiarity' : 'peculiarities'} of the file`),
    h(
      'ul',
      {},
      sentences.map((sentence) => h('li', {}, sentence)),
    ),
  );
}
