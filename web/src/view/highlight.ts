import {
  BufferGeometry,
  DoubleSide,
  Float32BufferAttribute,
  Group,
  Mesh,
  MeshBasicMaterial,
  Points,
  PointsMaterial,
  Vector3,
} from 'three';
import type { PreviewView } from './preview_view.ts';

export type HighlightTone = 'error' | 'warning' | 'note' | 'part';

/** What to point out on the still model. */
export interface HighlightTarget {
  tone: HighlightTone;
  /** Vertices of the file. */
  vertices: readonly number[];
  /** Indices of parts. */
  parts: readonly number[];
}

const colors: Record<HighlightTone, number> = { error: 0xe5322d, warning: 0xf0a020, note: 0x2f7df6, part: 0xff5a2c };

/** Vertices as dots and parts as a tint over the still model; what lies inside the head shines through faintly. */
export class Highlight {
  readonly object = new Group();

  show(preview: PreviewView | null, target: HighlightTarget | null): void {
    this.clear();
    if (!preview || !target) return;
    const color = colors[target.tone];
    for (const part of target.parts) {
      for (const geometry of preview.geometriesOf(part)) {
        for (const [order, material] of tints(color).entries()) {
          const mesh = new Mesh(geometry, material);
          mesh.renderOrder = 5 + order;
          this.object.add(mesh);
        }
      }
    }
    const places = target.vertices.flatMap((vertex) => preview.positionOf(vertex)?.toArray() ?? []);
    if (places.length === 0) return;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new Float32BufferAttribute(places, 3));
    for (const depthTest of [false, true]) {
      const material = new PointsMaterial({
        color,
        size: 7,
        sizeAttenuation: false,
        transparent: true,
        opacity: depthTest ? 1 : 0.35,
        depthTest,
        depthWrite: false,
      });
      const points = new Points(geometry, material);
      points.renderOrder = 8;
      points.frustumCulled = false;
      this.object.add(points);
    }
  }

  clear(): void {
    for (const child of this.object.children as (Mesh | Points)[]) {
      // A part borrows the preview's vertices, which must stay on the graphics card.
      if (child instanceof Mesh) child.geometry.deleteAttribute('position');
      child.geometry.dispose();
      (child.material as MeshBasicMaterial | PointsMaterial).dispose();
    }
    this.object.clear();
  }
}

function tints(color: number): MeshBasicMaterial[] {
  const common = { color, transparent: true, depthWrite: false, side: DoubleSide, toneMapped: false };
  return [
    new MeshBasicMaterial({ ...common, opacity: 0.28, depthTest: false }),
    new MeshBasicMaterial({
      ...common,
      opacity: 0.5,
      polygonOffset: true,
      polygonOffsetFactor: -2,
      polygonOffsetUnits: -2,
    }),
  ];
}

/** Where to look to see these places, and how far around. */
export function ballAround(places: readonly Vector3[]): { center: Vector3; radius: number } {
  const center = new Vector3();
  for (const place of places) center.add(place);
  center.divideScalar(Math.max(places.length, 1));
  return { center, radius: places.reduce((most, place) => Math.max(most, place.distanceTo(center)), 0) };
}
