import { problemOf } from '../../net/problem.ts';
import type { Model } from '../../net/types.ts';
import type { Parametrizer } from '../points/parametrizer.ts';
import { h, replace, setText } from '../shared/dom.ts';
import { Signal } from '../shared/signal.ts';
import type { Studio } from '../shared/studio.ts';
import type { SceneView } from '../stage/scene.ts';
import type { CompareView } from './compare_view.ts';
import { differenceFrom, faceCaption, levelTitle, methodTitle, type ShownFace } from './face_caption.ts';
import { t } from '../../words/words.ts';

/** The weights that every model can have; `fitted` needs shapes of the model's own. */
const methods = (['smooth', 'paper'] as const).flatMap((weights) =>
  (['edge', 'unfolded'] as const).map((metric) => ({ weights, metric })),
);
type Method = (typeof methods)[number];
/** The value and the title of an option. */
type Choice = [string, string];

/** The value of an option: what it is, and which. */
const key = (...words: (string | number)[]): string => words.join(' ');

/** Chooses the face that is seen beside the one on the stage. */
export class ComparePanel {
  readonly element: HTMLElement;
  /** Where the second view stands. */
  readonly seat = h('div', { class: 'compare-seat', hidden: true });
  /** What the first view shows, over its picture. */
  readonly label = h('div', { class: 'compare-label' }, h('span', { class: 'compare-text' }));
  private readonly select = h('select', { id: 'compare-with' });
  private readonly note = h('p', { class: 'muted small' });
  private readonly go = h('button', { type: 'button', class: 'primary', on: { click: () => void this.parametrize() } }, t('Parametrize again and compare'));
  private readonly view = new Signal<CompareView | null>(null);
  private readonly busy = new Signal(false);
  /** The weights that are chosen and have to be computed first. */
  private readonly wanted = new Signal<Method | null>(null);
  /** What the second view shows. */
  private beside: ShownFace | null = null;
  /** What the list was made of. */
  private listed = '';

  /** `load` makes the second view, whose code is loaded when it is first wanted. */
  constructor(
    private readonly studio: Studio,
    private readonly scene: SceneView,
    private readonly parametrizer: Parametrizer,
    private readonly load: (close: () => void) => Promise<CompareView>,
  ) {
    this.element = h(
      'section',
      { class: 'compare' },
      h(
        'header',
        { class: 'section-head' },
        h('h2', {}, t('Side by side')),
        h('span', { class: 'muted small' }, t('one camera, one motion')),
      ),
      h('label', { class: 'field-row', for: 'compare-with' }, h('span', {}, t('Beside it')), this.select),
      this.note,
      this.go,
    );
    this.select.addEventListener('change', () => void this.choose(this.select.value));
    for (const signal of [studio.selected, studio.models, scene.level, scene.faceShown, this.view, this.wanted, this.busy] as Signal<unknown>[])
      signal.watch(() => this.draw());
  }

  close(): void {
    this.wanted.set(null);
    const view = this.view.value;
    if (!view) return;
    const focused = this.seat.contains(document.activeElement);
    view.dispose();
    this.view.set(null);
    this.frame();
    if (focused) this.select.focus();
  }

  private async choose(value: string): Promise<void> {
    const [kind, first = '', second = ''] = value.split(' ');
    const model = this.studio.selected.value;
    this.wanted.set(kind === 'method' ? (methods.find(({ weights, metric }) => weights === first && metric === second) ?? null) : null);
    if (kind === 'none') this.close();
    else if (kind === 'level' && model) await this.show(model, Number(first));
    else if (kind === 'head') {
      const other = this.studio.models.value.find(({ id }) => id === first);
      if (other) await this.show(other, 0);
    }
  }

  private async show(model: Model, level: number): Promise<boolean> {
    this.beside = { model, level };
    try {
      if (!this.view.value) {
        const view = await this.load(() => this.close());
        this.seat.replaceChildren(view.element);
        this.view.set(view);
        this.frame();
      }
    } catch (error) {
      this.studio.toasts.problem(t('The second view was not opened'), problemOf(error));
      return false;
    }
    this.draw();
    return (await this.view.value?.open(model, level)) ?? false;
  }

