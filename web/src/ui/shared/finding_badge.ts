import type { FindingCounts } from '../../net/types.ts';
import { h } from './dom.ts';
import { badgeOf, countWords } from './finding_words.ts';
import { t } from '../../words/words.ts';

/** The number of findings in the colour of the worst one; null when there are none. */
export function findingBadge(counts: FindingCounts | null | undefined): HTMLElement | null {
  const badge = badgeOf(counts);
  if (!badge || !counts) return null;
  const words = countWords(counts);
  return h(
    'span',
    { class: `finding-badge ${badge.severity}`, title: words },
    h('span', { 'aria-hidden': 'true' }, badge.count),
    h('span', { class: 'visually-hidden' }, t('fit doctor: {words}', { words })),
  );
}
