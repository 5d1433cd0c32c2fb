import { pointById } from './feature_points.ts';
import type { PointsById } from './point_draft.ts';

/** The point of the other side; null for a point of the middle. */
export function partnerOf(id: string): string | null {
  const mirror = pointById(id)?.mirror;
  return mirror === undefined || mirror === id ? null : mirror;
}

/** Both points of a pair have this name. */
export const pairOf = (id: string): string => [id, partnerOf(id) ?? id].sort()[0]!;

/** Where the middle of the head is from left to right: the mean of the placed points of the middle, as the server has it. */
export function middleOf(points: PointsById): number {
  let [sum, count] = [0, 0];
  for (const [id, { position }] of points) {
    if (partnerOf(id) !== null) continue;
    sum += position[0];
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}
