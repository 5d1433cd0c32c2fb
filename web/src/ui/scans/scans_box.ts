import { modelFormats } from '../../net/model_formats.ts';
import { h, redraw, replace } from '../shared/dom.ts';
import { chooseFile } from '../shared/file_button.ts';
import { icon } from '../shared/icons.ts';
import { canIdle, setIdle } from '../shared/idle.ts';
import { capital } from '../shared/names.ts';
import type { Studio } from '../shared/studio.ts';
import type { Scan, ScansModel } from './scans_model.ts';
import { slots, slotTitle } from './slot_names.ts';
import { t } from '../../words/words.ts';

/** Own visemes and expressions of the open head from files with its mesh in other shapes, and those that it has. */
export function scansBox(studio: Studio, model: ScansModel): HTMLElement {
  const list = h('ul', { class: 'scans-list' });
  const worn = h('ul', { class: 'scans-list' });
  const wear = h('button', { type: 'button', class: 'primary', on: { click: () => void model.wear() } }, t('Make them its own'));
  canIdle(wear, studio.toasts);
  const box = h(
    'details',
    { class: 'parts-box scans' },
    h('summary', {}, icon('chevron', 14), h('span', {}, t('From scans of this head'))),
    h(
      'p',
      { class: 'muted small' },
      t('A file of the same mesh in an expression, its vertices in the same order, gives this head an expression of its own.'),
    ),
    worn,
    chooseFile({ label: t('Choose scans'), note: t('several at once'), accept: modelFormats.map(({ extension }) => extension).join(','), multiple: true, take: (files) => model.add(files) }),
    list,
    wear,
  );

  const row = (scan: Scan, number: number): HTMLElement => {
    const select = h(
      'select',
      { 'aria-label': t('What {name} shows', { name: scan.file.name }), 'data-focus': `scan-${number}` },
      h('option', { value: '' }, t('Choose…')),
      slots.map(({ name, title }) => h('option', { value: name }, title)),
    );
    select.value = scan.slot ?? '';
    select.disabled = model.busy.value;
    select.addEventListener('change', () => model.place(scan, select.value === '' ? null : select.value));
    return h(
      'li',
      {},
      h('div', { class: 'row' }, h('span', { class: 'grow scan-name' }, scan.file.name), select, removal(t('Leave out {name}', { name: scan.file.name }), () => model.remove(scan))),
      scan.fault === null ? null : h('p', { class: 'notice error', role: 'alert' }, icon('warning', 16), `${capital(scan.fault)}.`),
    );
  };
  const removal = (label: string, act: () => void): HTMLButtonElement => {
    const button = h('button', { type: 'button', class: 'quiet square small', 'aria-label': label, title: label, on: { click: act } }, icon('close', 14));
    button.disabled = model.busy.value;
    return button;
  };
  const draw = (): void => {
    const head = studio.selected.value;
    const own = Object.entries(head?.expressions ?? {});
    box.hidden = head?.state !== 'parametrized';
    redraw(list, () => replace(list, model.scans.value.map(row)));
    replace(
      worn,
      own.map(([slot, { name }]) => {
        const title = slotTitle(slot);
        return h('li', { class: 'row' }, h('span', { class: 'grow' }, h('strong', {}, title), ` ${name}`), removal(t('{title}: the library’s again', { title }), () => void model.takeOff(slot)));
      }),
    );
    wear.hidden = model.scans.value.length === 0;
    wear.disabled = model.busy.value;
    setIdle(wear, t('Make them its own'), model.placed.length > 0 ? null : { why: t('Choose first which expression each scan shows.') });
  };
  studio.selected.watch(draw);
  model.scans.watch(draw);
  model.busy.watch(draw);
  return box;
}