  /** Shows the whole face again: the picture has another width, which it takes over after the next frame. */
  private frame(): void {
    requestAnimationFrame(() => requestAnimationFrame(() => this.scene.stage.frameFace()));
  }

  /** Keeps the present face in the second view and gives the head the other weights. */
  private async parametrize(): Promise<void> {
    const model = this.studio.selected.value;
    const made = model?.package;
    const method = this.wanted.value;
    if (!model || !made || !method) return;
    this.busy.set(true);
    try {
      if (!(await this.show(model, 0))) return;
      await this.studio.parametrize(model, {
        ...this.parametrizer.options.value,
        ...method,
        weight_bits: made.weight_bits,
        lods: made.levels.slice(1).map(({ vertices }) => vertices),
      });
      this.wanted.set(null);
    } catch (error) {
      this.studio.toasts.problem(t('The head was not parametrized'), problemOf(error));
    } finally {
      this.busy.set(false);
    }
  }

  private draw(): void {
    const model = this.studio.selected.value;
    const open = this.view.value !== null;
    this.element.hidden = model?.state !== 'parametrized' && !open;
    // The still model of the tabs Fit and Points has no second view.
    const shown = open && this.scene.faceShown.value;
    this.seat.hidden = !shown;
    this.label.hidden = !shown;
    if (shown && model && this.beside) {
      const face = { model, level: this.scene.level.value };
      setText(this.label.firstElementChild!, differenceFrom(face, this.beside));
      this.label.title = faceCaption(face);
      this.view.value?.name(this.beside, face);
    }
    this.fill(model, open);
    const { value: wanted } = this.wanted;
    const busy = this.busy.value;
    this.note.hidden = this.go.hidden = wanted === null;
    if (!wanted) return;
    setText(this.go, busy ? t('Parametrizing') : t('Parametrize again and compare'));
    this.go.disabled = this.select.disabled = busy;
    setText(
      this.note,
      t('The server has one set of weights per head. It computes these instead, for everyone; the present ones stay in the second view and can be chosen here again.'),
    );
  }

  private fill(model: Model | null, open: boolean): void {
    const wanted = this.wanted.value;
    const caption = this.beside ? faceCaption(this.beside) : '';
    this.select.disabled = this.busy.value;
    const groups = this.choices(model);
    // A list that is open under the user's hand would close if it were made again.
    const listed = JSON.stringify([open && caption, groups]);
    if (listed !== this.listed) {
      this.listed = listed;
      const option = ([value, title]: Choice): HTMLElement => h('option', { value }, title);
      replace(
        this.select,
        option(['none', t('Nothing')]),
        open ? option(['shown', caption]) : null,
        groups.filter(({ choices }) => choices.length > 0).map(({ label, choices }) => h('optgroup', { label }, choices.map(option))),
      );
    }
    this.select.value = wanted ? key('method', wanted.weights, wanted.metric) : open ? 'shown' : 'none';
  }

  private choices(model: Model | null): { label: string; choices: Choice[] }[] {
    const made = model?.package ?? null;
    const levels = made?.levels.filter(({ lod }) => lod !== this.scene.level.value) ?? [];
    const others = made ? methods.filter(({ weights, metric }) => weights !== made.weights || metric !== made.metric) : [];
    const heads = this.studio.models.value.filter(({ id, state }) => state === 'parametrized' && id !== model?.id);
    return [
      { label: t('Another level of detail'), choices: levels.map(({ lod, vertices }) => [key('level', lod), levelTitle(lod, vertices)]) },
      { label: t('Other weights'), choices: others.map((method) => [key('method', method.weights, method.metric), methodTitle(method)]) },
      { label: t('Another head'), choices: heads.map(({ id, name }) => [key('head', id), name]) },
    ];
  }
}
