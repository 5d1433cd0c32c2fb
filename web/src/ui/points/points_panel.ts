import { partnerOf } from '../../face/mirror_points.ts';
import { ask } from '../shared/dialog.ts';
import { h, replace, setText } from '../shared/dom.ts';
import { Guide } from './guide.ts';
import { icon, type IconName } from '../shared/icons.ts';
import { canIdle, setIdle, type Idle } from '../shared/idle.ts';
import { capital } from '../shared/names.ts';
import { ParametrizeBox } from './parametrize_box.ts';
import type { Parametrizer } from './parametrizer.ts';
import type { HiddenParts } from './hidden_parts.ts';
import { PartsBox } from './parts_box.ts';
import { PointCard } from './point_card.ts';
import { PointList } from './point_list.ts';
import type { PointsModel } from './points_model.ts';
import { ProposalsBox } from './proposals_box.ts';
import { uprightBox } from './upright_box.ts';
import type { Studio } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

/** The Points tab: placing the 84 feature points on the open head. */
export class PointsPanel {
  readonly element: HTMLElement;
  private readonly guide: Guide;
  private readonly count = h('span', { class: 'count', 'aria-live': 'polite' });
  private readonly meter = h('div', { class: 'bar', 'aria-hidden': 'true' }, h('span', {}));
  private readonly notices = h('div', { class: 'notices' });
  private readonly undo = this.tool(t('Undo (Ctrl+Z)'), 'undo', () => this.points.undo());
  private readonly redo = this.tool(t('Redo (Ctrl+Shift+Z)'), 'redo', () => this.points.redo());
  private readonly lock = this.tool(
    t('Move left and right points together'),
    'linked',
    () => this.points.lock.lock(!this.points.lock.on.value),
  );
  private readonly mirror = this.tool(
    t('Fill the missing side by mirroring'),
    'mirror',
    () => void this.points.save(true),
  );
  private readonly download = this.tool(t('Export points to a file'), 'download', () => this.points.exportFile());

  constructor(
    private readonly studio: Studio,
    private readonly points: PointsModel,
    parametrizer: Parametrizer,
    hidden: HiddenParts,
  ) {
    document.addEventListener('keydown', (event) => this.key(event));
    for (const button of [this.mirror, this.download]) canIdle(button, studio.toasts);
    this.guide = new Guide({ onSelect: (id) => points.toggle(id) });
    const list = new PointList(points);
    const file = h('input', {
      type: 'file',
      accept: '.json,application/json',
      class: 'visually-hidden',
      id: 'points-file',
      tabindex: -1,
      'aria-label': t('Feature point file'),
    });
    file.addEventListener('change', () => {
      const chosen = file.files?.[0];
      if (chosen) void this.importFile(chosen);
      file.value = '';
    });
    const unread = h('p', { class: 'notice unread-note' });
    this.element = h(
      'div',
      { class: 'panel points' },
      h('h2', { class: 'visually-hidden' }, t('Feature points')),
      unread,
      h(
        'header',
        { class: 'section-head' },
        this.modes(),
        h(
          'div',
          { class: 'row tight' },
          this.undo,
          this.redo,
          this.mirror,
          this.lock,
          this.tool(t('Import points from a file'), 'upload', () => file.click()),
          this.download,
          file,
        ),
      ),
      h('div', { class: 'meter' }, this.meter, this.count),
      uprightBox(studio, points),
      this.guide.element,
      new PointCard(points).element,
      new ProposalsBox(studio, points).element,
      this.notices,
      new PartsBox(studio, hidden).element,
      list.search,
      list.element,
      new ParametrizeBox(studio, points, parametrizer, { withSave: true }).element,
    );
    points.changed.watch(() => this.draw());
    points.lock.on.watch((on) => this.lock.setAttribute('aria-pressed', String(on)));
    points.chosen.watch((id) => this.guide.select(id));
    points.busy.watch(() => this.draw());
    studio.selected.watch((model) => {
      const failed = model?.state === 'failed';
      this.element.classList.toggle('unread', failed || model === null);
      unread.classList.toggle('error', failed);
      replace(
        unread,
        icon(failed ? 'warning' : 'head', 16),
        failed ? t('This head could not be read: open another one, or upload it in another form.') : t('Open a head first: choose one of the list, or upload one.'),
      );
      this.draw();
    });
    studio.activities.watch(() => this.draw());
  }

  private tool(label: string, name: IconName, click: () => void): HTMLButtonElement {
    return h(
      'button',
      { type: 'button', class: 'quiet square', 'aria-label': label, title: label, on: { click } },
      icon(name),
    );
  }

