import { h } from '../shared/dom.ts';
import { t } from '../../words/words.ts';

/** A collapsed list of a .fap file's deviations from the usual form; null when there are none. */
export function fapWarnings(sentences: readonly string[]): HTMLElement | null {
  if (sentences.length === 0) return null;
  return h(
    'details',
    { class: 'notice clip-warnings' },
    h('summary', {}, sentences.length === 1 ? t('1 deviation from the usual form') : t('{count} deviations from the usual form', { count: sentences.length })),
    h(
      'ul',
      {},
      sentences.map((sentence) => h('li', {}, sentence)),
    ),
  );
}
