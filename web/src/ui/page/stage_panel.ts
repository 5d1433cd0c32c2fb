import type { ViewName } from '../../view/stage.ts';
import type { Model } from '../../net/types.ts';
import { h, replace, setText } from '../shared/dom.ts';
import { formatBytes } from '../shared/format.ts';
import { rove } from '../shared/roving.ts';
import { icon, type IconName } from '../shared/icons.ts';
import { pointById } from '../../face/feature_points.ts';
import type { PointsModel } from '../points/points_model.ts';
import type { PointPicker } from './point_picker.ts';
import type { SceneView } from '../stage/scene.ts';
import { overlayCard } from './stage_overlay.ts';
import type { Signal } from '../shared/signal.ts';
import type { Studio } from '../shared/studio.ts';
import { capital } from '../shared/names.ts';
import { clickWord } from '../shared/click_word.ts';
import { t } from '../../words/words.ts';

const views: { name: ViewName; label: string; key: string }[] = [
  { name: 'front', label: t('Front'), key: '1' },
  { name: 'three-quarter', label: t('Three-quarter'), key: '2' },
  { name: 'left', label: t('Left'), key: '3' },
  { name: 'right', label: t('Right'), key: '4' },
];

/**
 * How far an arrow key with Shift moves the head, in heights of the picture: a press puts a place under the cross to a few
 * millimetres, a held key crosses the face in less than a second.
 */
const onePan = 0.01;
const heldPan = 0.04;

