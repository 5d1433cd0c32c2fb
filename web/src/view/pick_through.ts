import type { PartRole } from '@protocol/rig_document.ts';

/** A surface that a ray from the eye meets. */
export interface Meeting {
  distance: number;
  /** Null where the model does not tell. */
  role: PartRole | null;
  /** Whether the outside of the surface is met. */
  outside: boolean;
}

/** The parts that a feature point lies on, by its id; the others lie on the skin. */
export function rolesOfPoint(id: string): readonly PartRole[] {
  if (/^6\./.test(id)) return ['tongue'];
  if (/^9\.(8|10)$/.test(id)) return ['upper_teeth'];
  if (/^9\.(9|11)$/.test(id)) return ['lower_teeth'];
  if (id === '3.5') return ['left_eye', 'skin'];
  if (id === '3.6') return ['right_eye', 'skin'];
  return ['skin'];
}

/**
 * The index of the surface that a click means, among those that its ray meets, the nearest first. It is the first one of these
 * `roles` whose outside is met, so that lashes, shells of the eyes, glasses and hair are clicked through. A surface farther than
 * `depth` behind the first one is not meant, since it may be the other side of the head. If no surface qualifies, the first one
 * is meant. The result is -1 if the ray meets nothing.
 */
export function pickThrough(meetings: readonly Meeting[], roles: readonly PartRole[], depth: number): number {
  const first = meetings[0];
  if (!first) return -1;
  for (const role of roles) {
    const at = meetings.findIndex((one) => one.role === role && one.outside && one.distance <= first.distance + depth);
    if (at >= 0) return at;
  }
  return 0;
}
