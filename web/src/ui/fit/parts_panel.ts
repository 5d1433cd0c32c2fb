import type { Model, ModelPart, PartRole } from '../../net/types.ts';
import { h, replace } from '../shared/dom.ts';
import type { FitModel } from './fit_model.ts';
import { formatCount } from '../shared/format.ts';
import { icon } from '../shared/icons.ts';
import { partName, roleTitles } from '../shared/names.ts';
import type { Studio } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

const roles = Object.keys(roleTitles) as PartRole[];

/** The parts of the open head with their roles, which the user can correct. */
export class PartsPanel {
  readonly element: HTMLElement;
  private readonly note = h('p', { class: 'muted small' });
  private readonly list = h('ul', { class: 'parts' });
  private drawn = '';

  constructor(
    private readonly studio: Studio,
    private readonly fit: FitModel,
  ) {
    this.element = h(
      'section',
      { class: 'parts-section' },
      h('header', { class: 'section-head' }, h('h2', {}, t('Parts and roles'))),
      this.note,
      this.list,
    );
    studio.selected.watch((model) => this.draw(model));
    studio.activities.watch(() => this.lock());
    fit.part.watch((part) => {
      for (const row of this.list.querySelectorAll<HTMLElement>('[data-part]'))
        row.classList.toggle('chosen', row.dataset['part'] === String(part));
    });
  }

  /** Scrolls to a part's row, or to the first; `focus` also focuses its role select. */
  reveal(part: number | null, focus: boolean): void {
    const row = this.list.querySelector<HTMLElement>(part === null ? '[data-part]' : `[data-part="${part}"]`);
    const group = row?.closest('details');
    if (group) group.open = true;
    (row ?? this.element).scrollIntoView({ block: 'center' });
    if (focus) row?.querySelector('select')?.focus({ preventScroll: true });
    if (part !== null) this.fit.choosePart(part);
  }

  private draw(model: Model | null): void {
    const parts = [...(model?.parts ?? [])].sort((a, b) => b.vertices - a.vertices || a.index - b.index);
    const key = JSON.stringify([model?.id, parts.map((part) => [part.index, part.role, part.role_by_user])]);
    if (key === this.drawn) return;
    const focused = this.list.contains(document.activeElement)
      ? document.activeElement?.closest('[data-part]')?.getAttribute('data-part')
      : null;
    const open = new Set(
      [...this.list.querySelectorAll<HTMLDetailsElement>('details[open]')].map((group) => group.dataset['role']),
    );
    this.drawn = key;
    this.element.hidden = parts.length === 0;
    const byHand = parts.filter((part) => part.role_by_user).length;
    replace(
      this.note,
      t('A part is a connected piece of the mesh. Correct wrongly guessed roles, then parametrize.'),
      byHand > 0 ? byHand === 1 ? t(' One is yours.') : t(' {byHand} are yours.', { byHand }) : '',
    );
    // Teeth may be thirty parts: many parts of one role form a collapsed group.
    const groups = new Map<PartRole, ModelPart[]>();
    for (const part of parts) groups.set(part.role, [...(groups.get(part.role) ?? []), part]);
    replace(
      this.list,
      [...groups].map(([role, members]) =>
        parts.length <= 8 || members.length <= 2
          ? members.map((part) => this.row(part))
          : h(
              'li',
              {},
              h(
                'details',
                { class: 'part-group', 'data-role': role, open: open.has(role) },
                h(
                  'summary',
                  {},
                  icon('chevron', 14),
                  h('span', { class: 'grow' }, roleTitles[role] ?? role),
                  h('small', { class: 'muted number' }, t('{count} parts', { count: members.length })),
                ),
                h(
                  'ul',
                  { class: 'parts' },
                  members.map((part) => this.row(part)),
                ),
              ),
            ),
      ),
    );
    this.lock();
    if (focused) this.list.querySelector<HTMLElement>(`[data-part="${focused}"] select`)?.focus();
  }

  private row(part: ModelPart): HTMLElement {
    const name = partName(part);
    const select = h(
      'select',
      { 'aria-label': t('Role of {name} (part {index})', { name, index: part.index }) },
      roles.map((role) => h('option', { value: role }, roleTitles[role] ?? role)),
      part.role_by_user ? h('option', { value: '' }, t('Guess again')) : null,
    );
    select.value = part.role;
    select.addEventListener('change', () => void this.change(part, select));
    const row = h(
      'li',
      { class: `part${part.role_by_user ? ' by-hand' : ''}`, 'data-part': part.index },
      h(
        'button',
        {
          type: 'button',
          class: 'quiet part-show',
          title: t('Show this part'),
          on: { click: () => this.fit.choosePart(this.fit.part.value === part.index ? null : part.index) },
        },
        h('span', { class: `role-dot role-${part.role}`, 'aria-hidden': 'true' }),
        h(
          'span',
          { class: 'part-text' },
          h(
            'span',
            { class: 'name' },
            name,
            part.name === '' ? null : h('small', { class: 'muted number' }, ` ${part.index}`),
          ),
          h(
            'small',
            { class: 'muted number' },
            part.triangles === 0
              ? t('{count} loose vertices', { count: formatCount(part.vertices) })
              : t('{count} vertices', { count: formatCount(part.vertices) }),
            ' · ',
            part.role_by_user ? t('yours') : t('guessed'),
          ),
        ),
      ),
      select,
    );
    // Hovering highlights a part temporarily; a click selects it.
    row.addEventListener('pointerenter', (event) => {
      if (event.pointerType === 'mouse') this.fit.hoveredPart.set(part.index);
    });
    row.addEventListener('pointerleave', () => this.fit.hoveredPart.set(null));
    row.addEventListener('focusin', () => this.fit.hoveredPart.set(part.index));
    row.addEventListener('focusout', () => this.fit.hoveredPart.set(null));
    return row;
  }

  private async change(part: ModelPart, select: HTMLSelectElement): Promise<void> {
    const model = this.studio.selected.value;
    if (!model) return;
    const role = select.value === '' ? null : (select.value as PartRole);
    if (!(await this.studio.setRole(model, part.index, role))) select.value = part.role;
  }

  private lock(): void {
    const model = this.studio.selected.value;
    const busy = model === null || this.studio.activities.value.has(model.id);
    for (const select of this.list.querySelectorAll('select')) select.disabled = busy;
  }
}
