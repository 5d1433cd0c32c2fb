import type { Face } from '../face.ts';

/** Triangles that share a material: indices `start` .. `start + count - 1` of `DrawableMesh.indices`. */
export interface MaterialGroup {
  start: number;
  count: number;
  material: number;
}

/**
 * A parametrized face as the view draws it. Row v of the influence table is entries rowOffsets[v] ..
 * rowOffsets[v + 1] - 1; an entry is the index of a feature point (0..83) and its weight in Eq. 7.
 */
export interface DrawableMesh {
  vertexCount: number;
  /** #V by 3 */
  positions: Float32Array;
  /** #V by 3, unit length */
  normals: Float32Array;
  /** #V by 2, or null */
  uvs: Float32Array | null;
  /** #V by 3, sRGB, or null */
  colors: Uint8Array | null;
  indices: Uint32Array;
  groups: MaterialGroup[];
  rowOffsets: Uint32Array;
  rowPoints: Uint8Array;
  rowWeights: Float32Array;
  /** #V: values of `rigidMotion` */
  rigid: Uint8Array;
  /** #V: 255ths of the head's rotation */
  turn: Uint8Array;
}

/** Area-weighted vertex normals, averaged over the vertices at one position; for meshes without normals. */
export function smoothNormals(positions: Float32Array, indices: Uint32Array, group: Uint32Array): Float32Array {
  const count = positions.length / 3;
  const sums = new Float64Array(count * 3);
  for (let i = 0; i + 2 < indices.length; i += 3) {
    const a = indices[i]! * 3;
    const b = indices[i + 1]! * 3;
    const c = indices[i + 2]! * 3;
    const ux = positions[b]! - positions[a]!;
    const uy = positions[b + 1]! - positions[a + 1]!;
    const uz = positions[b + 2]! - positions[a + 2]!;
    const vx = positions[c]! - positions[a]!;
    const vy = positions[c + 1]! - positions[a + 1]!;
    const vz = positions[c + 2]! - positions[a + 2]!;
    const nx = uy * vz - uz * vy;
    const ny = uz * vx - ux * vz;
    const nz = ux * vy - uy * vx;
    for (const corner of [a, b, c]) {
      const g = group[corner / 3]! * 3;
      sums[g] = sums[g]! + nx;
      sums[g + 1] = sums[g + 1]! + ny;
      sums[g + 2] = sums[g + 2]! + nz;
    }
  }
  const normals = new Float32Array(count * 3);
  for (let v = 0; v < count; v += 1) {
    const g = group[v]! * 3;
    const length = Math.hypot(sums[g]!, sums[g + 1]!, sums[g + 2]!);
    if (length > 0) for (let k = 0; k < 3; k += 1) normals[v * 3 + k] = sums[g + k]! / length;
    else normals[v * 3 + 2] = 1;
  }
  return normals;
}

/**
 * Groups the duplicates of a vertex along UV seams: equal positions and, where normals are given, similar normals (so
 * that touching lips stay separate). Returns for each vertex the first vertex of its group.
 */
export function joinSeams(positions: Float32Array, normals: Float32Array | null): Uint32Array {
  const count = positions.length / 3;
  const group = new Uint32Array(count);
  const bits = new Uint32Array(positions.buffer, positions.byteOffset, positions.length);
  const place = (at: number): number => (positions[at] === 0 ? 0 : bits[at]!); // -0 and 0 are one place
  const seen = new Map<string, number[]>();
  for (let v = 0; v < count; v += 1) {
    const key = `${place(v * 3)},${place(v * 3 + 1)},${place(v * 3 + 2)}`;
    const candidates = seen.get(key);
    group[v] = v;
    if (!candidates) {
      seen.set(key, [v]);
      continue;
    }
    const twin = candidates.find((w) => normals === null || dot(normals, v, w) > 0.3);
    if (twin === undefined) candidates.push(v);
    else group[v] = twin;
  }
  return group;
}

const dot = (values: Float32Array, a: number, b: number): number =>
  values[a * 3]! * values[b * 3]! + values[a * 3 + 1]! * values[b * 3 + 1]! + values[a * 3 + 2]! * values[b * 3 + 2]!;

/** Converts the package's arrays for the view: normals of unit length, triangles sorted by material. */
export function drawableMesh({ mesh, influence, rig }: Face): DrawableMesh {
  const { positions, uvs, colors, triangles } = mesh;
  const normals = mesh.normals ?? smoothNormals(positions, triangles, joinSeams(positions, null));
  normalize(normals);
  const { indices, groups } = sortByMaterial(triangles, mesh.materials, rig.materials.length);
  const { vertexCount, rowOffsets, rowPoints, rowWeights, rigid, turn } = influence;
  return { vertexCount, positions, normals, uvs, colors, indices, groups, rowOffsets, rowPoints, rowWeights, rigid, turn };
}

/** Normalizes in place: quantized normals decode to slightly other lengths, and the shader assumes unit length. */
function normalize(normals: Float32Array): void {
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i]!, normals[i + 1]!, normals[i + 2]!);
    if (length > 1e-6) for (let k = 0; k < 3; k += 1) normals[i + k]! /= length;
    else normals.set([0, 0, 1], i);
  }
}

/** Sorts the triangles by material, so that each material needs one draw call. */
export function sortByMaterial(
  indices: Uint32Array,
  materials: Uint8Array | null,
  materialCount: number,
): { indices: Uint32Array; groups: MaterialGroup[] } {
  if (!materials) return { indices, groups: [{ start: 0, count: indices.length, material: 0 }] };
  const counts = new Uint32Array(materialCount);
  for (let i = 0; i < indices.length; i += 3) counts[materials[indices[i]!]!]! += 3;
  const next = new Uint32Array(materialCount);
  const groups: MaterialGroup[] = [];
  let start = 0;
  counts.forEach((count, material) => {
    next[material] = start;
    if (count > 0) groups.push({ start, count, material });
    start += count;
  });
  const sorted = new Uint32Array(indices.length);
  for (let i = 0; i < indices.length; i += 3) {
    const material = materials[indices[i]!]!;
    sorted.set(indices.subarray(i, i + 3), next[material]!);
    next[material]! += 3;
  }
  return { indices: sorted, groups };
}
