import { pointById, pointGroups, type NamedPoint } from '../../face/feature_points.ts';
import { quickSet } from '../../face/quick_set.ts';
import { h, redraw, replace } from '../shared/dom.ts';
import { icon } from '../shared/icons.ts';
import { capital } from '../shared/names.ts';
import { rove } from '../shared/roving.ts';
import type { PointsModel } from './points_model.ts';
import { confidenceWords, pointStateWords } from './proposal_words.ts';
import { t } from '../../words/words.ts';

type Filter = 'all' | 'open' | 'proposed';

/** The list of points with a search: by group, or in guided mode the quick set in its order. */
export class PointList {
  readonly search: HTMLElement;
  readonly element = h('div', { class: 'point-groups' });
  private readonly words = h('input', {
    type: 'search',
    placeholder: t('Search: 2.1, chin…'),
    'aria-label': t('Search feature points'),
    on: { input: () => this.draw() },
  });
  private readonly filter: HTMLSelectElement;

  constructor(private readonly points: PointsModel) {
    this.filter = h(
      'select',
      { 'aria-label': t('Which points'), on: { change: () => this.draw() } },
      h('option', { value: 'all' }, t('All')),
      h('option', { value: 'open' }, t('Not placed')),
      h('option', { value: 'proposed' }, t('Proposed')),
    );
    this.search = h('div', { class: 'search' }, icon('search', 16), this.words, this.filter);
    rove(this.element, '.point-row');
    points.changed.watch(() => this.draw());
    points.guided.watch(() => this.draw());
    points.chosen.watch((id) => {
      this.draw();
      if (id !== null) this.reveal(id);
    });
  }

  /** Scrolls the list (not the page) to a row. */
  private reveal(id: string): void {
    const list = this.element;
    const row = list.querySelector<HTMLElement>(`[data-point="${id}"]`);
    if (!row || list.scrollHeight <= list.clientHeight) return;
    const top = row.offsetTop;
    if (top < list.scrollTop || top + row.offsetHeight > list.scrollTop + list.clientHeight)
      list.scrollTop = top - list.clientHeight / 3;
  }

  private draw(): void {
    const guided = this.points.guided.value;
    this.search.hidden = guided;
    const top = this.element.scrollTop;
    redraw(this.element, () => {
      if (guided)
        replace(
          this.element,
          h(
            'ul',
            {},
            quickSet.map(({ id }) => this.row(pointById(id)!)),
          ),
        );
      else this.drawGroups();
    });
    this.element.scrollTop = top;
  }

  private drawGroups(): void {
    const words = this.words.value.trim().toLowerCase();
    const filter = this.filter.value as Filter;
    const { draft } = this.points;
    const show = (point: NamedPoint): boolean =>
      (filter === 'all' ||
        (filter === 'open' ? !draft.points.has(point.id) : draft.points.get(point.id)?.proposal !== undefined)) &&
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
          shown.map((point) => this.row(point)),
        ),
      );
    });
    const empty: Record<Filter, string> = {
      all: t('No point matches.'),
      open: words === '' ? t('All points are placed.') : t('No point matches.'),
      proposed: words === '' ? t('No point is proposed.') : t('No point matches.'),
    };
    replace(this.element, groups.some((group) => group !== null) ? groups : h('p', { class: 'empty' }, empty[filter]));
  }

  private row(point: NamedPoint): HTMLElement {
    const { draft, problems, chosen } = this.points;
    const place = draft.points.get(point.id);
    const reasons = problems.get(point.id);
    const state = this.stateOf(point.id);
    const confidence = place?.proposal?.confidence;
    return h(
      'li',
      {},
      h(
        'button',
        {
          type: 'button',
          class: `point-row ${state}`,
          'data-point': point.id,
          'data-focus': point.id,
          'aria-pressed': String(chosen.value === point.id),
          on: { click: () => this.points.toggle(point.id) },
        },
        h('span', { class: 'dot', 'aria-hidden': 'true' }),
        h('code', { class: 'id' }, point.id),
        h('span', { class: 'grow name' }, capital(point.name)),
        state === 'proposed'
          ? h('small', { class: 'tag' }, confidence ? confidenceWords[confidence] : pointStateWords.proposed)
          : null,
        h('span', { class: 'visually-hidden' }, pointStateWords[state]),
      ),
      reasons ? reasons.map((text) => h('p', { class: 'reason' }, text)) : null,
    );
  }

  private stateOf(id: string): 'wrong' | 'open' | 'proposed' | 'changed' | 'placed' {
    const { draft, problems } = this.points;
    const place = draft.points.get(id);
    if (problems.has(id)) return 'wrong';
    if (!place) return 'open';
    if (place.proposal) return 'proposed';
    return draft.isChanged(id) ? 'changed' : 'placed';
  }
}
