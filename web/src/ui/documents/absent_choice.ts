import { h } from '../shared/dom.ts';
import { t } from '../../words/words.ts';

export type Absent = 'zero' | 'keep';

/** The choice of the value of FAPs that a frame of a .fap file omits; the format does not define it. */
export function absentChoice(chosen: Absent, choose: (absent: Absent) => void): HTMLElement {
  const button = (value: Absent, title: string): HTMLElement =>
    h(
      'button',
      {
        type: 'button',
        'data-focus': value,
        'aria-pressed': String(chosen === value),
        on: { click: () => choose(value) },
      },
      title,
    );
  return h(
    'div',
    { class: 'row' },
    h('span', { class: 'muted grow', title: t('The value of a FAP in a frame that omits it') }, t('Omitted FAPs')),
    h('div', { class: 'segments', role: 'group', 'aria-label': t('FAPs that a frame omits') }, [
      button('zero', t('Are zero')),
      button('keep', t('Stay')),
    ]),
  );
}
