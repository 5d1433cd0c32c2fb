import { pointById } from '../../face/feature_points.ts';
import { partnerOf } from '../../face/mirror_points.ts';
import { leastKnownPoints, quickSet } from '../../face/quick_set.ts';
import { h, redraw, replace, type Child } from '../shared/dom.ts';
import { formatNumber } from '../shared/format.ts';
import { icon } from '../shared/icons.ts';
import { capital } from '../shared/names.ts';
import type { PointsModel } from './points_model.ts';
import { proposalWords } from './proposal_words.ts';
import { clickWord } from '../shared/click_word.ts';
import { serverWords, t } from '../../words/words.ts';

/** The selected point: name, place and actions. In guided mode it leads through the quick set. */
export class PointCard {
  readonly element = h('div', { class: 'point-card', 'aria-live': 'polite' });

  constructor(private readonly points: PointsModel) {
    points.changed.watch(() => this.draw());
    points.chosen.watch(() => this.draw());
    points.guided.watch(() => this.draw());
    points.busy.watch(() => this.draw());
    points.lock.on.watch(() => this.draw());
    points.lock.apart.watch(() => this.draw());
  }

  private draw(): void {
    redraw(this.element, () => this.fill());
  }

  private fill(): void {
    const id = this.points.chosen.value;
    const point = id === null ? undefined : pointById(id);
    if (!point) return replace(this.element, this.points.guided.value ? this.invitation() : this.plainInvitation());
    const { draft, problems, notProposed } = this.points;
    const place = draft.points.get(point.id);
    const step = this.points.guided.value ? quickSet.findIndex((one) => one.id === point.id) : -1;
    replace(
      this.element,
      step >= 0 ? h('p', { class: 'step small' }, t('Point {step} of {count}', { step: step + 1, count: quickSet.length })) : null,
      h(
        'div',
        { class: 'row' },
        h('code', { class: 'id' }, point.id),
        h('strong', { class: 'grow' }, capital(point.name)),
        this.linkButton(point.id),
        place ? this.removeButton(point.id) : null,
      ),
      step >= 0 ? h('p', { class: 'hint' }, quickSet[step]!.hint) : null,
      place?.proposal ? h('p', { class: 'small' }, proposalWords(place.proposal)) : null,
      !place && notProposed.has(point.id)
        ? h('p', { class: 'small' }, t('Not proposed: {id}.', { id: serverWords(notProposed.get(point.id) ?? '') }))
        : null,
      h(
        'div',
        { class: 'row' },
        h('p', { class: 'muted small grow' }, this.where(point.id)),
        place?.proposal
          ? h(
              'button',
              {
                type: 'button',
                class: 'small',
                'data-focus': 'confirm',
                title: t('Confirm (Enter on the stage)'),
                on: { click: () => this.points.confirmAndNext(point.id) },
              },
              icon('check', 15),
              t('Confirm'),
            )
          : null,
        this.nextButton(step >= 0 && !place ? t('Skip') : t('Next')),
      ),
      (problems.get(point.id) ?? []).map((text) =>
        h('p', { class: 'reason', role: 'alert' }, icon('warning', 15), text),
      ),
    );
  }

  private where(id: string): string {
    const place = this.points.draft.points.get(id);
    if (!place) return t('{click} on the head to place it.', { click: capital(clickWord()) });
    if (place.vertex === null) return t('At {list}. Drag it, or {click} elsewhere.', { click: clickWord(), list: place.position.map((value) => formatNumber(value, 4)).join(' · ') });
    return t('On vertex {vertex}. Drag it, or {click} elsewhere.', { click: clickWord(), vertex: place.vertex });
  }

  /** Takes this pair apart, or links it again, while left and right points move together. */
  private linkButton(id: string): HTMLElement | null {
    const partner = partnerOf(id);
    const { lock } = this.points;
    if (partner === null || !lock.on.value) return null;
    const linked = lock.twinOf(id) !== null;
    const label = t('{partner} moves with it', { partner });
    return h(
      'button',
      {
        type: 'button',
        class: 'quiet square small',
        'data-focus': 'link',
        'aria-pressed': String(linked),
        'aria-label': label,
        title: linked ? label : t('{partner} stays where it is', { partner }),
        on: { click: () => lock.link(id, !linked) },
      },
      icon(linked ? 'linked' : 'unlinked', 16),
    );
  }

  private removeButton(id: string): HTMLElement {
    return h(
      'button',
      {
        type: 'button',
        class: 'quiet square small',
        'aria-label': t('Remove point {id}', { id }),
        title: t('Remove (Delete)'),
        on: { click: () => this.points.remove(id) },
      },
      icon('trash', 16),
    );
  }

  private nextButton(label: string): HTMLElement | null {
    if (!this.points.hasNext) return null;
    return h(
      'button',
      {
        type: 'button',
        class: 'quiet small next',
        'data-focus': 'next',
        on: { click: () => this.points.chooseNext() },
      },
      label,
      icon('chevron', 14),
    );
  }

  private offerToFind(): Child {
    return [
      h('p', {}, t('The shape of most heads shows where the points are. They are found in seconds, and you review them.')),
      h(
        'div',
        { class: 'row end' },
        h(
          'button',
          {
            type: 'button',
            class: 'primary small',
            disabled: this.points.busy.value,
            'data-focus': 'find',
            on: { click: () => void this.points.propose() },
          },
          t('Find the points'),
        ),
      ),
    ];
  }

  private plainInvitation(): Child {
    return h(
      'p',
      { class: 'muted' },
      t('Choose a point in the drawing or the list, then {click} its place on the head.', { click: clickWord() }),
    );
  }

  private invitation(): Child {
    const left = this.points.quickLeft;
    if (left === 0)
      return h('p', {}, h('strong', {}, t('All twenty are placed. ')), t('Propose the missing points, then review them.'));
    const canFind = this.points.canFind;
    return [
      canFind ? this.offerToFind() : null,
      h(
        'p',
        {},
        canFind ? t('Or place them: ') : null,
        t('{count} points are enough for a talking face. For each one, read its place and {click} there. ', { click: clickWord(), count: quickSet.length }),
        t('From {leastKnownPoints} placed points on, the others can be proposed.', { leastKnownPoints }),
      ),
      h(
        'div',
        { class: 'row end' },
        h(
          'button',
          {
            type: 'button',
            class: `${canFind ? '' : 'primary '}small`,
            'data-focus': 'next',
            on: { click: () => this.points.chooseNext() },
          },
          left === quickSet.length ? t('Start') : t('Go on: {left} left', { left }),
        ),
      ),
    ];
  }
}
