import type { FeaturePoint } from '@protocol/generated/mpeg4.ts';
import { pointById, pointGroups } from '../face/feature_points.ts';
import { problemOf } from '../net/problem.ts';
import type { WeightMethod } from '../net/types.ts';
import { ask } from './dialog.ts';
import { h, replace, setText } from './dom.ts';
import { Guide } from './guide.ts';
import { icon } from './icons.ts';
import { capital } from './names.ts';
import type { PointsModel } from './points_model.ts';
import { bar } from './shelf.ts';
import type { Studio } from './studio.ts';

/** Marks where the 84 feature points lie on the open head. */
export class PointsPanel {
  readonly element: HTMLElement;
  private readonly guide: Guide;
  private readonly count = h('span', { class: 'count', 'aria-live': 'polite' });
  private readonly meter = h('div', { class: 'bar', 'aria-hidden': 'true' }, h('span', {}));
  private readonly card = h('div', { class: 'point-card', 'aria-live': 'polite' });
  private readonly notices = h('div', { class: 'notices' });
  private readonly list = h('div', { class: 'point-groups' });
  private readonly search = h('input', {
    type: 'search',
    placeholder: 'Search: 2.1, chin, left…',
    'aria-label': 'Search feature points',
    on: { input: () => this.drawList() },
  });
  private readonly onlyOpen = h('input', { type: 'checkbox', on: { change: () => this.drawList() } });
  private readonly save: HTMLButtonElement;
  private readonly weights: HTMLSelectElement;
  private readonly go: HTMLButtonElement;
  private readonly undo: HTMLButtonElement;
  private readonly redo: HTMLButtonElement;
  private readonly mirror: HTMLButtonElement;
  private readonly progress = h('div', { class: 'progress-slot' });

  constructor(
    private readonly studio: Studio,
    private readonly points: PointsModel,
  ) {
    this.guide = new Guide({ onSelect: (id) => this.choose(id) });
    const file = h('input', {
      type: 'file',
      accept: '.json,application/json',
      class: 'visually-hidden',
      id: 'points-file',
      tabindex: -1,
      'aria-label': 'Feature point file',
    });
    file.addEventListener('change', () => {
      const chosen = file.files?.[0];
      if (chosen) void this.importFile(chosen);
      file.value = '';
    });
    const tool = (label: string, name: Parameters<typeof icon>[0], click: () => void): HTMLButtonElement =>
      h(
        'button',
        { type: 'button', class: 'quiet square', 'aria-label': label, title: label, on: { click } },
        icon(name),
      );
    this.undo = tool('Undo', 'undo', () => points.undo());
    this.redo = tool('Redo', 'redo', () => points.redo());
    this.mirror = tool('Fill the missing side by mirroring', 'mirror', () => void points.save(true));
    this.save = h('button', { type: 'button', on: { click: () => void points.save() } }, 'Save');
    this.go = h(
      'button',
      { type: 'button', class: 'primary', on: { click: () => void this.parametrize() } },
      'Parametrize',
    );
    this.weights = h(
      'select',
      { 'aria-label': 'Weights', title: 'How the skin follows its points' },
      h('option', { value: 'smooth' }, 'Smooth skin'),
      h('option', { value: 'paper' }, 'As in the paper'),
    );
    this.element = h(
      'div',
      { class: 'panel points' },
      h(
        'header',
        { class: 'section-head' },
        h('h2', {}, 'Feature points'),
        h(
          'div',
          { class: 'row tight' },
          this.undo,
          this.redo,
          this.mirror,
          tool('Import points from a file', 'upload', () => file.click()),
          tool('Export points to a file', 'download', () => points.exportFile()),
          file,
        ),
      ),
      h('div', { class: 'meter' }, this.meter, this.count),
      this.guide.element,
      this.card,
      this.notices,
      h(
        'div',
        { class: 'search' },
        icon('search', 16),
        this.search,
        h('label', { class: 'check small' }, this.onlyOpen, 'Not placed'),
      ),
      this.list,
      h('footer', { class: 'panel-foot' }, this.progress, h('div', { class: 'row' }, this.weights, this.save, this.go)),
    );
    points.changed.watch(() => this.draw());
    points.chosen.watch((id) => {
      this.guide.select(id);
      this.drawCard();
      this.drawList();
      if (id !== null) this.reveal(id);
    });
    points.busy.watch(() => this.drawButtons());
    studio.selected.watch(() => this.draw());
    studio.activities.watch(() => this.drawButtons());
  }

