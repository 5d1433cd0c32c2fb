import type { DistanceMetric, WeightMethod } from '../net/types.ts';
import { h, replace, setText } from './dom.ts';
import type { Parametrizer } from './parametrizer.ts';
import type { PointsModel } from './points_model.ts';
import { bar } from './shelf.ts';
import type { Studio } from './studio.ts';

interface Choice {
  value: string;
  title: string;
  note: string;
}

const weightChoices: readonly Choice[] = [
  { value: 'smooth', title: 'Smooth skin', note: 'shares fade out without steps; looks best' },
  { value: 'paper', title: 'As in the paper', note: 'Eq. 1 to 4 as published' },
];
const metricChoices: readonly Choice[] = [
  { value: 'edge', title: 'Along edges', note: 'the paper’s way; quickest' },
  { value: 'unfolded', title: 'Across triangles', note: 'nearer to the true distance' },
];

let boxes = 0;

/** The foot of a panel: options, save, parametrize, and how far that is. */
export class ParametrizeBox {
  readonly element: HTMLElement;
  private readonly progress = h('div', { class: 'progress-slot' });
  private readonly summary = h('span', { class: 'muted small grow' });
  private readonly save: HTMLButtonElement | null;
  private readonly go: HTMLButtonElement;
  private readonly selects: { name: 'weights' | 'metric'; choices: readonly Choice[]; select: HTMLSelectElement }[] =
    [];

  constructor(
    private readonly studio: Studio,
    private readonly points: PointsModel,
    parametrizer: Parametrizer,
    { withSave }: { withSave: boolean },
  ) {
    boxes += 1;
    this.save = withSave ? h('button', { type: 'button', on: { click: () => void points.save() } }, 'Save') : null;
    this.go = h('button', { type: 'button', class: 'primary', on: { click: () => void parametrizer.run() } });
    this.element = h(
      'footer',
      { class: 'panel-foot' },
      this.progress,
      h(
        'details',
        { class: 'options' },
        h('summary', { class: 'small' }, h('span', {}, 'Options'), this.summary),
        this.field('weights', 'Weights', weightChoices, (value) =>
          parametrizer.set({ weights: value as WeightMethod }),
        ),
        this.field('metric', 'Distances', metricChoices, (value) =>
          parametrizer.set({ metric: value as DistanceMetric }),
        ),
      ),
      h('div', { class: 'row' }, this.save, this.go),
    );
    parametrizer.options.watch((options) => {
      for (const { name, select } of this.selects) select.value = options[name];
      setText(
        this.summary,
        this.selects
          .map(({ name, choices }) => choices.find(({ value }) => value === options[name])?.title ?? '')
          .join(' · '),
      );
    });
    points.changed.watch(() => this.draw());
    points.busy.watch(() => this.draw());
    studio.selected.watch(() => this.draw());
    studio.activities.watch(() => this.draw());
  }

  private field(
    name: 'weights' | 'metric',
    label: string,
    choices: readonly Choice[],
    change: (value: string) => void,
  ): HTMLElement {
    const id = `${name}-${boxes}`;
    const select = h(
      'select',
      { id },
      choices.map(({ value, title, note }) => h('option', { value }, `${title}: ${note}`)),
    );
    select.addEventListener('change', () => change(select.value));
    this.selects.push({ name, choices, select });
    return h('div', { class: 'field-row' }, h('label', { for: id, class: 'muted' }, label), select);
  }

  private draw(): void {
    const { draft } = this.points;
    const model = this.studio.selected.value;
    const activity = model ? this.studio.activities.value.get(model.id) : undefined;
    const busy = this.points.busy.value || activity !== undefined;
    const usable = model !== null && (model.state === 'ready' || model.state === 'parametrized');
    if (this.save) {
      this.save.disabled = busy || !usable || draft.changes === 0;
      setText(
        this.save,
        draft.changes === 0 ? 'Saved' : `Save ${draft.changes} ${draft.changes === 1 ? 'change' : 'changes'}`,
      );
    }
    this.go.disabled = busy || !usable || draft.points.size === 0;
    setText(this.go, model?.state === 'parametrized' ? 'Parametrize again' : 'Parametrize');
    replace(
      this.progress,
      activity
        ? h(
            'div',
            { class: 'row small' },
            h('span', { class: 'grow' }, activity.title),
            activity.progress !== null
              ? h('span', { class: 'number' }, `${Math.round(activity.progress * 100)} %`)
              : null,
            activity.cancel
              ? h('button', { type: 'button', class: 'quiet small', on: { click: activity.cancel } }, 'Cancel')
              : null,
          )
        : null,
      activity ? bar(activity) : null,
    );
  }
}
