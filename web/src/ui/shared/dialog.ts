import { h, type Child } from './dom.ts';
import { nameInput } from './name_input.ts';
import { t } from '../../words/words.ts';

interface Question {
  title: string;
  text?: string;
  accept: string;
  danger?: boolean;
  /** The initial text of the input; without it the dialog has no input. */
  value?: string;
  label?: string;
}

/** A modal question. Resolves with the entered text (empty without an input), or null when cancelled. */
export async function ask(question: Question): Promise<string | null> {
  const input = question.value === undefined ? null : nameInput('dialog-value', question.value);
  const accepted = await openDialog(
    question,
    question.text ? h('p', {}, question.text) : null,
    input ? [h('label', { for: 'dialog-value' }, question.label ?? t('Name')), input] : null,
  );
  return accepted ? (input?.value.trim() ?? '') : null;
}

/** A modal dialog; selects the text of the first input. Resolves with whether the dialog was accepted. */
export async function openDialog(
  words: Pick<Question, 'title' | 'accept' | 'danger'>,
  ...content: Child[]
): Promise<boolean> {
  const cancel = h('button', { type: 'button', on: { click: () => dialog.close('') } }, t('Cancel'));
  const accept = h('button', { type: 'submit', value: 'yes', class: words.danger ? 'danger' : 'primary' }, words.accept);
  const dialog = showDialog(words.title, content, [cancel, accept]);
  dialog.querySelector<HTMLInputElement>('input[type="text"]')?.select();
  await new Promise((resolve) => dialog.addEventListener('close', resolve));
  return dialog.returnValue === 'yes';
}

/** Shows a modal dialog with its buttons in the last row; a submit button closes it. It removes itself when it closes. */
export function showDialog(title: string, content: Child, buttons: Child): HTMLDialogElement {
  const dialog = h(
    'dialog',
    { class: 'dialog', 'aria-labelledby': 'dialog-title' },
    h(
      'form',
      { method: 'dialog' },
      h('h2', { id: 'dialog-title' }, title),
      content,
      h('div', { class: 'row end' }, buttons),
    ),
  );
  dialog.addEventListener('close', () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
  return dialog;
}
