import { featurePoints } from '@protocol/generated/mpeg4.ts';
import type { PointsById } from '../../face/point_draft.ts';
import { quickSet } from '../../face/quick_set.ts';

const quickIds: readonly string[] = quickSet.map(({ id }) => id);
const allIds: readonly string[] = featurePoints.map(({ id }) => id);

/** The first point after `chosen`, in an order that begins again at its end, which is wanted; null: none is. */
function after(chosen: string | null, order: readonly string[], wanted: (id: string) => boolean): string | null {
  const start = order.indexOf(chosen ?? '');
  return [...order.slice(start + 1), ...order.slice(0, start + 1)].find(wanted) ?? null;
}

export const isQuick = (id: string): boolean => quickIds.includes(id);

/** The number of points of the quick set that are not placed. */
export const quickLeft = (points: PointsById): number => quickIds.filter((id) => !points.has(id)).length;

export const nextProposed = (points: PointsById, chosen: string | null): string | null =>
  after(chosen, allIds, (id) => points.get(id)?.proposal !== undefined);

/** The next point to place, of the quick set when `guided`, or, when all are placed, the next proposed one. */
export function nextPoint(points: PointsById, chosen: string | null, guided: boolean): string | null {
  const order = guided ? quickIds : allIds;
  return after(chosen, order, (id) => !points.has(id)) ?? nextProposed(points, chosen);
}
