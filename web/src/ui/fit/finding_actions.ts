import type { Finding } from '../../net/types.ts';
import { t } from '../../words/words.ts';

/** An action of the studio that may resolve a finding. */
export type FindingAction =
  | { kind: 'propose'; label: string }
  | { kind: 'mark'; label: string }
  | { kind: 'axes'; label: string }
  | { kind: 'role'; part: number | null; label: string }
  | { kind: 'exchange'; label: string }
  | { kind: 'point'; point: string; label: string }
  | { kind: 'move'; move: NonNullable<Finding['move']>; label: string };

const aboutAxes = new Set(['upside-down', 'facing-away', 'not-upright']);
const aboutRoles = new Set(['idle-part', 'second-skin', 'eye-cannot-turn', 'point-on-wrong-part']);

/** Points that the server never proposes: 11.5, the top of the hair, depends on the hair's thickness. */
const neverProposed = new Set(['11.5']);

/**
 * The suggested action for a finding, or null when the studio has none: faults of the mesh are repaired in the tool
 * that made it. `enough`: enough points are placed for the server to make proposals.
 */
export function actionFor(finding: Finding, enough: boolean): FindingAction | null {
  const { code, place, move } = finding;
  if (move) return { kind: 'move', move, label: t('Move point {point}', { point: move.point }) };
  if (aboutAxes.has(code)) return { kind: 'axes', label: t('Correct the axes') };
  if (code === 'missing-points' || code === 'no-points') {
    if (enough && (code === 'no-points' || place.points.some((id) => !neverProposed.has(id))))
      return { kind: 'propose', label: t('Propose the missing points') };
    // A note means that nothing depends on the missing points, so no action is suggested.
    return enough || finding.severity === 'note' ? null : { kind: 'mark', label: t('Mark the first points') };
  }
  if (code === 'left-right-swapped') return { kind: 'exchange', label: t('Exchange left and right') };
  if (aboutRoles.has(code))
    return place.part === null
      ? { kind: 'role', part: null, label: t('Set the roles of parts') }
      : { kind: 'role', part: place.part, label: t('Set the role of this part') };
  const point = place.points[0];
  if ((code.startsWith('point') || code.startsWith('unit')) && point !== undefined)
    return { kind: 'point', point, label: t('Show point {point}', { point }) };
  return null;
}
