import { h } from './dom.ts';
import { icon } from './icons.ts';

export interface FileButtonOptions {
  label: string;
  note: string;
  /** The `accept` attribute of the file input. */
  accept: string;
  /** Whether several files may be chosen at once. */
  multiple?: boolean;
  take: (files: readonly [File, ...File[]]) => void;
}

/** A button that opens a file chooser; ui/page/file_drop.ts handles dropped files. */
export function chooseFile({ label, note, accept, multiple = false, take }: FileButtonOptions): HTMLElement {
  const input = h('input', { type: 'file', accept, multiple, hidden: true, 'aria-label': label });
  input.addEventListener('change', () => {
    const [first, ...others] = input.files ?? [];
    if (first) take([first, ...others]);
    input.value = '';
  });
  return h(
    'div',
    { class: 'file-button' },
    h(
      'button',
      { type: 'button', class: 'drop', on: { click: () => input.click() } },
      icon('upload', 18),
      h('span', {}, h('strong', {}, label), h('span', { class: 'drop-word' }, ` ${note}`)),
    ),
    input,
  );
}
