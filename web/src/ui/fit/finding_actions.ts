import type { Finding } from '../../net/types.ts';

/** What a person can do about a finding right here. */
export type FindingAction =
  | { kind: 'propose'; label: string }
  | { kind: 'mark'; label: string }
  | { kind: 'axes'; label: string }
  | { kind: 'role'; part: number | null; label: string }
  | { kind: 'exchange'; label: string }
  | { kind: 'point'; point: string; label: string };

const aboutAxes = new Set(['upside-down', 'facing-away', 'not-upright']);
const aboutRoles = new Set(['idle-part', 'second-skin', 'eye-cannot-turn', 'point-on-wrong-part']);

/** How thick the hair is shows on no bare head. */
const neverProposed = new Set(['11.5']);

/**
 * The obvious action, or null where it is not one of this page: a mesh is mended in the tool that made it. `enough`:
 * there are as many placed points as proposals are made from.
 */
export function actionFor(finding: Finding, enough: boolean): FindingAction | null {
  const { code, place } = finding;
  if (aboutAxes.has(code)) return { kind: 'axes', label: 'Correct the axes' };
  if (code === 'missing-points' || code === 'no-points') {
    if (enough && (code === 'no-points' || place.points.some((id) => !neverProposed.has(id))))
      return { kind: 'propose', label: 'Propose the missing points' };
    // What nothing needs may well be left unmarked.
    return enough || finding.severity === 'note' ? null : { kind: 'mark', label: 'Mark the first points' };
  }
  if (code === 'left-right-swapped') return { kind: 'exchange', label: 'Exchange left and right' };
  if (aboutRoles.has(code))
    return place.part === null
      ? { kind: 'role', part: null, label: 'Set the roles of parts' }
      : { kind: 'role', part: place.part, label: 'Set the role of this part' };
  const point = place.points[0];
  if ((code.startsWith('point') || code.startsWith('unit')) && point !== undefined)
    return { kind: 'point', point, label: `Look at point ${point}` };
  return null;
}