  /** Ctrl+Z, with Shift or Ctrl+Y for redo, anywhere on the page but in a text that is being written or a dialog. */
  private key(event: KeyboardEvent): void {
    if (this.studio.tab.value !== 'points' || !(event.ctrlKey || event.metaKey) || event.altKey) return;
    if ((event.target as Element).closest('dialog, textarea, input:not([type=range], [type=checkbox], [type=file])')) return;
    const key = event.key.toLowerCase();
    if (key !== 'z' && key !== 'y') return;
    event.preventDefault();
    if (key === 'y' || event.shiftKey) this.points.redo();
    else this.points.undo();
  }

  private modes(): HTMLElement {
    const first = h(
      'button',
      { type: 'button', on: { click: () => this.points.guide(true) }, title: t('The twenty points to begin with') },
      t('First 20'),
    );
    const all = h('button', { type: 'button', on: { click: () => this.points.guide(false) } }, t('All 84'));
    this.points.guided.watch((guided) => {
      first.setAttribute('aria-pressed', String(guided));
      all.setAttribute('aria-pressed', String(!guided));
    });
    return h('div', { class: 'segments', role: 'group', 'aria-label': t('Feature points to mark') }, first, all);
  }

  private draw(): void {
    const { draft, problems } = this.points;
    const size = draft.points.size;
    const proposed = draft.proposed.length;
    setText(
      this.count,
      proposed > 0
        ? t('{proposed} of {total} placed, {proposed2} proposed', { proposed: size - proposed, total: this.points.total, proposed2: proposed })
        : t('{count} of {total} placed', { count: size, total: this.points.total }),
    );
    this.meter.querySelector('span')!.style.width = `${((size - proposed) / this.points.total) * 100}%`;
    this.guide.mark(
      new Set(draft.points.keys()),
      new Set([...problems.keys()].filter((id) => id !== '')),
      new Set(draft.proposed),
    );
    const general = problems.get('') ?? [];
    const wrong = [...problems.keys()].filter((id) => id !== '');
    replace(
      this.notices,
      general.map((text) => h('p', { class: 'notice error', role: 'alert' }, icon('warning', 16), capital(text))),
      wrong.length > 0 ? this.refusal(wrong) : null,
      this.dispute(),
    );
    const model = this.studio.selected.value;
    const usable = model !== null && (model.state === 'ready' || model.state === 'parametrized');
    const busy = this.points.busy.value || (model !== null && this.studio.activities.value.has(model.id));
    this.undo.disabled = !draft.canUndo;
    this.redo.disabled = !draft.canRedo;
    const lacks = [...draft.points.keys()].some((id) => !draft.points.has(partnerOf(id) ?? id));
    this.mirror.disabled = busy || !usable;
    const none: Idle | null = size > 0 ? null : { why: t('No point is placed yet.'), help: { label: t('Place the first'), act: () => this.points.chooseFirst() } };
    setIdle(this.mirror, t('Fill the missing side by mirroring'), none ?? (lacks ? null : { why: t('Every point has its other side already.') }));
    setIdle(this.download, t('Export points to a file'), none);
  }

  /** Whose change of a point stays, when someone else has changed it too. */
  private dispute(): HTMLElement | null {
    const { contested } = this.points;
    if (contested.length === 0) return null;
    const settle = (words: string, theirs: boolean): HTMLElement =>
      h('button', { type: 'button', class: 'small', on: { click: () => this.points.settle(theirs) } }, words);
    return h(
      'div',
      { class: 'notice error', role: 'alert' },
      icon('warning', 16),
      h(
        'div',
        {},
        h(
          'p',
          {},
          t('Someone else changed too: '),
          contested.map((id) => h('button', { type: 'button', class: 'link', on: { click: () => this.points.chosen.set(id) } }, id)),
          t('. Yours is shown.'),
        ),
        h('div', { class: 'row' }, settle(t('Take theirs'), true), settle(t('Keep mine'), false)),
      ),
    );
  }

  private refusal(wrong: readonly string[]): HTMLElement {
    return h(
      'p',
      { class: 'notice error', role: 'alert' },
      icon('warning', 16),
      h(
        'span',
        {},
        wrong.length === 1 ? t('Refused: point ') : t('Refused: points '),
        wrong.map((id) =>
          h('button', { type: 'button', class: 'link', on: { click: () => this.points.chosen.set(id) } }, id),
        ),
        this.points.problemsOfFile ? t('. No point of the file was taken.') : t('. Move or remove, then save again.'),
      ),
    );
  }

  /** Takes the points of a file for this head, after a question if it has some. */
  async importFile(file: File): Promise<void> {
    if (this.points.draft.points.size > 0) {
      const yes = await ask({
        title: t('Replace the feature points?'),
        text: t('{name} replaces the {count} points of this head.', { name: file.name, count: this.points.draft.points.size }),
        accept: t('Replace'),
      });
      if (yes === null) return;
    }
    await this.points.importFile(file);
  }
}
