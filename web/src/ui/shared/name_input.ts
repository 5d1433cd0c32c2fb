import { h } from './dom.ts';
import { t } from '../../words/words.ts';

/** The server counts the bytes of a name, of which letters have up to four (openapi.json). */
const mostBytes = 200;

/** An input for a name; a dialog with one that is empty or too long is not accepted. */
export function nameInput(id: string, value: string): HTMLInputElement {
  const check = (): void => {
    const bytes = new TextEncoder().encode(input.value.trim()).length;
    input.setCustomValidity(bytes > mostBytes ? t('The name is too long.') : '');
  };
  const input = h('input', { type: 'text', id, required: true, autocomplete: 'off', on: { input: check } });
  input.value = value;
  return input;
}
