import { h } from '../shared/dom.ts';

export type Absent = 'zero' | 'keep';

/** What a FAP is that a frame of a .fap file leaves out: the files do not say. */
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
    h('span', { class: 'muted grow', title: 'What a FAP is in a frame that leaves it out' }, 'Left out'),
    h('div', { class: 'segments', role: 'group', 'aria-label': 'FAPs that a frame leaves out' }, [
      button('zero', 'Are zero'),
      button('keep', 'Stay'),
    ]),
  );
}
