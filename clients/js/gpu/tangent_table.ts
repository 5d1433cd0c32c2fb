import { featurePointCount } from '../../../protocol/ts/generated/mpeg4.ts';
import { joinSeams, type DrawableMesh } from './drawable_mesh.ts';

/**
 * The influence table in the form of the shader: for every entry the feature point, its weight (Eq. 7) and the slope of
 * that weight along two tangents of the rest surface.
 *
 * Displacement is linear in the feature points, D(P) = sum w_i(P) D_i, so its derivative along a tangent t is
 * sum (dw_i/dt) D_i: one loop computes the displacement, the deformed tangents and with them the normal. A slope is the
 * least-squares fit over the edges at a vertex; duplicates along seams count as one vertex.
 */
export interface TangentTable {
  /** #V + 1 */
  offsets: Uint32Array;
  /** #entries by 4: feature point, weight, slope along the first tangent, slope along the second */
  entries: Float32Array;
}

/**
 * Two tangents that complete a unit normal to a right-handed frame; the shader computes the same. `out` is t1, t2.
 * (The branch on the sign of z keeps the divisor at 1 or more.)
 */
export function tangentFrame(x: number, y: number, z: number, out: Float64Array): void {
  const sign = z >= 0 ? 1 : -1;
  const a = -1 / (sign + z);
  const b = x * y * a;
  out[0] = 1 + sign * x * x * a;
  out[1] = sign * b;
  out[2] = -sign * x;
  out[3] = b;
  out[4] = sign + y * y * a;
  out[5] = -y;
}

export function makeTangentTable(mesh: DrawableMesh): TangentTable {
  const { positions, normals, rowOffsets, rowPoints, rowWeights, vertexCount } = mesh;
  const group = joinSeams(positions, normals);
  const ring = makeRings(mesh.indices, group, vertexCount);
  const slope = new Float64Array(featurePointCount * 2);
  const weight = new Float64Array(featurePointCount);
  const touched = new Uint8Array(featurePointCount);
  const frame = new Float64Array(6);
  const offsets = new Uint32Array(vertexCount + 1);
  let entries = new Float32Array(Math.max(rowPoints.length * 8, 64));
  let used = 0;

  for (let v = 0; v < vertexCount; v += 1) {
    slope.fill(0);
    weight.fill(0);
    touched.fill(0);
    tangentFrame(normals[v * 3]!, normals[v * 3 + 1]!, normals[v * 3 + 2]!, frame);
    for (let k = rowOffsets[v]!; k < rowOffsets[v + 1]!; k += 1) {
      weight[rowPoints[k]!] = rowWeights[k]!;
      touched[rowPoints[k]!] = 1;
    }
    let uu = 0;
    let uv = 0;
    let vv = 0;
    let su = 0;
    let sv = 0;
    let reach = 0;
    const g = group[v]!;
    for (let r = ring.offsets[g]!; r < ring.offsets[g + 1]!; r += 1) {
      const q = ring.vertices[r]!;
      const ex = positions[q * 3]! - positions[v * 3]!;
      const ey = positions[q * 3 + 1]! - positions[v * 3 + 1]!;
      const ez = positions[q * 3 + 2]! - positions[v * 3 + 2]!;
      const square = ex * ex + ey * ey + ez * ez;
      if (square === 0) continue;
      const share = 1 / square;
      const u = ex * frame[0]! + ey * frame[1]! + ez * frame[2]!;
      const w = ex * frame[3]! + ey * frame[4]! + ez * frame[5]!;
      uu += share * u * u;
      uv += share * u * w;
      vv += share * w * w;
      su += share * u;
      sv += share * w;
      reach = Math.max(reach, Math.sqrt(square));
      for (let k = rowOffsets[q]!; k < rowOffsets[q + 1]!; k += 1) {
        const point = rowPoints[k]!;
        touched[point] = 1;
        slope[point * 2] = slope[point * 2]! + share * u * rowWeights[k]!;
        slope[point * 2 + 1] = slope[point * 2 + 1]! + share * w * rowWeights[k]!;
      }
    }
    // Edges that are all parallel make the least-squares system singular; a small diagonal term keeps it solvable.
    const ridge = 1e-3 * (uu + vv) + 1e-30;
    uu += ridge;
    vv += ridge;
    const determinant = uu * vv - uv * uv;
    for (let point = 0; point < featurePointCount; point += 1) {
      if (touched[point] === 0) continue;
      const bu = slope[point * 2]! - weight[point]! * su;
      const bv = slope[point * 2 + 1]! - weight[point]! * sv;
      const s1 = (bu * vv - bv * uv) / determinant;
      const s2 = (bv * uu - bu * uv) / determinant;
      // A weight below 0.1 % over the whole ring changes the normal by too little to be visible.
      if (weight[point] === 0 && Math.hypot(s1, s2) * reach < 1e-3) continue;
      if ((used + 1) * 4 > entries.length) {
        const larger = new Float32Array(entries.length * 2);
        larger.set(entries);
        entries = larger;
      }
      entries[used * 4] = point;
      entries[used * 4 + 1] = weight[point]!;
      entries[used * 4 + 2] = s1;
      entries[used * 4 + 3] = s2;
      used += 1;
    }
    offsets[v + 1] = used;
  }
  return { offsets, entries: entries.slice(0, used * 4) };
}

/** For each group (identified by its first vertex) its neighbouring groups, without duplicates. */
function makeRings(
  indices: Uint32Array,
  group: Uint32Array,
  count: number,
): { offsets: Uint32Array; vertices: Uint32Array } {
  const degree = new Uint32Array(count + 1);
  for (let i = 0; i + 2 < indices.length; i += 3) {
    for (let k = 0; k < 3; k += 1) degree[group[indices[i + k]!]! + 1]! += 2;
  }
  for (let v = 0; v < count; v += 1) degree[v + 1]! += degree[v]!;
  const all = new Uint32Array(degree[count]!);
  const next = degree.slice(0, count);
  for (let i = 0; i + 2 < indices.length; i += 3) {
    for (let k = 0; k < 3; k += 1) {
      const g = group[indices[i + k]!]!;
      all[next[g]!] = group[indices[i + ((k + 1) % 3)]!]!;
      all[next[g]! + 1] = group[indices[i + ((k + 2) % 3)]!]!;
      next[g]! += 2;
    }
  }
  const offsets = new Uint32Array(count + 1);
  const vertices = new Uint32Array(all.length);
  const mark = new Int32Array(count).fill(-1);
  let used = 0;
  for (let g = 0; g < count; g += 1) {
    for (let k = degree[g]!; k < degree[g + 1]!; k += 1) {
      const q = all[k]!;
      if (q === g || mark[q] === g) continue;
      mark[q] = g;
      vertices[used] = q;
      used += 1;
    }
    offsets[g + 1] = used;
  }
  return { offsets, vertices: vertices.slice(0, used) };
}
