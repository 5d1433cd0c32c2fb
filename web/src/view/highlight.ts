import { DoubleSide, Group, Mesh, MeshBasicMaterial, Vector3, type BufferGeometry, type Material } from 'three';
import { Markers, type Marker, type MarkerTone } from './markers.ts';
import type { PreviewView } from './preview_view.ts';

export type HighlightTone = 'error' | 'warning' | 'note' | 'part';

/** What to highlight on the still model. */
export interface HighlightTarget {
  tone: HighlightTone;
  /** Vertex numbers of the file. */
  vertices: readonly number[];
  /** Part indices. */
  parts: readonly number[];
}

const colors: Record<HighlightTone, number> = { error: 0xe5322d, warning: 0xf0a020, note: 0x2f7df6, part: 0xff5a2c };

const dotTones: Record<HighlightTone, MarkerTone> = { error: 'error', warning: 'warning', note: 'note', part: 'note' };

/** Highlights vertices as dots and parts as a tint over the still model; hidden places are drawn faintly. */
export class Highlight {
  readonly object = new Group();
  readonly parts = new Group();
  readonly dots = new Markers();

  constructor() {
    this.object.add(this.parts, this.dots.object);
    this.clear();
  }

  show(preview: PreviewView | null, target: HighlightTarget | null): void {
    this.clear();
    if (!preview || !target) return;
    const color = colors[target.tone];
    for (const part of target.parts) {
      for (const geometry of preview.geometriesOf(part)) {
        for (const [order, material] of tints(color).entries()) {
          const mesh = new Mesh(geometry, material);
          mesh.renderOrder = 5 + order;
          this.parts.add(mesh);
        }
      }
    }
    const dots = target.vertices.flatMap((vertex): Marker[] => {
      const place = preview.positionOf(vertex);
      return place ? [{ id: '', position: place.toArray(), tone: dotTones[target.tone] }] : [];
    });
    this.dots.set(dots);
    this.dots.object.visible = dots.length > 0;
  }

  clear(): void {
    this.dots.object.visible = false;
    for (const child of [...this.parts.children] as Mesh<BufferGeometry, Material>[]) {
      // The geometry of a part shares the preview's vertex buffer, which must not be disposed with it.
      child.geometry.deleteAttribute('position');
      child.geometry.dispose();
      child.material.dispose();
    }
    this.parts.clear();
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

/** A ball that contains all the places: the target and radius for the camera. */
export function ballAround(places: readonly Vector3[]): { center: Vector3; radius: number } {
  const center = new Vector3();
  for (const place of places) center.add(place);
  center.divideScalar(Math.max(places.length, 1));
  return { center, radius: places.reduce((most, place) => Math.max(most, place.distanceTo(center)), 0) };
}
