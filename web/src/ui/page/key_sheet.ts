import { t } from '../../words/words.ts';
import { showDialog } from '../shared/dialog.ts';
import { h } from '../shared/dom.ts';
import { icon } from '../shared/icons.ts';

const kbd = (...keys: string[]): HTMLElement[] => keys.map((key) => h('kbd', {}, key));

/** Everything that a key does, by place. */
const sheet = (): { place: string; keys: [HTMLElement[], string][] }[] => [
  {
    place: t('The head, when it has the focus'),
    keys: [
      [kbd('←', '↑', '→', '↓'), t('Turn the head')],
      [kbd('Shift', '←', '↑', '→', '↓'), t('Move the head')],
      [kbd('+', '−'), t('Nearer, farther')],
      [kbd('1', '2', '3', '4'), t('From the front, three-quarter, left, right')],
      [kbd('F'), t('The whole face')],
      [kbd('I'), t('Read the weights at the cross, with the influence view')],
    ],
  },
  {
    place: t('Feature points'),
    keys: [
      [kbd('N'), t('The next point')],
      [kbd(t('Space')), t('Place the chosen point at the cross')],
      [kbd('Enter'), t('Confirm a proposal')],
      [kbd('Delete'), t('Remove the chosen point')],
      [kbd('H'), t('Hide the part under the mouse, or at the cross')],
      [kbd('Shift', 'H'), t('Show all parts')],
      [kbd('Esc'), t('Deselect the point')],
      [kbd('Ctrl', 'Z'), t('Undo')],
      [kbd('Ctrl', 'Shift', 'Z'), t('Redo')],
    ],
  },
  {
    place: t('Timeline'),
    keys: [
      [kbd('↑', '↓'), t('The previous or the next cue')],
      [kbd('←', '→'), t('Move the cue')],
      [kbd('Shift', '←', '→'), t('Shorten or lengthen the cue')],
      [kbd('Delete'), t('Delete the cue')],
      [kbd('Ctrl', 'Z'), t('Undo')],
      [kbd('Ctrl', 'Shift', 'Z'), t('Redo')],
    ],
  },
  {
    place: t('Everywhere'),
    keys: [
      [kbd('←', '→'), t('Switch tabs, when a tab has the focus')],
      [kbd('?'), t('This sheet')],
    ],
  },
];

/** The button that shows what the keys do, hidden where fingers are all there is (touch.css); `?` does the same anywhere but in a text that is being written. */
export function keySheetButton(): HTMLElement {
  document.addEventListener('keydown', (event) => {
    if (event.key !== '?' || event.ctrlKey || event.metaKey || event.altKey) return;
    if ((event.target as Element).closest('dialog, textarea, input:not([type=range], [type=checkbox], [type=file])')) return;
    event.preventDefault();
    open();
  });
  return h(
    'button',
    { type: 'button', class: 'quiet square key-sheet', 'aria-label': t('Keys'), title: `${t('Keys')} (?)`, on: { click: open } },
    icon('keys'),
  );
}

function open(): void {
  if (document.querySelector('dialog[open]')) return;
  showDialog(
    t('Keys'),
    h(
      'div',
      { class: 'key-places' },
      sheet().map(({ place, keys }) =>
        h(
          'section',
          {},
          h('h3', {}, place),
          h(
            'dl',
            { class: 'keys' },
            keys.map(([key, action]) => [h('dt', {}, key), h('dd', {}, action)]),
          ),
        ),
      ),
    ),
    h('button', { type: 'submit', class: 'primary' }, t('Close')),
  ).scrollTop = 0; // the button at its end has the focus
}
