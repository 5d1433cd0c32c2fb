import { h, replace } from '../shared/dom.ts';
import { icon } from '../shared/icons.ts';
import { t } from '../../words/words.ts';

type Theme = 'light' | 'dark';
const key = 'semblante.theme';
const system = (): Theme => (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light');

/** The theme button. The theme follows the system until the button is used; then the choice is stored. */
export function themeButton(): HTMLElement {
  const button = h('button', {
    class: 'quiet square',
    type: 'button',
    on: { click: () => choose(current() === 'dark' ? 'light' : 'dark') },
  });
  const apply = (theme: Theme): void => {
    document.documentElement.dataset['theme'] = theme;
    const label = theme === 'dark' ? t('Use light colours') : t('Use dark colours');
    button.setAttribute('aria-label', label);
    button.title = label;
    replace(button, icon(theme === 'dark' ? 'sun' : 'moon'));
  };
  const choose = (theme: Theme): void => {
    keep(theme);
    apply(theme);
  };
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
    if (kept() === null) apply(system());
  });
  apply(kept() ?? system());
  return button;
}

const current = (): Theme => (document.documentElement.dataset['theme'] === 'dark' ? 'dark' : 'light');

// Storage may be forbidden (private windows): the choice then lasts as long as the page.
function kept(): Theme | null {
  try {
    const value = localStorage.getItem(key);
    return value === 'light' || value === 'dark' ? value : null;
  } catch {
    return null;
  }
}

function keep(theme: Theme): void {
  try {
    localStorage.setItem(key, theme);
  } catch {
    return;
  }
}