  private choose(id: string): void {
    this.points.chosen.set(this.points.chosen.value === id ? null : id);
  }

  /** Scrolls the list, and nothing else, until a row can be seen. */
  private reveal(id: string): void {
    const row = this.list.querySelector<HTMLElement>(`[data-point="${id}"]`);
    if (!row || this.list.scrollHeight <= this.list.clientHeight) return;
    const top = row.offsetTop;
    if (top < this.list.scrollTop || top + row.offsetHeight > this.list.scrollTop + this.list.clientHeight)
      this.list.scrollTop = top - this.list.clientHeight / 3;
  }

  private draw(): void {
    const { draft, problems, warnings } = this.points;
    const placed = draft.points.size;
    setText(this.count, `${placed} of ${this.points.total} placed`);
    this.meter.querySelector('span')!.style.width = `${(placed / this.points.total) * 100}%`;
    this.guide.mark(new Set(draft.points.keys()), new Set([...problems.keys()].filter((id) => id !== '')));
    const general = problems.get('') ?? [];
    const wrong = [...problems.keys()].filter((id) => id !== '');
    const modelWarnings = this.studio.selected.value?.warnings ?? [];
    replace(
      this.notices,
      general.map((text) => h('p', { class: 'notice error', role: 'alert' }, icon('warning', 16), text)),
      wrong.length > 0
        ? h(
            'p',
            { class: 'notice error', role: 'alert' },
            icon('warning', 16),
            h(
              'span',
              {},
              `Refused: ${wrong.length === 1 ? 'point' : 'points'} `,
              wrong.map((id) =>
                h('button', { type: 'button', class: 'link', on: { click: () => this.points.chosen.set(id) } }, id),
              ),
              '. Move or remove, then save again.',
            ),
          )
        : null,
      [...warnings, ...modelWarnings].slice(0, 4).map((text) => h('p', { class: 'notice' }, icon('warning', 16), text)),
    );
    this.drawCard();
    this.drawList();
    this.drawButtons();
  }

