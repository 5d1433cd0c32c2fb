import { canIdle, setIdle } from './idle.ts';
import type { Studio } from './studio.ts';
import { t } from '../../words/words.ts';

/** Makes a button one that needs a parametrized head; `title`: what it does with one. Returns what sets whether there is one. */
export function needsFace(button: HTMLButtonElement, title: string, studio: Studio): (hasFace: boolean) => void {
  canIdle(button, studio.toasts);
  return (hasFace) =>
    setIdle(button, title, hasFace ? null : { why: t('This needs a head that is parametrized.'), help: { label: t('Go to its points'), act: () => studio.tab.set('points') } });
}
