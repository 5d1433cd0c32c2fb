import { Vector3, type BufferAttribute, type InterleavedBufferAttribute } from 'three';

type Attribute = BufferAttribute | InterleavedBufferAttribute;

/**
 * Where the skin about a place of the surface looks: the sum of the normals within `radius` of it, of the vertices that are on the same side as
 * the nearest one. A single vertex of a lip's edge or of an ear's rim looks anywhere.
 */
export function outwardAt(pieces: readonly { positions: Attribute; normals: Attribute }[], place: Vector3, radius: number): Vector3 {
  const at = new Vector3();
  const nearest = new Vector3();
  const around: Vector3[] = [];
  let least = Infinity;
  for (const { positions, normals } of pieces) {
    for (let v = 0; v < positions.count; v += 1) {
      const distance = at.fromBufferAttribute(positions, v).distanceTo(place);
      if (distance > radius && distance >= least) continue;
      const normal = new Vector3().fromBufferAttribute(normals, v);
      if (distance <= radius) around.push(normal);
      if (distance >= least) continue;
      least = distance;
      nearest.copy(normal);
    }
  }
  return around.reduce((sum, normal) => (normal.dot(nearest) > 0 ? sum.add(normal) : sum), nearest.clone());
}
