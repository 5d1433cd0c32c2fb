import type { PlacedPoint } from '../../face/point_draft.ts';
import type { HiddenParts } from '../points/hidden_parts.ts';
import type { PointsModel } from '../points/points_model.ts';
import type { SceneView } from '../stage/scene.ts';
import { rolesOfPoint } from '../../view/pick_through.ts';
import type { Pick, SurfacePlace } from '../../view/preview_view.ts';
import type { PartRole } from '../../net/types.ts';
import type { Marker } from '../../view/markers.ts';

/** How deep a click on a point goes through lashes, glasses and hair, in radii of the head. */
const throughDepth = 0.3;
/** A marker is seen where the surface under it is this near to it, in radii of the head. */
const atMarker = 0.12;

/** A click this near to a vertex means the vertex, CSS pixels: on a dense head there is one under every pointer. */
const atVertex = 5;
/** How far around a click beside the head its skin is looked for, CSS pixels, nearest first. */
const besideHead = [0, 3, 6, 9, 12];
const directions = 12;
/** How far from its exact image the place of the other side may be, in radii of the head. */
const mirrorReach = 0.12;

/** A pupil moves with the eyeball, not with a vertex: it lies exactly where it is put. */
const isPupil = (id: string): boolean => id === '3.5' || id === '3.6';

export interface PickedPoint {
  point: PlacedPoint;
  /** The part that it lies on; null where the model does not tell. */
  part: number | null;
}

/** Finds the place on the head that a pointer means for a feature point. */
export class PointPicker {
  constructor(
    private readonly scene: SceneView,
    private readonly points: PointsModel,
    private readonly hidden: HiddenParts,
  ) {}

  /** The place of point `id` at `x`, `y` (normalized device coordinates, -1..1 from the lower left). */
  pick(id: string, x: number, y: number): PickedPoint | null {
    const { preview, stage } = this.scene;
    const pick = preview?.pick(x, y, stage.camera, {
      roles: rolesOfPoint(id),
      roleOf: (part) => this.roleOf(part),
      depth: stage.headRadius * throughDepth,
    });
    if (!pick) return null;
    return { point: this.placeOf(id, pick, x, y), part: pick.part };
  }

  /** The same for a click, which may fall just beside the head: the chin and the top of the skull lie on its outline. */
  pickNear(id: string, x: number, y: number): PickedPoint | null {
    const { clientWidth: width, clientHeight: height } = this.scene.stage.canvas;
    for (const away of besideHead) {
      for (let turn = 0; turn < (away === 0 ? 1 : directions); turn += 1) {
        const angle = (turn / directions) * 2 * Math.PI;
        const picked = this.pick(id, x + (2 * away * Math.cos(angle)) / width, y + (2 * away * Math.sin(angle)) / height);
        if (picked) return picked;
      }
    }
    return null;
  }

  private placeOf(id: string, { place, fileVertex, position, hit }: Pick, x: number, y: number): PlacedPoint {
    if (place.vertex !== null) return place;
    if (isPupil(id)) return { vertex: null, position: hit };
    const { markers, stage } = this.scene;
    const { clientWidth: width, clientHeight: height } = stage.canvas;
    const vertex = markers.project(position, stage.camera, width, height);
    const away = Math.hypot(vertex.x - ((x + 1) / 2) * width, vertex.y - ((1 - y) / 2) * height);
    return away <= atVertex ? { vertex: fileVertex, position } : place;
  }

  /** The place for point `id` at the mirror image of another; null: the head has none there. */
  imageOf(id: string, { vertex, position }: PlacedPoint, middle: number): PlacedPoint | null {
    const { preview, stage } = this.scene;
    const roles = rolesOfPoint(id);
    const place: SurfacePlace = { vertex, position: [...position] };
    return (
      preview?.mirrored(place, middle, stage.headRadius * mirrorReach, (part) => {
        const role = this.roleOf(part);
        return role === null || roles.includes(role);
      }) ?? null
    );
  }

  private roleOf(part: number): PartRole | null {
    return this.hidden.parts.find(({ index }) => index === part)?.role ?? null;
  }

  /** The parts that are seen where point `id` lies, without what a click goes through: lashes and hair; for teeth and tongue the skin. */
  partsAround(id: string): Set<number> {
    const roles = rolesOfPoint(id);
    const seen = (role: PartRole): boolean => (roles.includes('skin') ? role !== 'attached' && role !== 'rest' : roles.includes(role));
    const { parts, hidden } = this.hidden;
    return new Set(parts.filter(({ role, index }) => seen(role) && !hidden.value.has(index)).map(({ index }) => index));
  }

  /** The marker under a pointer (CSS pixels of the picture) that can be dragged: the chosen one before others; not one behind the head. */
  grip(x: number, y: number, width: number, height: number, reach: number, onlyChosen: boolean): Marker | null {
    const { markers, stage } = this.scene;
    const chosen = this.points.chosen.value;
    const own = chosen === null ? null : markers.of(chosen);
    const at = own && markers.project(own.position, stage.camera, width, height);
    const marker =
      own && at && Math.hypot(at.x - x, at.y - y) <= reach ? own : onlyChosen ? null : markers.at(x, y, stage.camera, width, height, reach);
    if (!marker) return null;
    const place = markers.project(marker.position, stage.camera, width, height);
    const seen = this.pick(marker.id, (place.x / width) * 2 - 1, 1 - (place.y / height) * 2)?.point.position;
    if (!seen) return null;
    const off = Math.hypot(...seen.map((value, axis) => value - marker.position[axis]!));
    return off <= stage.headRadius * atMarker ? marker : null;
  }
}
