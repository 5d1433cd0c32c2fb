import { changeLanguage, language, languages, t, type Language } from '../../words/words.ts';
import { h } from '../shared/dom.ts';

/** Chooses the language of the page. It follows the browser until it is used. */
export function languageSelect(): HTMLElement {
  const names = Object.entries(languages).map(([id, name]) => h('option', { value: id, lang: id, title: name, selected: id === language }, id.slice(0, 2).toUpperCase()));
  const select = h('select', { class: 'language', 'aria-label': t('Language'), title: t('Language') }, names);
  select.addEventListener('change', () => changeLanguage(select.value as Language));
  return select;
}
