import { h } from '../shared/dom.ts';
import { icon } from '../shared/icons.ts';
import type { Studio } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

/** Says why nothing moves while the open head is not parametrized, and leads to its points. */
export function noFaceNotice(studio: Studio): HTMLElement {
  const notice = h(
    'div',
    { class: 'notice no-face', hidden: true },
    icon('warning', 16),
    h('span', { class: 'grow' }, t('This head cannot move yet: place its feature points, then parametrize it.')),
    h('button', { type: 'button', class: 'small', on: { click: () => studio.tab.set('points') } }, t('Go to its points')),
  );
  studio.selected.watch((model) => (notice.hidden = model?.state !== 'ready'));
  return notice;
}
