import type { PlacedPoint } from '../../face/point_draft.ts';
import type { HiddenParts } from '../points/hidden_parts.ts';
import type { PointsModel } from '../points/points_model.ts';
import type { SceneView } from '../stage/scene.ts';
import { rolesOfPoint } from '../../view/pick_through.ts';
import type { PartRole } from '../../net/types.ts';
import type { Marker } from '../../view/markers.ts';

/** How deep a click on a point goes through lashes, glasses and hair, in radii of the head. */
const throughDepth = 0.3;
/** A marker is seen where the surface under it is this near to it, in radii of the head. */
const atMarker = 0.12;

/** From this share of a triangle's corner on, a click means the vertex. */
const atVertex = 0.85;
/** How far from its exact image the vertex of the other side may be, in radii of the head. */
const mirrorReach = 0.12;

/** A pupil moves with the eyeball, not with a vertex, and may lie inside a triangle. */
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
    const exact = isPupil(id) && pick.share < atVertex;
    return {
      point: exact ? { vertex: null, position: pick.hit } : { vertex: pick.fileVertex, position: pick.position },
      part: pick.part,
    };
  }

  /** The place for point `id` at the mirror image of a vertex; null: the head has none there. */
  imageOf(id: string, vertex: number, middle: number): PlacedPoint | null {
    const { preview, stage } = this.scene;
    const roles = rolesOfPoint(id);
    const image = preview?.mirrored(vertex, middle, stage.headRadius * mirrorReach, (part) => {
      const role = this.roleOf(part);
      return role === null || roles.includes(role);
    });
    return image ? { vertex: image.fileVertex, position: image.position } : null;
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
