import { h } from '../shared/dom.ts';
import { icon } from '../shared/icons.ts';
import type { Studio } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

/** Says why nothing moves while the open head is not parametrized, and leads to its points, or that there is no head to move. */
export function noFaceNotice(studio: Studio): HTMLElement {
  const words = h('span', { class: 'grow' });
  const toPoints = h('button', { type: 'button', class: 'small', on: { click: () => studio.tab.set('points') } }, t('Go to its points'));
  const notice = h(
    'div',
    { class: 'notice no-face', hidden: true },
    icon('warning', 16),
    words,
    toPoints,
  );
  studio.selected.watch((model) => {
    const failed = model?.state === 'failed';
    notice.hidden = !failed && model?.state !== 'ready';
    toPoints.hidden = failed;
    words.textContent = failed ? t('This head could not be read: open another one, or upload it in another form.') : t('This head cannot move yet: place its feature points, then parametrize it.');
  });
  return notice;
}
