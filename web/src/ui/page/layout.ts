import { h, replace } from '../shared/dom.ts';
import { findingBadge } from '../shared/finding_badge.ts';
import { icon, type IconName } from '../shared/icons.ts';
import { rem } from '../shared/rem.ts';
import type { Studio, Tab } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

export interface Panels {
  heads: HTMLElement;
  fit: HTMLElement;
  points: HTMLElement;
  animate: HTMLElement;
  live: HTMLElement;
}

const tabs: { tab: Tab; title: string; icon: IconName }[] = [
  { tab: 'heads', title: t('Heads'), icon: 'head' },
  { tab: 'fit', title: t('Fit'), icon: 'fit' },
  { tab: 'points', title: t('Points'), icon: 'point' },
  { tab: 'animate', title: t('Animate'), icon: 'sliders' },
  { tab: 'live', title: t('Live'), icon: 'live' },
];

export const tabTitle = (tab: Tab): string => tabs.find((one) => one.tab === tab)!.title;

/** Whether the shelf is a tab of its own. */
export const isNarrow = (): MediaQueryList => matchMedia(`(max-width: ${rem(1080)})`);

/** Bar, shelf, stage and inspector; on a narrow page the shelf is one of the tabs. */
export function makeLayout(studio: Studio, panels: Panels, stage: readonly HTMLElement[], extras: HTMLElement, notes: readonly HTMLElement[]): HTMLElement {
  const buttons = new Map<Tab, HTMLButtonElement>();
  const tabList = h('div', { class: 'tabs', role: 'tablist', 'aria-label': t('Work on the head') });
  for (const { tab, title, icon: name } of tabs) {
    const button = h(
      'button',
      {
        type: 'button',
        role: 'tab',
        id: `tab-${tab}`,
        'aria-controls': `panel-${tab}`,
        class: `tab tab-${tab}`,
        on: { click: () => studio.tab.set(tab) },
      },
      icon(name),
      h('span', {}, title),
      tab === 'fit' ? fitBadge(studio) : null,
    );
    buttons.set(tab, button);
    tabList.append(button);
  }
  tabList.addEventListener('keydown', (event) => {
    const step = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
    if (step === 0) return;
    const visible = tabs.filter(({ tab }) => buttons.get(tab)!.offsetParent !== null);
    const at = visible.findIndex(({ tab }) => tab === studio.tab.value);
    const next = visible[(at + step + visible.length) % visible.length]!;
    studio.tab.set(next.tab);
    buttons.get(next.tab)!.focus();
  });

  const shelfHome = h('aside', { class: 'shelf', 'aria-label': t('Heads') });
  const inspector = h('section', { class: 'inspector', 'aria-label': t('Inspector') }, tabList);
  for (const { tab } of tabs) {
    if (tab === 'heads') continue;
    panels[tab].setAttribute('role', 'tabpanel');
    panels[tab].id = `panel-${tab}`;
    panels[tab].setAttribute('aria-labelledby', `tab-${tab}`);
    inspector.append(panels[tab]);
  }

  // The one shelf element moves between the side column and its tab with the width of the page.
  const narrow = isNarrow();
  const seat = (): void => {
    panels.heads.id = 'panel-heads';
    (narrow.matches ? inspector : shelfHome).append(panels.heads);
    if (!narrow.matches && studio.tab.value === 'heads') studio.tab.set('animate');
    show();
  };
  // A control that is disabled or hidden loses the focus to the page: the keyboard goes on at the tab that is shown instead.
  let used: Element | null = null;
  inspector.addEventListener('focusin', ({ target }) => (used = target as Element));
  const keepFocus = (): void => {
    const now = document.activeElement;
    const gone = used?.closest('[role=tabpanel]');
    if ((now === document.body || now === used) && gone instanceof HTMLElement && gone.hidden) buttons.get(studio.tab.value)!.focus({ preventScroll: true });
  };
  /** Panels that have not been shown since another head was opened. The scroll position of a hidden panel cannot be set. */
  const unread = new Set<Tab>();
  const beginAtTop = (): void => {
    if (unread.delete(studio.tab.value)) panels[studio.tab.value].scrollTop = 0;
  };
  const show = (): void => {
    for (const { tab } of tabs) {
      const on = studio.tab.value === tab;
      const button = buttons.get(tab)!;
      button.setAttribute('aria-selected', String(on));
      button.tabIndex = on ? 0 : -1;
      panels[tab].hidden = tab === 'heads' ? narrow.matches && !on : !on;
    }
    beginAtTop();
    keepFocus();
  };
  narrow.addEventListener('change', seat);
  studio.tab.watch(show);
  seat();

  const crumb = h('span', { class: 'crumb', dir: 'auto' });
  let open = '';
  studio.selected.watch((model) => {
    crumb.textContent = model?.name ?? '';
    if ((model?.id ?? '') === open) return;
    open = model?.id ?? '';
    for (const { tab } of tabs) if (tab !== 'heads') unread.add(tab);
    beginAtTop();
  });
  return h(
    'div',
    { class: 'studio' },
    h(
      'header',
      { class: 'top' },
      h(
        'a',
        { class: 'brand', href: './' },
        h('img', { src: './favicon.svg', alt: '' }),
        h('h1', {}, 'Semblante'),
      ),
      crumb,
      h('span', { class: 'grow' }),
      extras,
    ),
    h('div', { class: 'notes' }, notes),
    shelfHome,
    h('main', { class: 'stage' }, stage),
    inspector,
    h(
      'div',
      { class: 'drop-veil', 'aria-hidden': 'true' },
      h('div', {}, icon('upload', 40), h('p', {}, t('Drop a head or a performance here'))),
    ),
  );
}

/** The number of findings of the open head, on the Fit tab. */
function fitBadge(studio: Studio): HTMLElement {
  const seat = h('span', { class: 'badge-seat' });
  studio.selected.watch((model) => replace(seat, findingBadge(model?.findings)));
  return seat;
}