/** The stage with its tools: views, wireframe, deformation path, and placing of feature points with the pointer. */
export class StagePanel {
  readonly element: HTMLElement;
  private readonly overlay = h('div', { class: 'stage-overlay' });
  private readonly label = h('div', { class: 'marker-label', hidden: true });
  private readonly hint = h('div', { class: 'stage-hint', hidden: true });
  private readonly figures = h('output', { class: 'figures', 'aria-label': t('Display rate') });
  private down: { x: number; y: number; time: number } | null = null;
  /** Called when a head is to be uploaded. */
  onUpload: () => void = () => {};
  /** Called when a head that could not be read is to go. */
  onRemove: (model: Model) => void = () => {};
  /** Called when the sample head is to be added. */
  onSample: () => void = () => {};
  /** Called when a part is clicked while parts can be selected. */
  onPart: (part: number) => void = () => {};

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly scene: SceneView,
    private readonly studio: Studio,
    private readonly points: PointsModel,
    private readonly picker: PointPicker,
    top: readonly HTMLElement[],
    private readonly influence: Signal<boolean>,
  ) {
    canvas.tabIndex = 0;
    canvas.setAttribute('role', 'application');
    canvas.setAttribute(
      'aria-label',
      t('The head. Arrow keys turn it, with Shift they move it, plus and minus zoom, 1 to 4 choose a view, F shows the whole face. ') +
        t('Space places the chosen feature point at the cross, Enter confirms it, N goes to the next. ') +
        t('With the influence view I reads the weights at the cross.'),
    );
    this.element = h(
      'div',
      { class: 'stage-holder' },
      canvas,
      h('div', { class: 'stage-cross', 'aria-hidden': 'true' }),
      this.label,
      h('div', { class: 'stage-top' }, top, this.hint),
      this.overlay,
      this.makeTools(),
      this.figures,
    );
    canvas.addEventListener(
      'pointerdown',
      (event) => (this.down = { x: event.clientX, y: event.clientY, time: event.timeStamp }),
    );
    canvas.addEventListener('pointerup', (event) => this.click(event));
    canvas.addEventListener('pointermove', (event) => this.hover(event));
    canvas.addEventListener('pointerleave', () => (this.label.hidden = true));
    canvas.addEventListener('dblclick', (event) => this.focus(event));
    canvas.addEventListener('keydown', (event) => this.key(event));
    scene.state.watch(() => this.drawOverlay());
    for (const signal of [studio.activities, studio.shelf, studio.models] as Signal<unknown>[]) signal.watch(() => this.drawOverlay());
    const hint = (): void => this.drawHint();
    studio.tab.watch(hint);
    points.chosen.watch(hint);
    points.changed.watch(hint);
    setInterval(() => this.drawFigures(), 500);
  }

  private makeTools(): HTMLElement {
    const wire = toggle(t('Wireframe'), 'wire', (on) => (this.scene.wireframe = on));
    const influence = toggle(t('Influence of the points'), 'influence', (on) => this.influence.set(on));
    this.influence.watch((on) => influence.setAttribute('aria-pressed', String(on)));
    this.scene.faceShown.watch((face) => (influence.hidden = !face));
    const path = h(
      'button',
      {
        type: 'button',
        class: 'tool path',
        title: t('Where the vertices are deformed: on the graphics card or by the WebAssembly kernel'),
        'aria-label': t('Deform on the GPU'),
        on: {},
      },
      'GPU',
    );
    path.addEventListener('click', () => {
      this.scene.deformPath = this.scene.deformPath === 'gpu' ? 'wasm' : 'gpu';
      const gpu = this.scene.deformPath === 'gpu';
      path.textContent = gpu ? 'GPU' : 'WASM';
      path.setAttribute('aria-label', gpu ? t('Deform on the GPU') : t('Deform with WebAssembly'));
    });
    const tools = h(
      'div',
      { class: 'tools', role: 'toolbar', 'aria-label': t('View') },
      views.map(({ name, label, key }) =>
        h(
          'button',
          {
            type: 'button',
            class: 'tool',
            title: t('{label} view ({key})', { label, key }),
            on: { click: () => this.scene.stage.look(name) },
          },
          name === 'three-quarter' ? '3/4' : label,
        ),
      ),
      h('span', { class: 'divider' }),
      influence,
      wire,
      path,
    );
    rove(tools, 'button');
    return tools;
  }

  private click(event: PointerEvent): void {
    const { down } = this;
    this.down = null;
    if (
      !down ||
      event.button !== 0 ||
      // Touch needs a larger threshold between a click and a drag than a mouse.
      Math.hypot(event.clientX - down.x, event.clientY - down.y) > (event.pointerType === 'touch' ? 12 : 5) ||
      event.timeStamp - down.time > 600
    )
      return;
    const { tab } = this.studio;
    if ((tab.value !== 'points' && tab.value !== 'fit') || !this.scene.preview) return;
    const { x, y, width, height } = this.place(event);
    if (tab.value === 'fit') {
      const pick = this.scene.preview.pick((x / width) * 2 - 1, 1 - (y / height) * 2, this.scene.stage.camera);
      if (pick && pick.part !== null) this.onPart(pick.part);
      return;
    }
    if (this.points.chosen.value === null) {
      const marker = this.scene.markers.at(x, y, this.scene.stage.camera, width, height, 14);
      if (marker) this.points.pick(marker.id);
      return;
    }
    this.placeAt((x / width) * 2 - 1, 1 - (y / height) * 2);
  }

  /** Zooms to what is under the pointer; while a point is being placed, two clicks are two corrections of its place. */
  private focus(event: MouseEvent): void {
    if (this.studio.tab.value === 'points' && this.points.chosen.value !== null) return;
    const { x, y, width, height } = this.place(event);
    const place = this.scene.surfaceAt((x / width) * 2 - 1, 1 - (y / height) * 2);
    if (place) this.scene.stage.focus(place);
  }

  /** Places the selected point on the head at `x`, `y` (normalized device coordinates, -1..1 from the lower left). */
  private placeAt(x: number, y: number): void {
    const pick = this.picker.pickNear(this.points.chosen.value ?? '', x, y);
    if (pick) this.points.place(pick.point);
  }

  private hover(event: PointerEvent): void {
    if (this.studio.tab.value !== 'points' || event.buttons !== 0) {
      this.label.hidden = true;
      return;
    }
    const { x, y, width, height } = this.place(event);
    const marker = this.scene.markers.at(x, y, this.scene.stage.camera, width, height, 12);
    this.label.hidden = marker === null;
    this.canvas.classList.toggle('placing', this.points.chosen.value !== null);
    this.canvas.classList.toggle('over-point', marker !== null);
    if (!marker) return;
    setText(this.label, `${marker.id}  ${pointById(marker.id)?.name ?? ''}`);
    const at = this.scene.markers.project(marker.position, this.scene.stage.camera, width, height);
    this.label.style.translate = `${Math.min(Math.max(at.x, 90), width - 90)}px ${at.y}px`;
  }

  private place(event: MouseEvent): { x: number; y: number; width: number; height: number } {
    const box = this.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top, width: box.width, height: box.height };
  }

  private key(event: KeyboardEvent): void {
    const { stage } = this.scene;
    const chosen = this.points.chosen.value;
    const pan = event.repeat ? heldPan : onePan;
    const move = (right: number, up: number): void =>
      event.shiftKey ? stage.pan(right * pan, up * pan) : stage.orbit(right * 0.12, -up * 0.12);
    const zoom = (factor: number): void => stage.zoom(factor, this.scene.surfaceAt(0, 0));
    const actions: Record<string, () => void> = {
      ArrowLeft: () => move(-1, 0),
      ArrowRight: () => move(1, 0),
      ArrowUp: () => move(0, 1),
      ArrowDown: () => move(0, -1),
      '+': () => zoom(0.9),
      '=': () => zoom(0.9),
      '-': () => zoom(1.1),
      f: () => stage.frameFace(),
      F: () => stage.frameFace(),
      Escape: () => this.points.chosen.set(null),
    };
    if (this.studio.tab.value === 'points') {
      actions['n'] = actions['N'] = () => this.points.chooseNext();
      if (chosen !== null) {
        actions['Delete'] = actions['Backspace'] = () => this.points.remove(chosen);
        actions[' '] = () => this.placeAt(0, 0);
        if (this.points.draft.points.get(chosen)?.proposal) actions['Enter'] = () => this.points.confirmAndNext(chosen);
      }
    }
    views.forEach(({ name, key }) => (actions[key] = () => stage.look(name)));
    const action = event.ctrlKey || event.metaKey || event.altKey ? undefined : actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  private drawHint(): void {
    const id = this.points.chosen.value;
    this.hint.hidden = this.studio.tab.value !== 'points' || this.scene.preview === null;
    this.canvas.classList.toggle('placing', !this.hint.hidden && id !== null);
    if (this.hint.hidden) return;
    const name = id === null ? '' : (pointById(id)?.name ?? '');
    const words =
      id === null
        ? t('Choose a point, then {click} on the head.', { click: clickWord() })
        : this.points.draft.points.has(id)
          ? t('Drag {id}, or {click} where it lies: {name}', { click: clickWord(), id, name })
          : t('{click} where {id} lies: {name}', { click: capital(clickWord()), id, name });
    replace(this.hint, icon('point', 16), h('span', {}, words));
  }

  private drawOverlay(): void {
    this.drawHint();
    const state = this.scene.state.value;
    const model = this.studio.selected.value;
    const activity = model ? this.studio.activities.value.get(model.id) : undefined;
    this.overlay.hidden = state.kind === 'ready';
    const again = model && model.state !== 'failed' ? () => void this.scene.open(model) : null;
    replace(
      this.overlay,
      overlayCard(state, {
        activity,
        again,
        shelf: this.studio.shelf.value,
        heads: this.studio.models.value.length > 0,
        reload: () => location.reload(),
        upload: () => this.onUpload(),
        remove: model?.state === 'failed' ? () => this.onRemove(model) : null,
        addSample: () => this.onSample(),
      }),
    );
  }

  private drawFigures(): void {
    const rate = this.scene.stage.framesPerSecond;
    const bytes = this.scene.packageBytes.value;
    // A stage at rest draws only on demand, so its frame rate is meaningless.
    const words = [bytes > 0 ? t('{bytes} face', { bytes: formatBytes(bytes) }) : '', rate > 4 ? t('{rate} fps', { rate }) : ''];
    setText(this.figures, words.filter((word) => word !== '').join(' · '));
  }
}

function toggle(label: string, name: IconName, change: (on: boolean) => void): HTMLElement {
  const button = h(
    'button',
    { type: 'button', class: 'tool', 'aria-label': label, title: label, 'aria-pressed': 'false' },
    icon(name),
  );
  button.addEventListener('click', () => {
    const on = button.getAttribute('aria-pressed') !== 'true';
    button.setAttribute('aria-pressed', String(on));
    change(on);
  });
  return button;
}
