import { featurePoints } from '@protocol/generated/mpeg4.ts';
import { proposalBody, type PlacedPoint, type PointsById } from '../../face/point_draft.ts';
import type { FeaturePointSet } from '../../net/types.ts';

/** The position of a vertex of the file, model units; null: it is not known. */
export type PositionOf = (vertex: number) => readonly [number, number, number] | null;

/** The server's points as those of a draft; a point without a position has that of its vertex. */
export function placedPoints(set: FeaturePointSet, positionOf: PositionOf): [string, PlacedPoint][] {
  const placed: [string, PlacedPoint][] = [];
  for (const [id, value] of Object.entries(set.points)) {
    const { vertex } = value;
    const position = value.position ?? (vertex === null ? null : positionOf(vertex));
    if (!position) continue;
    const { method = null, confidence = null, expected_error: expectedError = null, remark } = value;
    const proposal = { method, confidence, expectedError, ...(remark === undefined ? {} : { remark }) };
    placed.push([id, { vertex, position, ...(value.proposed ? { proposal } : {}) }]);
  }
  return placed;
}

/** The content of a file with the points of a head, in the order of the standard. */
export function pointsFile(head: string, points: PointsById): Blob {
  const listed: Record<string, object> = {};
  for (const { id } of featurePoints) {
    const point = points.get(id);
    if (!point) continue;
    const { vertex, position, proposal } = point;
    listed[id] = { vertex, position, ...(proposal ? proposalBody(proposal) : {}) };
  }
  return new Blob([JSON.stringify({ head, count: points.size, points: listed }, null, 1)], { type: 'application/json' });
}
