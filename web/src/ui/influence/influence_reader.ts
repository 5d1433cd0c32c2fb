import { Vector3 } from 'three';
import { pickVertex } from '../../face/ray_pick.ts';
import { h, replace, setText } from '../shared/dom.ts';
import { formatCount } from '../shared/format.ts';
import type { SceneView } from '../stage/scene.ts';
import { swatch } from './swatch.ts';
import { percent, readingWords, type InfluenceModel, type Reading } from './influence_model.ts';
import { t } from '../../words/words.ts';

/** How long a finger rests until the place under it is read, ms; and how far it may slip, pixels. */
const pressTime = 450;
const pressSlip = 12;
/** While the face moves under a pointer at rest, the place is read again after this time, ms. */
const rereadTime = 120;
/** How near to a feature point a click chooses it, pixels. */
const reach = { mouse: 13, touch: 22 };
const mostLines = 5;

/**
 * Reads the weights of the vertex under the mouse, a resting finger or the cross (key I), and chooses the feature point that
 * is clicked.
 */
export class InfluenceReader {
  readonly element = h('div', { class: 'reading', hidden: true });
  /** For screen readers: what the key asked for. */
  readonly said = h('div', { class: 'visually-hidden', role: 'status' });
  private readonly pointer = { x: 0, y: 0, over: false };
  private down: { x: number; y: number; time: number } | null = null;
  private press = 0;
  private vertex = -1;
  private lastRead = 0;
  private drawnAtRead = -1;
  private readonly ray = new Float64Array(6);

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly scene: SceneView,
    private readonly model: InfluenceModel,
  ) {
    canvas.addEventListener('pointerdown', (event) => this.start(event));
    canvas.addEventListener('pointermove', (event) => this.move(event));
    canvas.addEventListener('pointerup', (event) => this.end(event));
    canvas.addEventListener('pointercancel', () => this.forget());
    canvas.addEventListener('pointerleave', (event) => event.pointerType !== 'touch' && this.forget());
    canvas.addEventListener('blur', () => this.forget());
    // A long press on a touch screen would open the browser's menu.
    canvas.addEventListener('contextmenu', (event) => this.model.shown && event.preventDefault());
    canvas.addEventListener('keydown', (event) => this.key(event));
    model.on.watch((on) => {
      canvas.classList.toggle('reading-weights', on);
      if (!on) this.forget();
    });
    scene.stage.onFrame(() => this.reread());
  }

  private start(event: PointerEvent): void {
    clearTimeout(this.press);
    if (!this.model.shown) return;
    this.down = { x: event.clientX, y: event.clientY, time: event.timeStamp };
    if (event.pointerType !== 'touch') return;
    this.forget();
    if (!event.isPrimary) return;
    this.follow(event);
    this.press = window.setTimeout(() => this.read(true), pressTime);
  }

  private move(event: PointerEvent): void {
    if (!this.model.shown) return;
    if (event.pointerType === 'touch') {
      const { down } = this;
      if (down && Math.hypot(event.clientX - down.x, event.clientY - down.y) > pressSlip) {
        clearTimeout(this.press);
        this.forget();
      }
      return;
    }
    // A drag turns the head.
    if (event.buttons !== 0) return this.forget();
    this.follow(event);
    this.pointer.over = true;
    this.lastRead = 0;
    this.drawnAtRead = -1; // the next frame reads
  }

  private end(event: PointerEvent): void {
    clearTimeout(this.press);
    const { down } = this;
    this.down = null;
    const slip = down ? Math.hypot(event.clientX - down.x, event.clientY - down.y) : Infinity;
    if (!this.model.shown || event.button !== 0 || slip > pressSlip || event.timeStamp - down!.time > pressTime) return;
    this.follow(event);
    const point = this.pointAt(event.pointerType === 'touch' ? reach.touch : reach.mouse);
    if (point !== null) this.model.choose(point, event.shiftKey || event.ctrlKey || event.metaKey);
  }

  private key(event: KeyboardEvent): void {
    if (!this.model.shown || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === 'Escape') return this.forget();
    if (event.key.toLowerCase() !== 'i') return;
    event.preventDefault();
    this.pointer.x = this.canvas.clientWidth / 2;
    this.pointer.y = this.canvas.clientHeight / 2;
    this.read(false);
    const reading = this.model.read(this.vertex);
    setText(this.said, reading ? readingWords(reading) : t('There is no face under the cross.'));
  }

  /** Once per displayed frame; allocates only when another vertex comes under the pointer. */
  private reread(): boolean {
    const { drawn } = this.scene.stage;
    if (!this.pointer.over || this.drawnAtRead === drawn || performance.now() - this.lastRead < rereadTime) return false;
    if (!this.model.shown) this.forget();
    else this.read(false);
    this.drawnAtRead = drawn;
    return false;
  }

  private follow(event: PointerEvent): void {
    const box = this.canvas.getBoundingClientRect();
    this.pointer.x = event.clientX - box.left;
    this.pointer.y = event.clientY - box.top;
  }

  private forget(): void {
    clearTimeout(this.press);
    this.pointer.over = false;
    this.vertex = -1;
    this.element.hidden = true;
  }

  private read(touch: boolean): void {
    this.lastRead = performance.now();
    const vertex = this.pick();
    if (vertex < 0) {
      this.vertex = -1;
      this.element.hidden = true;
      return;
    }
    if (vertex !== this.vertex) {
      this.vertex = vertex;
      this.show(this.model.read(vertex)!);
    }
    this.place(touch);
  }

  /** The vertex of the moved face under the pointer, or -1. */
  private pick(): number {
    const { influence } = this.scene;
    const positions = this.positions();
    if (!influence || !positions) return -1;
    const { camera } = this.scene.stage;
    // World axes are the model's.
    near.set((this.pointer.x / this.canvas.clientWidth) * 2 - 1, 1 - (this.pointer.y / this.canvas.clientHeight) * 2, 0.5);
    near.unproject(camera).sub(camera.position);
    camera.position.toArray(this.ray, 0);
    near.toArray(this.ray, 3);
    return pickVertex(positions, influence.indices, this.ray);
  }

  private positions(): Float32Array | null {
    const performer = this.scene.performer.value;
    if (!performer) return null;
    performer.kernel.deform(performer.poseNumber);
    return performer.kernel.positions;
  }

  private pointAt(within: number): string | null {
    const { influence, rig, stage } = this.scene;
    const positions = this.positions();
    if (!influence || !rig || !positions) return null;
    let best: string | null = null;
    let least = within;
    rig.feature_points.forEach(({ id }, i) => {
      if (!this.model.moving.has(id)) return;
      const place = influence.placeOf(i, positions, near).project(stage.camera);
      const x = ((place.x + 1) / 2) * this.canvas.clientWidth - this.pointer.x;
      const y = ((1 - place.y) / 2) * this.canvas.clientHeight - this.pointer.y;
      const distance = Math.hypot(x, y);
      if (place.z > 1 || distance >= least) return;
      least = distance;
      best = id;
    });
    return best;
  }

  private show(reading: Reading): void {
    const { vertex, points } = reading;
    const rest = points.slice(mostLines);
    replace(
      this.element,
      h('strong', {}, t('Vertex {vertex}', { vertex: formatCount(vertex) })),
      points.length === 0 ? h('p', {}, t('Follows no feature point.')) : null,
      points.slice(0, mostLines).map(({ id, name, weight }) => {
        const colour = this.model.colourOf(id);
        return h(
          'div',
          { class: 'reading-row' },
          h('b', {}, percent(weight)),
          colour ? swatch(colour) : null,
          h('span', {}, `${id} ${name}`),
        );
      }),
      rest.length > 0 ? h('p', {}, t('and {count} more: {weight}', { count: rest.length, weight: percent(rest.reduce((sum, one) => sum + one.weight, 0)) })) : null,
    );
  }

  /** Beside the pointer; above a finger. Always within the stage. */
  private place(touch: boolean): void {
    const { element } = this;
    element.hidden = false;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const { offsetWidth: own, offsetHeight: tall } = element;
    const x = touch ? this.pointer.x - own / 2 : this.pointer.x + 18 + own > width ? this.pointer.x - 18 - own : this.pointer.x + 18;
    const y = touch ? this.pointer.y - tall - 40 : this.pointer.y - tall / 2;
    const inside = (at: number, most: number): number => Math.round(Math.max(8, Math.min(at, most - 8)));
    element.style.translate = `${inside(x, width - own)}px ${inside(y, height - tall)}px`;
  }
}

const near = new Vector3();
