import { pointGroups } from '../../face/feature_points.ts';
import { h, redraw, replace, setText } from '../shared/dom.ts';
import { icon } from '../shared/icons.ts';
import { fapGroupTitles, fapTitle } from '../shared/names.ts';
import type { Signal } from '../shared/signal.ts';
import type { SceneView } from '../stage/scene.ts';
import { faps } from '@protocol/generated/mpeg4.ts';
import { swatch } from './swatch.ts';
import { pointName, type InfluenceMode, type InfluenceModel } from './influence_model.ts';
import { capital } from '../shared/names.ts';
import { clickWord } from '../shared/click_word.ts';
import { t } from '../../words/words.ts';

const modes: { mode: InfluenceMode; title: string; words: string }[] = [
  { mode: 'heat', title: t('Heat'), words: t('How strongly the skin follows the chosen points. Moving a face parameter lights its points.') },
  { mode: 'regions', title: t('Regions'), words: t('Each chosen point in its own colour. Where regions overlap, the colours mix.') },
  { mode: 'strongest', title: t('Strongest'), words: t('Every part of the skin in the colour of the point that it follows most.') },
  { mode: 'uncovered', title: t('Uncovered'), words: t('Skin that no point moves. On the back of the head that is usual; on the face it is a gap.') },
];

/** Switches the influence view on and chooses what it shows. */
export class InfluencePanel {
  readonly element: HTMLElement;
  private readonly body = h('div', { class: 'influence-body' });
  private readonly words = h('p', { class: 'muted small' });
  private readonly chips = h('div', { class: 'chips', role: 'list', 'aria-label': t('Chosen points') });
  private readonly select = h('select', { id: 'influence-point', 'aria-label': t('Add a feature point') });
  private readonly chooser: HTMLElement;
  private readonly buttons = new Map<InfluenceMode, HTMLButtonElement>();

  constructor(
    private readonly model: InfluenceModel,
    scene: SceneView,
  ) {
    const box = h('input', { type: 'checkbox', role: 'switch', id: 'influence-view' });
    box.addEventListener('change', () => model.on.set(box.checked));
    this.select.addEventListener('change', () => {
      if (this.select.value !== '') model.choose(this.select.value, true);
    });
    this.chooser = h('div', { class: 'influence-chooser' }, this.chips, this.select);
    const help = t('Point at the skin, or press and hold, to read its weights. {click} a dot to choose it, with Shift to add it.', { click: capital(clickWord()) });
    this.body.append(
      h(
        'div',
        { class: 'segments', role: 'group', 'aria-label': t('What the colours show') },
        modes.map(({ mode, title }) => this.modeButton(mode, title)),
      ),
      this.words,
      this.chooser,
      h('p', { class: 'muted small' }, help),
    );
    this.element = h(
      'section',
      { class: 'influence' },
      h(
        'label',
        { class: 'switch-row', for: 'influence-view' },
        h(
          'span',
          { class: 'grow' },
          h('strong', {}, t('Influence')),
          h('small', { class: 'muted' }, t('Colours the skin by the points that move it.')),
        ),
        box,
      ),
      this.body,
    );
    model.on.watch((on) => {
      box.checked = on;
      this.body.hidden = !on;
    });
    scene.performer.watch((performer) => {
      this.element.hidden = performer === null;
      this.fillSelect();
    });
    for (const signal of [model.mode, model.chosen, model.fap] as Signal<unknown>[]) signal.watch(() => this.draw());
  }

  private modeButton(mode: InfluenceMode, title: string): HTMLElement {
    const button = h('button', { type: 'button', 'data-mode': mode, on: { click: () => this.model.mode.set(mode) } }, title);
    this.buttons.set(mode, button);
    return button;
  }

  /** The points that move the shown face, by group. */
  private fillSelect(): void {
    const { moving } = this.model;
    replace(
      this.select,
      h('option', { value: '' }, t('Add a point…')),
      pointGroups.map(({ name, points }) => {
        const some = points.filter(({ id }) => moving.has(id));
        return some.length > 0
          ? h('optgroup', { label: name }, some.map(({ id }) => h('option', { value: id }, `${id} ${pointName(id)}`)))
          : null;
      }),
    );
  }

  private draw(): void {
    const { model } = this;
    const mode = model.mode.value;
    for (const [one, button] of this.buttons) button.setAttribute('aria-pressed', String(one === mode));
    setText(this.words, modes.find((one) => one.mode === mode)!.words);
    this.chooser.hidden = mode === 'strongest' || mode === 'uncovered';
    this.select.value = '';
    redraw(this.chips, () =>
      replace(
        this.chips,
        this.fapChip(),
        model.chosen.value.map((id) => this.chip(id)),
        model.chosen.value.length > 1
          ? h('button', { type: 'button', class: 'quiet small', on: { click: () => model.clear() } }, t('Clear'))
          : null,
      ),
    );
  }

  private fapChip(): HTMLElement | null {
    const number = this.model.fap.value;
    const fap = number === null ? undefined : faps[number - 1];
    if (!fap) return null;
    const reach = this.model.chosen.value.some((id) => this.model.moving.has(id));
    const group = fapGroupTitles[fap.group] ?? '';
    return h(
      'p',
      { class: 'influence-fap', role: 'status' },
      h('strong', {}, t('FAP {number}', { number: fap.number })),
      ` ${fapTitle(fap.name, fap.group)}`,
      h('small', { class: 'muted' }, reach ? group : t('{group}: it turns a part as a whole, without weights', { group })),
    );
  }

  private chip(id: string): HTMLElement {
    const colour = this.model.colourOf(id);
    return h(
      'span',
      { class: 'chip', role: 'listitem', 'data-point': id, title: pointName(id) },
      colour ? swatch(colour) : null,
      h('span', {}, id),
      h('span', { class: 'chip-name' }, pointName(id)),
      h(
        'button',
        {
          type: 'button',
          class: 'quiet square',
          'aria-label': t('Leave out {id} {id2}', { id, id2: pointName(id) }),
          'data-focus': `chip-${id}`,
          on: { click: () => this.model.choose(id, true) },
        },
        icon('close', 14),
      ),
    );
  }
}
