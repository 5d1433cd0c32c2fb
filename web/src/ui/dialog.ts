import { h } from './dom.ts';

interface Question {
  title: string;
  text?: string;
  accept: string;
  danger?: boolean;
  /** Asks for a text, starting from this one. */
  value?: string;
  label?: string;
}

/** Asks in a modal dialog. Resolves with the text (empty where none was asked for), or null when cancelled. */
export function ask(question: Question): Promise<string | null> {
  return new Promise((resolve) => {
    const input =
      question.value === undefined
        ? null
        : h('input', { type: 'text', id: 'dialog-value', maxlength: 120, required: true, autocomplete: 'off' });
    if (input) input.value = question.value ?? '';
    const dialog = h(
      'dialog',
      { class: 'dialog', 'aria-labelledby': 'dialog-title' },
      h(
        'form',
        { method: 'dialog' },
        h('h2', { id: 'dialog-title' }, question.title),
        question.text ? h('p', {}, question.text) : null,
        input ? [h('label', { for: 'dialog-value' }, question.label ?? 'Name'), input] : null,
        h(
          'div',
          { class: 'row end' },
          h('button', { type: 'button', on: { click: () => dialog.close('') } }, 'Cancel'),
          h('button', { type: 'submit', value: 'yes', class: question.danger ? 'danger' : 'primary' }, question.accept),
        ),
      ),
    );
    dialog.addEventListener('close', () => {
      const accepted = dialog.returnValue === 'yes';
      dialog.remove();
      resolve(accepted ? (input?.value.trim() ?? '') : null);
    });
    document.body.append(dialog);
    dialog.showModal();
    input?.select();
  });
}
