import { Triangle, Vector3 } from 'three';

/** Shares of the shorter edge at a corner, and of the opposite corner: core/geometry/insert_vertices.h has the same rule. */
const atVertex = 0.1;
const atEdge = 0.05;

const corners = [new Vector3(), new Vector3(), new Vector3()] as const;

/** The corner (0, 1, 2) that a place on a triangle means: one within a tenth of the shorter of its edges; -1: none. */
export function meantCorner(place: Vector3, { a, b, c }: Triangle): number {
  const [p, q, r] = [corners[0].copy(a), corners[1].copy(b), corners[2].copy(c)];
  const [pq, qr, rp] = [p.distanceTo(q), q.distanceTo(r), r.distanceTo(p)];
  const shorter = [Math.min(pq, rp), Math.min(pq, qr), Math.min(qr, rp)];
  return corners.findIndex((corner, k) => corner.distanceTo(place) <= atVertex * shorter[k]!);
}

const shares = new Vector3();

/** Moves a place on a triangle to an edge, if it is within a twentieth of the way to the opposite corner. */
export function moveToEdge(place: Vector3, triangle: Triangle): Vector3 {
  if (!triangle.getBarycoord(place, shares)) return place;
  const least = Math.min(shares.x, shares.y, shares.z);
  if (least > atEdge) return place;
  if (shares.x === least) shares.x = 0;
  else if (shares.y === least) shares.y = 0;
  else shares.z = 0;
  shares.divideScalar(shares.x + shares.y + shares.z);
  return place
    .copy(triangle.a)
    .multiplyScalar(shares.x)
    .addScaledVector(triangle.b, shares.y)
    .addScaledVector(triangle.c, shares.z);
}
