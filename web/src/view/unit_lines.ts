import {
  BoxGeometry,
  CanvasTexture,
  Group,
  Mesh,
  MeshBasicMaterial,
  Quaternion,
  Sprite,
  SpriteMaterial,
  SRGBColorSpace,
  Vector3,
} from 'three';
import { fieldOfView } from '@client/gpu/studio_look.ts';
import type { Pose } from '@client/kernel.ts';

/** A length on the face with its words. A line without words has no label. */
export interface LabelledLine {
  from: readonly [number, number, number];
  to: readonly [number, number, number];
  words: string;
  /** Where the label is, as seen from in front. */
  side: 'above' | 'below' | 'beside';
}

const labelHeight = 22; // CSS pixels
const ink = '#1d1a18';
const paper = '#fff7e8';

/**
 * Lines with labels on the neutral face, which turn with the head and are seen through it. Labels keep their size on the
 * screen.
 */
export class UnitLines {
  readonly object = new Group();
  private readonly turn = new Quaternion();
  private readonly pivot = new Vector3();

  /** `thickness` of a line, model units. */
  constructor(lines: readonly LabelledLine[], thickness: number) {
    for (const line of lines) {
      const from = new Vector3(...line.from);
      const to = new Vector3(...line.to);
      for (const [order, color, wide] of [
        [20, ink, 2.4],
        [21, paper, 1],
      ] as const) {
        const material = new MeshBasicMaterial({ color, depthTest: false, transparent: true, toneMapped: false });
        const bar = new Mesh(new BoxGeometry(1, 1, 1), material);
        bar.scale.subVectors(to, from).addScalar(thickness * wide);
        bar.position.lerpVectors(from, to, 0.5);
        bar.renderOrder = order;
        this.object.add(bar);
        for (const end of [from, to]) {
          const tick = new Mesh(bar.geometry, material);
          const along = Math.abs(to.x - from.x) > Math.abs(to.y - from.y);
          const across = thickness * (5 + wide);
          tick.scale.set(along ? thickness * wide : across, along ? across : thickness * wide, thickness * wide);
          tick.position.copy(end);
          tick.renderOrder = order;
          this.object.add(tick);
        }
      }
      if (line.words !== '') this.object.add(label(line, from.clone().lerp(to, 0.5)));
    }
  }

  /** Follows the head. Allocates nothing. */
  setPose({ headRotation, headPivot }: Pose): void {
    this.turn.fromArray(headRotation);
    this.pivot.fromArray(headPivot);
    this.object.quaternion.copy(this.turn);
    this.object.position.copy(this.pivot).applyQuaternion(this.turn).negate().add(this.pivot);
  }

  dispose(): void {
    this.object.removeFromParent();
    this.object.traverse((one) => {
      if (one instanceof Sprite) one.material.map?.dispose();
      if (one instanceof Mesh || one instanceof Sprite) {
        one.geometry.dispose();
        (one.material as MeshBasicMaterial | SpriteMaterial).dispose();
      }
    });
  }
}

function label({ words, side }: LabelledLine, place: Vector3): Sprite {
  const scale = 3; // pixels of the texture for each on the screen
  const canvas = document.createElement('canvas');
  const context = canvas.getContext('2d')!;
  const font = (size: number): string => `600 ${size}px ui-sans-serif, system-ui, sans-serif`;
  context.font = font(13 * scale);
  const gap = 9; // between line and label
  const wide = Math.ceil(context.measureText(words).width / scale) + 16;
  const width = side === 'beside' ? wide + gap : wide;
  const height = side === 'beside' ? labelHeight : labelHeight + gap;
  canvas.width = width * scale;
  canvas.height = height * scale;
  context.scale(scale, scale);
  context.fillStyle = ink;
  context.globalAlpha = 0.9;
  context.beginPath();
  context.roundRect(side === 'beside' ? gap : 0, side === 'below' ? gap : 0, wide, labelHeight, labelHeight / 2);
  context.fill();
  context.globalAlpha = 1;
  context.fillStyle = paper;
  context.font = font(13);
  context.textBaseline = 'middle';
  context.fillText(words, (side === 'beside' ? gap : 0) + 8, (side === 'below' ? gap : 0) + labelHeight / 2 + 0.5);
  const map = new CanvasTexture(canvas);
  map.colorSpace = SRGBColorSpace;
  const sprite = new Sprite(
    new SpriteMaterial({ map, depthTest: false, transparent: true, sizeAttenuation: false, toneMapped: false }),
  );
  sprite.center.set(side === 'beside' ? 0 : 0.5, side === 'beside' ? 0.5 : side === 'above' ? 0 : 1);
  sprite.position.copy(place);
  sprite.renderOrder = 30;
  const reach = 2 * Math.tan((fieldOfView * Math.PI) / 360);
  sprite.onBeforeRender = (renderer, _, camera) => {
    const pixel = reach / Math.max(renderer.domElement.clientHeight, 1);
    if (sprite.scale.y === pixel * height) return;
    sprite.scale.set(pixel * width, pixel * height, 1);
    sprite.updateMatrixWorld();
    sprite.modelViewMatrix.multiplyMatrices(camera.matrixWorldInverse, sprite.matrixWorld);
  };
  return sprite;
}
