import { h } from '../shared/dom.ts';
import { examples } from './examples.ts';
import { t } from '../../words/words.ts';

/** A select of the project's example performance documents; `take` receives name and text of the chosen one. */
export function exampleSelect(take: (name: string, text: string) => void): HTMLSelectElement {
  const select = h(
    'select',
    { 'aria-label': t('Example') },
    h('option', { value: '' }, t('An example…')),
    ...examples.map(({ title }, i) => h('option', { value: i }, title)),
  );
  select.addEventListener('change', () => {
    const chosen = examples[Number(select.value)];
    if (select.value === '' || !chosen) return;
    select.value = '';
    void chosen.text().then((text) => take(chosen.name, text));
  });
  return select;
}
