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

/** A length on the face with its name and value. A line without a name has no label. */
export interface LabelledLine {
  from: readonly [number, number, number];
  to: readonly [number, number, number];
  name: string;
  value: string;
  /** Where the label is, as seen from in front. */
  side: 'above' | 'below' | 'beside';
}

/** Sizes of the letters of a label, CSS pixels: a name alone stands on a small face and hides less of it. */
const letters = { brief: 11, full: 13 };
/** Thickness of the lines, as a share of the longest. */
const thicknessShare = 0.014;
/** Pixels of the longest line from which the labels tell the values too: on a smaller face they would cover it. */
const leastForValues = 80;
const ink = '#1d1a18';
const paper = '#fff7e8';

/**
 * Lines with labels on the neutral face, which turn with the head and are seen through it. Labels keep their size on the
 * screen; on a face that is small there they have the names alone.
 */
export class UnitLines {
  readonly object = new Group();
  private readonly turn = new Quaternion();
  private readonly pivot = new Vector3();

  constructor(lines: readonly LabelledLine[]) {
    const longest = Math.max(...lines.map(({ from, to }) => Math.hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2])), 0);
    const thickness = longest * thicknessShare;
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
      if (line.name !== '') this.object.add(new Label(line, from.clone().lerp(to, 0.5), longest));
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
      if (one instanceof Label) one.dispose();
      else if (one instanceof Mesh) {
        one.geometry.dispose();
        (one.material as MeshBasicMaterial).dispose();
      }
    });
  }
}

class Label extends Sprite {
  private readonly brief: Picture;
  private readonly full: Picture;

  /** `longest` of all lines, model units. */
  constructor({ name, value, side }: LabelledLine, place: Vector3, longest: number) {
    const [brief, full] = [draw(name, side, letters.brief), draw(`${name} ${value}`, side, letters.full)];
    super(new SpriteMaterial({ map: full.map, depthTest: false, transparent: true, sizeAttenuation: false, toneMapped: false }));
    this.brief = brief;
    this.full = full;
    this.center.set(side === 'beside' ? 0 : 0.5, side === 'beside' ? 0.5 : side === 'above' ? 0 : 1);
    this.position.copy(place);
    this.renderOrder = 30;
    const reach = 2 * Math.tan((fieldOfView * Math.PI) / 360);
    this.onBeforeRender = (renderer, _, camera) => {
      const pixel = reach / Math.max(renderer.domElement.clientHeight, 1);
      const eye = camera.matrixWorldInverse.elements;
      const at = this.matrixWorld.elements;
      const depth = -(eye[2]! * at[12]! + eye[6]! * at[13]! + eye[10]! * at[14]! + eye[14]!);
      const { map, width, height } = longest >= leastForValues * pixel * depth ? this.full : this.brief;
      if (this.scale.y === pixel * height && this.material.map === map) return;
      this.material.map = map;
      this.scale.set(pixel * width, pixel * height, 1);
      this.updateMatrixWorld();
      this.modelViewMatrix.multiplyMatrices(camera.matrixWorldInverse, this.matrixWorld);
    };
  }

  override dispose(): void {
    for (const { map } of [this.brief, this.full]) map.dispose();
    this.geometry.dispose();
    this.material.dispose();
  }
}

/** The picture of a label. */
interface Picture {
  map: CanvasTexture;
  /** CSS pixels. */
  width: number;
  height: number;
}

function draw(words: string, side: LabelledLine['side'], size: number): Picture {
  const scale = 3; // pixels of the texture for each on the screen
  const canvas = document.createElement('canvas');
  const context = canvas.getContext('2d')!;
  const font = (pixels: number): string => `600 ${pixels}px ui-sans-serif, system-ui, sans-serif`;
  context.font = font(size * scale);
  const gap = 9; // between line and label
  const high = Math.round(1.7 * size);
  const inset = Math.round(0.6 * size);
  const wide = Math.ceil(context.measureText(words).width / scale) + 2 * inset;
  const width = side === 'beside' ? wide + gap : wide;
  const height = side === 'beside' ? high : high + gap;
  canvas.width = width * scale;
  canvas.height = height * scale;
  context.scale(scale, scale);
  context.fillStyle = ink;
  context.globalAlpha = 0.9;
  context.beginPath();
  context.roundRect(side === 'beside' ? gap : 0, side === 'below' ? gap : 0, wide, high, high / 2);
  context.fill();
  context.globalAlpha = 1;
  context.fillStyle = paper;
  context.font = font(size);
  context.textBaseline = 'middle';
  context.fillText(words, (side === 'beside' ? gap : 0) + inset, (side === 'below' ? gap : 0) + high / 2 + 0.5);
  const map = new CanvasTexture(canvas);
  map.colorSpace = SRGBColorSpace;
  return { map, width, height };
}
