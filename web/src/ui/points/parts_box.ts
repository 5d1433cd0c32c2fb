import type { ModelPart } from '../../net/types.ts';
import { h, redraw, replace, setText } from '../shared/dom.ts';
import { formatCount } from '../shared/format.ts';
import { icon } from '../shared/icons.ts';
import { partName, roleTitles } from '../shared/names.ts';
import { rove } from '../shared/roving.ts';
import type { Studio } from '../shared/studio.ts';
import type { HiddenParts } from './hidden_parts.ts';
import { t } from '../../words/words.ts';

/** From this many parts on, those of one role are one row: teeth may be thirty parts. */
const many = 13;

/** The parts of the head, each of which can be hidden, so that what is behind it can be seen and clicked. */
export class PartsBox {
  readonly element: HTMLDetailsElement;
  private readonly state = h('small', { class: 'muted grow' });
  private readonly list = h('ul', { class: 'eyes' });

  constructor(
    studio: Studio,
    private readonly hidden: HiddenParts,
  ) {
    this.element = h(
      'details',
      { class: 'parts-box' },
      h('summary', {}, icon('chevron', 14), h('span', {}, t('Parts of the head')), this.state),
      this.list,
    );
    rove(this.list, 'button');
    studio.selected.watch(() => this.draw());
    hidden.hidden.watch(() => this.draw());
  }

  private draw(): void {
    const { parts } = this.hidden;
    const hidden = this.hidden.hidden.value;
    this.element.hidden = parts.length < 2;
    const count = parts.filter(({ index }) => hidden.has(index)).length;
    setText(this.state, count === 0 ? '' : count === 1 ? t('1 hidden') : t('{count} hidden', { count }));
    redraw(this.list, () =>
      replace(
        this.list,
        rowsOf(parts).map((row) => this.row(row)),
        h(
          'li',
          {},
          h(
            'button',
            { type: 'button', class: 'quiet small', 'data-focus': 'all', hidden: count === 0, on: { click: () => this.hidden.showAll() } },
            t('Show all'),
          ),
        ),
      ),
    );
  }

  private row({ title, parts }: Row): HTMLElement {
    const indices = parts.map(({ index }) => index);
    const shown = indices.some((part) => !this.hidden.hidden.value.has(part));
    const vertices = parts.reduce((sum, part) => sum + part.vertices, 0);
    return h(
      'li',
      {},
      h(
        'button',
        {
          type: 'button',
          class: `quiet eye${shown ? '' : ' shut'}`,
          'data-focus': `part ${indices[0]}`,
          'data-part': indices[0],
          'aria-pressed': String(shown),
          title: shown ? t('Hide (H over it on the head)') : t('Show'),
          on: { click: () => this.hidden.set(indices, shown) },
        },
        icon(shown ? 'eye' : 'eyeShut', 17),
        h('span', { class: `role-dot role-${parts[0]!.role}`, 'aria-hidden': 'true' }),
        h('span', { class: 'grow name' }, title),
        h('small', { class: 'muted number' }, formatCount(vertices)),
      ),
    );
  }
}

interface Row {
  title: string;
  parts: readonly ModelPart[];
}

/** The largest parts first. */
function rowsOf(parts: readonly ModelPart[]): Row[] {
  const sorted = [...parts].sort((a, b) => b.vertices - a.vertices || a.index - b.index);
  if (sorted.length < many) return sorted.map((part) => ({ title: partName(part), parts: [part] }));
  return [...new Set(sorted.map(({ role }) => role))].flatMap((role) => {
    const members = sorted.filter((part) => part.role === role);
    if (members.length <= 2) return members.map((part) => ({ title: partName(part), parts: [part] }));
    return [{ title: t('{role}, {count} parts', { role: roleTitles[role] ?? role, count: members.length }), parts: members }];
  });
}
