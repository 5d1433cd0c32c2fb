import type { ExcerptLine } from './document_place.ts';
import { h } from '../shared/dom.ts';

/** Lines of a document with the erroneous line marked; null when there are no lines. */
export function excerptBox(lines: readonly ExcerptLine[]): HTMLElement | null {
  if (lines.length === 0) return null;
  return h(
    'pre',
    { class: 'excerpt' },
    lines.map(({ number, text, marked }) =>
      h('div', { class: marked ? 'marked' : '' }, h('span', { class: 'line-number' }, number), text),
    ),
  );
}