  private drawButtons(): void {
    const { draft } = this.points;
    const model = this.studio.selected.value;
    const activity = model ? this.studio.activities.value.get(model.id) : undefined;
    const busy = this.points.busy.value || activity !== undefined;
    const usable = model !== null && (model.state === 'ready' || model.state === 'parametrized');
    this.undo.disabled = !draft.canUndo;
    this.redo.disabled = !draft.canRedo;
    this.mirror.disabled = busy || !usable || draft.points.size === 0;
    this.save.disabled = busy || !usable || draft.changes === 0;
    setText(
      this.save,
      draft.changes === 0 ? 'Saved' : `Save ${draft.changes} ${draft.changes === 1 ? 'change' : 'changes'}`,
    );
    this.go.disabled = busy || !usable || draft.points.size === 0;
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

  private drawCard(): void {
    const id = this.points.chosen.value;
    const point = id === null ? undefined : pointById(id);
    if (!point) {
      replace(
        this.card,
        h('p', { class: 'muted' }, 'Choose a point in the drawing or the list, then click where it lies on the head.'),
      );
      return;
    }
    const place = this.points.draft.points.get(point.id);
    const reasons = this.points.problems.get(point.id) ?? [];
    const where = !place
      ? 'Click on the head to place it.'
      : place.vertex === null
        ? `At ${place.position.map((value) => value.toPrecision(4)).join(', ')}`
        : `On vertex ${place.vertex}. Click elsewhere to move it.`;
    replace(
      this.card,
      h(
        'div',
        { class: 'row' },
        h('code', { class: 'id' }, point.id),
        h('strong', { class: 'grow' }, capital(point.name)),
        place
          ? h(
              'button',
              {
                type: 'button',
                class: 'quiet square small',
                'aria-label': `Remove point ${point.id}`,
                title: 'Remove (Delete)',
                on: { click: () => this.points.remove(point.id) },
              },
              icon('trash', 16),
            )
          : null,
      ),
      h(
        'div',
        { class: 'row' },
        h('p', { class: 'muted small grow' }, where),
        this.points.draft.points.size < this.points.total
          ? h(
              'button',
              { type: 'button', class: 'quiet small next', on: { click: () => this.points.chooseNext() } },
              'Next',
              icon('chevron', 14),
            )
          : null,
      ),
      reasons.map((text) => h('p', { class: 'reason', role: 'alert' }, icon('warning', 15), text)),
    );
  }

  private drawList(): void {
    const words = this.search.value.trim().toLowerCase();
    const { draft, problems } = this.points;
    const show = (point: FeaturePoint): boolean =>
      (!this.onlyOpen.checked || !draft.points.has(point.id)) &&
      (words === '' ||
        point.id.startsWith(words) ||
        `${point.id} ${point.name} ${point.side}`.toLowerCase().includes(words));
    const groups = pointGroups.map((group) => {
      const shown = group.points.filter(show);
      if (shown.length === 0) return null;
      const placed = group.points.filter((point) => draft.points.has(point.id)).length;
      return h(
        'section',
        { class: 'point-group' },
        h(
          'h3',
          {},
          h('span', { class: 'grow' }, group.name),
          h('span', { class: 'number muted' }, `${placed}/${group.points.length}`),
        ),
        h(
          'ul',
          {},
          shown.map((point) => this.row(point, draft.points.has(point.id), problems.get(point.id))),
        ),
      );
    });
    const top = this.list.scrollTop;
    if (groups.every((group) => group === null))
      replace(
        this.list,
        h(
          'p',
          { class: 'empty' },
          this.onlyOpen.checked && words === '' ? 'All points are placed.' : 'No point matches.',
        ),
      );
    else replace(this.list, groups);
    this.list.scrollTop = top;
  }

  private row(point: FeaturePoint, placed: boolean, reasons: readonly string[] | undefined): HTMLElement {
    const chosen = this.points.chosen.value === point.id;
    const state = reasons ? 'wrong' : placed ? (this.points.draft.isChanged(point.id) ? 'changed' : 'placed') : 'open';
    return h(
      'li',
      {},
      h(
        'button',
        {
          type: 'button',
          class: `point-row ${state}`,
          'data-point': point.id,
          'aria-pressed': String(chosen),
          on: { click: () => this.choose(point.id) },
        },
        h('span', { class: 'dot', 'aria-hidden': 'true' }),
        h('code', { class: 'id' }, point.id),
        h('span', { class: 'grow name' }, capital(point.name)),
        h('span', { class: 'visually-hidden' }, state === 'open' ? 'not placed' : state),
      ),
      reasons ? reasons.map((text) => h('p', { class: 'reason' }, text)) : null,
    );
  }

  private async importFile(file: File): Promise<void> {
    if (this.points.draft.points.size > 0) {
      const yes = await ask({
        title: 'Replace the feature points?',
        text: `${file.name} takes the place of the ${this.points.draft.points.size} points of this head.`,
        accept: 'Replace',
      });
      if (yes === null) return;
    }
    await this.points.importFile(file);
  }

  private async parametrize(): Promise<void> {
    const model = this.studio.selected.value;
    if (!model) return;
    if (this.points.draft.changes > 0 && !(await this.points.save())) return;
    try {
      if (await this.studio.parametrize(model, { weights: this.weights.value as WeightMethod, metric: 'edge' })) {
        this.studio.toasts.say(`${model.name} can move now.`);
        this.studio.tab.set('animate');
      }
    } catch (error) {
      this.points.show(error);
      this.studio.toasts.problem('The head was not parametrized', problemOf(error));
    }
  }
}
