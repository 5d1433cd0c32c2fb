import type { Object3D } from 'three';
import { Loupe } from '../../view/loupe.ts';
import type { PreviewView } from '../../view/preview_view.ts';
import type { PointsModel } from '../points/points_model.ts';
import { h } from '../shared/dom.ts';
import type { Studio } from '../shared/studio.ts';
import type { SceneView } from '../stage/scene.ts';
import { placeLoupe } from './loupe_place.ts';
import type { PickedPoint, PointPicker } from './point_picker.ts';

/** Edge of the loupe, CSS pixels. */
const size = 124;

/** How pointers differ, CSS pixels: how far from a marker they take it, how far they move before it does, what they cover. */
const hands = {
  mouse: { reach: 12, slop: 4, covers: 20 },
  touch: { reach: 28, slop: 8, covers: 44 },
};

interface Held {
  id: string;
  pointer: number;
  hand: (typeof hands)['mouse'];
  down: PointerEvent;
  /** From the pointer to the marker, so that it does not jump. */
  offset: { x: number; y: number };
  preview: PreviewView;
  /** The head without what covers the place of the point, and which parts these are. */
  bare: Object3D | null;
  parts: ReadonlySet<number>;
}

/**
 * Drags a feature point over the head with a mouse, pen or finger, and shows the skin under it in a loupe beside the pointer. A
 * finger drags the chosen point only, since on a small picture there are points wherever it starts to turn the head. A second
 * finger means the view: the point goes back. Picking and drawing happen once per displayed frame.
 */
export class PointDrag {
  readonly element: HTMLElement;
  private readonly loupe: Loupe;
  private held: Held | null = null;
  private dragging = false;
  private moved = false;
  private readonly pointer = { x: 0, y: 0 };
  private readonly place = { x: 0, y: 0 };
  private last: PickedPoint | null = null;
  private without: Object3D[] = [];

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly scene: SceneView,
    private readonly studio: Studio,
    private readonly points: PointsModel,
    private readonly picker: PointPicker,
  ) {
    this.loupe = new Loupe(scene.stage);
    this.element = h('div', { class: 'loupe', hidden: true, 'aria-hidden': 'true' }, this.loupe.canvas);
    this.element.style.width = this.element.style.height = `${size}px`;
    // Before the camera's controls and the clicks of the stage, which do not see what a drag takes.
    canvas.addEventListener('pointerdown', (event) => this.down(event), { capture: true });
    canvas.addEventListener('pointermove', (event) => this.move(event), { capture: true });
    canvas.addEventListener('pointerup', (event) => this.up(event), { capture: true });
    canvas.addEventListener('pointercancel', (event) => {
      if (event.pointerId === this.held?.pointer) this.end(false);
    });
    document.addEventListener(
      'keydown',
      (event) => {
        if (!this.dragging || event.key !== 'Escape') return;
        event.stopPropagation();
        this.end(false);
      },
      { capture: true },
    );
    studio.tab.watch(() => this.end(false));
    scene.state.watch(() => {
      if (this.held && this.held.preview !== scene.preview) this.end(false);
    });
    scene.stage.onFrame(() => {
      if (this.moved) this.step();
      return false;
    });
  }

  private down(event: PointerEvent): void {
    if (!event.isTrusted) return;
    if (this.held) return this.give(event);
    const { scene } = this;
    const { preview } = scene;
    if (this.studio.tab.value !== 'points' || event.button !== 0 || !preview || !scene.markers.object.visible) return;
    const touch = event.pointerType === 'touch';
    const hand = touch ? hands.touch : hands.mouse;
    const box = this.canvas.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    const marker = this.picker.grip(x, y, box.width, box.height, hand.reach, touch);
    if (!marker) return;
    const at = scene.markers.project(marker.position, scene.stage.camera, box.width, box.height);
    const parts = this.picker.partsAround(marker.id);
    this.held = {
      id: marker.id,
      pointer: event.pointerId,
      hand,
      down: event,
      offset: { x: at.x - x, y: at.y - y },
      preview,
      parts,
      bare: null,
    };
    scene.stage.controls.enabled = false;
    this.canvas.setPointerCapture(event.pointerId);
  }

  /** A second finger: the camera's controls take both. */
  private give(second: PointerEvent): void {
    const { down } = this.held!;
    if (second.pointerType !== 'touch' || second.pointerId === down.pointerId) return;
    this.end(false);
    this.canvas.dispatchEvent(new PointerEvent('pointerdown', down));
  }

  private move(event: PointerEvent): void {
    const { held } = this;
    if (event.pointerId !== held?.pointer) return;
    const box = this.canvas.getBoundingClientRect();
    this.pointer.x = event.clientX - box.left;
    this.pointer.y = event.clientY - box.top;
    if (!this.dragging) {
      const { down, hand } = held;
      if (Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) <= hand.slop) return;
      this.begin(held);
    }
    this.moved = true;
  }

  private begin(held: Held): void {
    this.dragging = true;
    this.canvas.classList.add('dragging-point');
    this.points.pick(held.id);
    const bare = held.preview.only(held.parts);
    bare.visible = false;
    this.scene.stage.scene.add(bare);
    held.bare = bare;
    this.element.hidden = false;
  }

  /** Once per frame at most: the point goes to where the pointer is on the head, the loupe beside the pointer. */
  private step(): void {
    this.moved = false;
    const { held, pointer, scene } = this;
    const bare = held?.bare;
    if (!held || !bare) return;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const x = pointer.x + held.offset.x;
    const y = pointer.y + held.offset.y;
    const pick = this.picker.pick(held.id, (x / width) * 2 - 1, 1 - (y / height) * 2);
    if (pick) {
      this.last = pick;
      scene.markers.moveTo(held.id, pick.point.position);
      const twin = this.points.twinOf(held.id, pick.point);
      if (twin) scene.markers.moveTo(twin[0], twin[1].position);
    }
    const at = this.last?.point.position ?? scene.markers.of(held.id)?.position;
    if (!at) return;
    const seen = scene.markers.project(at, scene.stage.camera, width, height);
    // What covers the skin is left out, unless the point lies on what covers it.
    const uncovered = this.last?.part != null && held.parts.has(this.last.part);
    this.without[0] = scene.markers.object;
    this.without[1] = uncovered ? held.preview.object : bare;
    bare.visible = true;
    this.loupe.draw(seen.x, seen.y, size, this.without);
    bare.visible = false;
    placeLoupe(pointer, width, height, size / 2, held.hand.covers, this.place);
    this.element.style.translate = `${this.place.x - size / 2}px ${this.place.y - size / 2}px`;
  }

  private up(event: PointerEvent): void {
    if (event.pointerId !== this.held?.pointer) return;
    // A press without a way is a click.
    if (this.dragging) event.stopImmediatePropagation();
    if (this.moved) this.step();
    this.end(true);
  }

  private end(keep: boolean): void {
    const { held, last, scene } = this;
    if (!held) return;
    const { dragging } = this;
    this.held = null;
    this.last = null;
    this.moved = this.dragging = false;
    this.element.hidden = true;
    this.canvas.classList.remove('dragging-point');
    scene.stage.controls.enabled = true;
    if (!dragging) return;
    if (held.bare) held.preview.release(held.bare);
    if (keep && last) this.points.move(held.id, last.point);
    else this.points.changed.notify(); // the markers go back
    scene.stage.invalidate();
  }
}
