import { pointById } from '../../face/feature_points.ts';
import { pointStateWords } from './proposal_words.ts';
import { h, replace, svg } from '../shared/dom.ts';
import { bestView, drawings, type GuideView } from './guide_data.ts';
import { t } from '../../words/words.ts';

export interface GuideOptions {
  onSelect: (id: string) => void;
}

/** The line drawing that shows the place of each feature point; a click on a dot selects the point. */
export class Guide {
  readonly element: HTMLElement;
  private readonly picture = h('div', { class: 'guide-picture' });
  private readonly switcher = h('div', { class: 'segments small', role: 'group', 'aria-label': t('Drawing') });
  private view: GuideView = 'front';
  private selected: string | null = null;
  private placed: ReadonlySet<string> = new Set();
  private wrong: ReadonlySet<string> = new Set();
  private proposed: ReadonlySet<string> = new Set();

  constructor(private readonly options: GuideOptions) {
    this.element = h('div', { class: 'guide' }, this.picture, this.switcher);
    for (const view of Object.keys(drawings) as GuideView[]) {
      this.switcher.append(
        h('button', { type: 'button', 'data-view': view, on: { click: () => this.show(view) } }, drawings[view].title),
      );
    }
    this.draw();
  }

  select(id: string | null): void {
    this.selected = id;
    if (id !== null && !(id in drawings[this.view].spots)) this.view = bestView(id);
    else if (id !== null && bestView(id) === 'mouth') this.view = 'mouth';
    this.draw();
  }

  mark(placed: ReadonlySet<string>, wrong: ReadonlySet<string>, proposed: ReadonlySet<string>): void {
    this.placed = placed;
    this.wrong = wrong;
    this.proposed = proposed;
    this.draw();
  }

  private show(view: GuideView): void {
    this.view = view;
    this.draw();
  }

  private draw(): void {
    const drawing = drawings[this.view];
    const root = svg('svg', {
      viewBox: drawing.viewBox,
      class: 'guide-drawing',
      role: 'group',
      'aria-label': t('{title}: feature points', { title: drawing.title }),
    });
    for (const stroke of drawing.strokes) {
      root.append(
        svg('path', {
          d: stroke.d,
          class: `line${stroke.soft ? ' soft' : ''}${stroke.fill ? ` fill-${stroke.fill}` : ''}`,
        }),
      );
    }
    const order = Object.entries(drawing.spots).sort(
      ([a], [b]) => Number(a === this.selected) - Number(b === this.selected),
    );
    for (const [id, [x, y]] of order) root.append(this.spot(id, x, y));
    replace(this.picture, root);
    for (const button of this.switcher.querySelectorAll('button')) {
      button.setAttribute('aria-pressed', String(button.dataset['view'] === this.view));
    }
  }

  private spot(id: string, x: number, y: number): SVGElement {
    const state = this.wrong.has(id)
      ? 'wrong'
      : this.proposed.has(id)
        ? 'proposed'
        : this.placed.has(id)
          ? 'placed'
          : 'open';
    const selected = id === this.selected;
    const label = `${id} ${pointById(id)?.name ?? ''}`;
    const group = svg(
      'g',
      {
        class: `spot ${state}${selected ? ' selected' : ''}`,
        role: 'button',
        'aria-label': `${label} (${pointStateWords[state]})`,
      },
      svg('title', {}, label),
    );
    if (selected) group.append(svg('circle', { cx: x, cy: y, r: 8.5, class: 'halo' }));
    group.append(
      svg('circle', { cx: x, cy: y, r: 7, class: 'reach' }),
      svg('circle', { cx: x, cy: y, r: selected ? 4.2 : 2.6, class: 'dot' }),
    );
    group.addEventListener('click', () => this.options.onSelect(id));
    return group;
  }
}
