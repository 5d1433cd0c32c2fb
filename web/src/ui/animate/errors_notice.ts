import { h, setText } from '../shared/dom.ts';
import { severityCount } from '../shared/finding_words.ts';
import { icon } from '../shared/icons.ts';
import { hasErrors, type Studio } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

/** Says that the open face moves wrongly in places, with `mend` if the studio can mend it, and leads to what was found. */
export function errorsNotice(studio: Studio, mend: HTMLElement): HTMLElement {
  const words = h('p', {});
  const look = h('button', { type: 'button', class: 'small', on: { click: () => studio.tab.set('fit') } }, t('See what is wrong'));
  const notice = h('div', { class: 'notice errors', hidden: true }, icon('warning', 16), h('div', { class: 'grow' }, words, h('div', { class: 'row wrap' }, mend, look)));
  studio.selected.watch((model) => {
    notice.hidden = model?.state !== 'parametrized' || !hasErrors(model);
    const found = severityCount('error', model?.findings?.errors ?? 0);
    setText(words, t('The fit doctor found {found}: this face moves wrongly in places, or not at all.', { found }));
  });
  return notice;
}
