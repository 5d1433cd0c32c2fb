import { h, redraw, replace, setText } from '../shared/dom.ts';
import type { Model } from '../../net/types.ts';
import { formatNumber, formatPercent } from '../shared/format.ts';
import { ParametrizeOptions } from './parametrize_options.ts';
import type { Parametrizer } from './parametrizer.ts';
import type { PointsModel } from './points_model.ts';
import { progressBar } from '../shared/progress_bar.ts';
import type { Studio } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

/** The footer of a panel: options, Save, Parametrize and its progress. */
export class ParametrizeBox {
  readonly element: HTMLElement;
  private readonly fapu = h('p', { class: 'small muted' });
  private readonly progress = h('div', { class: 'progress-slot' });
  /** Why there is nothing to parametrize yet, and what helps. */
  private readonly why = h('p', { class: 'small why', hidden: true });
  private readonly save: HTMLButtonElement | null;
  private readonly go: HTMLButtonElement;

  constructor(
    private readonly studio: Studio,
    private readonly points: PointsModel,
    parametrizer: Parametrizer,
    { withSave }: { withSave: boolean },
  ) {
    this.save = withSave ? h('button', { type: 'button', on: { click: () => void points.save() } }, t('Save')) : null;
    this.go = h('button', { type: 'button', class: 'primary', on: { click: () => void parametrizer.run() } });
    this.element = h(
      'footer',
      { class: 'panel-foot' },
      this.progress,
      new ParametrizeOptions(parametrizer).element,
      this.fapu,
      this.why,
      h('div', { class: 'row' }, this.save, this.go),
    );
    points.changed.watch(() => this.draw());
    points.busy.watch(() => this.draw());
    studio.selected.watch(() => this.draw());
    studio.activities.watch(() => this.draw());
  }

  private draw(): void {
    const { draft } = this.points;
    const model = this.studio.selected.value;
    const activity = model ? this.studio.activities.value.get(model.id) : undefined;
    const busy = this.points.busy.value || activity !== undefined;
    const fapu = Object.entries(this.points.fapu);
    this.fapu.hidden = fapu.length === 0;
    const lengths = fapu.map(([unit, length]) => `${unit} = ${formatNumber(length, 5)}`).join(' · ');
    setText(
      this.fapu,
      t('Units set by hand: {lengths}', { lengths }),
    );
    const usable = model !== null && (model.state === 'ready' || model.state === 'parametrized');
    if (this.save) {
      this.save.disabled = busy || !usable || draft.changes === 0;
      setText(
        this.save,
        draft.changes === 0 ? t('Saved') : draft.changes === 1 ? t('Save 1 change') : t('Save {changes} changes', { changes: draft.changes }),
      );
    }
    this.go.disabled = busy || !usable || draft.points.size === 0;
    this.drawWhy(busy ? null : model);
    setText(this.go, model?.state === 'parametrized' ? t('Parametrize again') : t('Make it move (parametrize)'));
    replace(
      this.progress,
      activity
        ? h(
            'div',
            { class: 'row small' },
            h('span', { class: 'grow' }, activity.title),
            activity.progress !== null
              ? h('span', { class: 'number' }, formatPercent(activity.progress))
              : null,
            activity.cancel
              ? h('button', { type: 'button', class: 'quiet small', on: { click: activity.cancel } }, t('Cancel'))
              : null,
          )
        : null,
      activity ? progressBar(activity) : null,
    );
  }

  private drawWhy(model: Model | null): void {
    const empty = (model?.state === 'ready' || model?.state === 'parametrized') && this.points.draft.points.size === 0;
    const importing = model?.state === 'importing';
    this.why.hidden = !empty && !importing;
    if (this.why.hidden) return this.why.replaceChildren();
    redraw(this.why, () =>
      replace(
        this.why,
        h('span', { class: 'grow' }, importing ? t('The head is still being read.') : t('A face needs feature points, and none is placed.')),
        empty
          ? h(
              'button',
              {
                type: 'button',
                class: 'small',
                'data-focus': 'first',
                on: {
                  click: () => {
                    this.studio.tab.set('points');
                    this.points.chooseFirst();
                  },
                },
              },
              t('Place the first'),
            )
          : null,
      ),
    );
  }
}
