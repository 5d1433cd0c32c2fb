import { h } from './dom.ts';
import { icon } from './icons.ts';

export interface FileButtonOptions {
  label: string;
  note: string;
  /** The `accept` attribute of the file input. */
  accept: string;
  take: (file: File) => void;
}

/** A button that opens a file chooser for one file; ui/page/file_drop.ts handles dropped files. */
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
