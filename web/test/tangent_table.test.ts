import { describe, expect, test } from 'vitest';
import { deformNormals } from '@client/gpu/deform_reference.ts';
import { joinSeams, smoothNormals, type DrawableMesh } from '@client/gpu/drawable_mesh.ts';
import { neutralPose } from './support/pose.ts';
import { makeTangentTable, tangentFrame } from '@client/gpu/tangent_table.ts';

/** A flat grid of n by n unit squares in the plane z = 0, moved by FP 0 with weight x / n. */
function ramp(n: number): DrawableMesh {
  const side = n + 1;
  const positions = new Float32Array(side * side * 3);
  const normals = new Float32Array(side * side * 3);
  for (let y = 0; y < side; y += 1)
    for (let x = 0; x < side; x += 1) {
      positions.set([x, y, 0], (y * side + x) * 3);
      normals.set([0, 0, 1], (y * side + x) * 3);
    }
  const indices: number[] = [];
  for (let y = 0; y < n; y += 1)
    for (let x = 0; x < n; x += 1) {
      const a = y * side + x;
      indices.push(a, a + 1, a + side + 1, a, a + side + 1, a + side);
    }
  const count = side * side;
  return {
    vertexCount: count,
    positions,
    normals,
    uvs: null,
    colors: null,
    indices: new Uint32Array(indices),
    groups: [],
    rowOffsets: Uint32Array.from({ length: count + 1 }, (_, v) => v),
    rowPoints: new Uint8Array(count),
    rowWeights: Float32Array.from({ length: count }, (_, v) => (v % side) / n),
    rigid: new Uint8Array(count),
    turn: new Uint8Array(count).fill(255),
  };
}

describe('tangent table', () => {
  test('TangentFrame_AnyNormal_IsOrthonormalAndRightHanded', () => {
    const t = new Float64Array(6);
    for (const [x, y, z] of [
      [0, 0, 1],
      [0, 0, -1],
      [1, 0, 0],
      [0.6, -0.8, 0],
      [0.36, 0.48, -0.8],
    ] as const) {
      tangentFrame(x, y, z, t);
      const [ax, ay, az, bx, by, bz] = t as unknown as [number, number, number, number, number, number];
      expect(ax * bx + ay * by + az * bz).toBeCloseTo(0, 12);
      expect(Math.hypot(ax, ay, az)).toBeCloseTo(1, 12);
      const cross = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
      [x, y, z].forEach((value, i) => expect(cross[i]).toBeCloseTo(value, 12));
    }
  });

  test('DeformNormals_NeutralPose_GivesTheRestNormals', () => {
    const mesh = ramp(4);
    const out = new Float32Array(mesh.normals.length);
    deformNormals(mesh, makeTangentTable(mesh), neutralPose(), out);
    out.forEach((value, i) => expect(value).toBeCloseTo(mesh.normals[i]!, 6));
  });

  test('DeformNormals_LinearRamp_TiltsByTheSlope', () => {
    // FP 0 goes 4 up, weight x / 4: the plane becomes z = x, its normal (-1, 0, 1) / sqrt 2 = (-0.7071, 0, 0.7071).
    const mesh = ramp(4);
    const pose = neutralPose();
    pose.featurePoints[2] = 4;
    const out = new Float32Array(mesh.normals.length);
    deformNormals(mesh, makeTangentTable(mesh), pose, out);
    for (let v = 0; v < mesh.vertexCount; v += 1) {
      expect(out[v * 3]).toBeCloseTo(-Math.SQRT1_2, 2);
      expect(out[v * 3 + 1]).toBeCloseTo(0, 2);
      expect(out[v * 3 + 2]).toBeCloseTo(Math.SQRT1_2, 2);
    }
  });

  test('DeformNormals_HeadTurned_TurnWithIt', () => {
    const mesh = ramp(1);
    const pose = neutralPose();
    pose.headRotation.set([0, Math.SQRT1_2, 0, Math.SQRT1_2]); // 90 degrees about +Y: +Z goes to +X
    const out = new Float32Array(mesh.normals.length);
    deformNormals(mesh, makeTangentTable(mesh), pose, out);
    expect([...out.subarray(0, 3)].map((value) => Math.round(value * 1e6) / 1e6 + 0)).toEqual([1, 0, 0]);
  });

  test('JoinSeams_SamePlaceFacingApart_StayTwo', () => {
    const positions = new Float32Array([0, 0, 0, 0, 0, 0, 0, 0, 0]);
    const normals = new Float32Array([0, 0, 1, 0, 0, -1, 0, 0.1, 0.99]);
    expect([...joinSeams(positions, normals)]).toEqual([0, 1, 0]);
  });

  test('JoinSeams_MinusZero_IsThePlaceOfZero', () => {
    expect([...joinSeams(new Float32Array([0, 1, 2, -0, 1, 2]), null)]).toEqual([0, 0]);
  });

  test('SmoothNormals_DegenerateTriangle_IsNoNaN', () => {
    const normals = smoothNormals(new Float32Array(9), new Uint32Array([0, 1, 2]), new Uint32Array([0, 1, 2]));
    expect([...normals].every(Number.isFinite)).toBe(true);
  });
});
