import { h } from './dom.ts';
import { icon } from './icons.ts';

export interface FileButtonOptions {
  label: string;
  note: string;
  /** As of `<input accept>`. */
  accept: string;
  take: (file: File) => void;
}

/** A button that asks for one file; dropping one on the page is taken care of by the page. */
export function chooseFile({ label, note, accept, take }: FileButtonOptions): HTMLElement {
  const input = h('input', { type: 'file', accept, hidden: true, 'aria-label': label });
  input.addEventListener('change', () => {
    const file = input.files?.[0];
    if (file) take(file);
    input.value = '';
  });
  return h(
    'div',
    { class: 'file-button' },
    h(
      'button',
      { type: 'button', class: 'drop', on: { click: () => input.click() } },
      icon('upload', 18),
      h('span', {}, h('strong', {}, label), ` ${note}`),
    ),
    input,
  );
}
