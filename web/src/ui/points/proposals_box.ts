import type { Confidence } from '../../face/point_draft.ts';
import { h, replace } from '../shared/dom.ts';
import { icon } from '../shared/icons.ts';
import type { PointsModel } from './points_model.ts';
import { confidenceWords } from './proposal_words.ts';
import type { Studio } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

/** Starts the proposal of missing points, and leads the user through the proposed points. */
export class ProposalsBox {
  readonly element = h('div', { class: 'proposals' });

  constructor(
    private readonly studio: Studio,
    private readonly points: PointsModel,
  ) {
    points.changed.watch(() => this.draw());
    points.busy.watch(() => this.draw());
    points.guided.watch(() => this.draw());
    studio.activities.watch(() => this.draw());
  }

  private draw(): void {
    const { points, studio } = this;
    const proposed = points.draft.proposed;
    const missing = points.total - points.draft.points.size;
    const model = studio.selected.value;
    const busy = points.busy.value || model === null || studio.activities.value.has(model.id);
    this.element.hidden = proposed.length === 0 && (missing === 0 || !points.canPropose);
    if (this.element.hidden) return;
    if (proposed.length === 0) {
      // Points that the last job could not propose are not a reason to offer another job.
      const open = missing - points.notProposed.size;
      this.element.hidden = open <= 0;
      const first = points.guided.value && points.quickLeft === 0;
      replace(
        this.element,
        h('p', { class: 'grow' }, t('{missing} of {total} are not placed.', { missing, total: points.total })),
        h(
          'button',
          {
            type: 'button',
            class: `small${first ? ' primary' : ''}`,
            disabled: busy,
            on: { click: () => void points.propose() },
          },
          t('Propose missing points'),
        ),
      );
      return;
    }
    replace(
      this.element,
      h(
        'p',
        { class: 'grow' },
        h('span', { class: 'dot', 'aria-hidden': 'true' }),
        h('strong', {}, t('{count} proposed', { count: proposed.length })),
        h('span', { class: 'muted small' }, ` ${this.sureness(proposed)}`),
      ),
      h(
        'div',
        { class: 'row wrap' },
        h(
          'button',
          { type: 'button', class: 'small', on: { click: () => points.chooseNextProposed() } },
          t('Review'),
          icon('chevron', 14),
        ),
        h(
          'button',
          { type: 'button', class: 'small', disabled: busy, on: { click: () => points.confirmAll() } },
          icon('check', 15),
          t('Confirm all'),
        ),
        h(
          'button',
          { type: 'button', class: 'quiet small', disabled: busy, on: { click: () => points.discardProposals() } },
          t('Discard'),
        ),
      ),
    );
  }

  private sureness(proposed: readonly string[]): string {
    const counts = { high: 0, medium: 0, low: 0 };
    for (const id of proposed) {
      const confidence = this.points.draft.points.get(id)?.proposal?.confidence;
      if (confidence) counts[confidence] += 1;
    }
    return (Object.keys(counts) as Confidence[])
      .filter((key) => counts[key] > 0)
      .map((key) => `${counts[key]} ${confidenceWords[key]}`)
      .join(', ');
  }
}
