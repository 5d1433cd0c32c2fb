import { lidFields, lidPoints, type Pose } from '../kernel.ts';
import { eyeOf, fullTurn, lidsOf, rigidMotion, tongueShare } from '../../../protocol/ts/index.ts';
import type { DrawableMesh } from './drawable_mesh.ts';
import { tangentFrame, type TangentTable } from './tangent_table.ts';

/**
 * Computes the normals of the deformed face from the tangent table on the CPU, as the shader does on the GPU. Used when
 * the WASM kernel moves the vertices, and as the reference of the shader's test. `out`: #V by 3, unit length.
 */
export function deformNormals(mesh: DrawableMesh, table: TangentTable, pose: Pose, out: Float32Array): void {
  const { normals, rigid, turn, vertexCount } = mesh;
  const { offsets, entries } = table;
  for (let v = 0; v < vertexCount; v += 1) {
    let x = normals[v * 3]!;
    let y = normals[v * 3 + 1]!;
    let z = normals[v * 3 + 2]!;
    const first = offsets[v]!;
    const last = offsets[v + 1]!;
    if (first < last) {
      tangentFrame(x, y, z, frame);
      const lids = rollingLids(rigid[v]!, pose);
      rolls.fill(0);
      for (let i = 0; i < 3; i += 1) place[i] = mesh.positions[v * 3 + i]!;
      for (let k = first; k < last; k += 1) {
        if (lids >= 0 && addRoll(lids, entries, k * 4, pose)) continue;
        const point = entries[k * 4]! * 3;
        const s1 = entries[k * 4 + 2]!;
        const s2 = entries[k * 4 + 3]!;
        const dx = pose.featurePoints[point]!;
        const dy = pose.featurePoints[point + 1]!;
        const dz = pose.featurePoints[point + 2]!;
        const weight = entries[k * 4 + 1]!;
        place[0]! += weight * dx;
        place[1]! += weight * dy;
        place[2]! += weight * dz;
        frame[0]! += s1 * dx;
        frame[1]! += s1 * dy;
        frame[2]! += s1 * dz;
        frame[3]! += s2 * dx;
        frame[4]! += s2 * dy;
        frame[5]! += s2 * dz;
      }
      if (lids >= 0) rollFrame(lids, place, pose);
      const nx = frame[1]! * frame[5]! - frame[2]! * frame[4]!;
      const ny = frame[2]! * frame[3]! - frame[0]! * frame[5]!;
      const nz = frame[0]! * frame[4]! - frame[1]! * frame[3]!;
      const length = Math.hypot(nx, ny, nz);
      if (length > 1e-12) {
        x = nx / length;
        y = ny / length;
        z = nz / length;
      }
    }
    turned[0] = x;
    turned[1] = y;
    turned[2] = z;
    // A pupil stretches the iris within its own surface, so the normals do not change.
    const eye = eyeOf(rigid[v]!);
    if (eye >= 0) rotate(turned, pose.eyeRotations, eye * 4);
    if (rigid[v]! >= rigidMotion.tongue) turnWithTongue(mesh.positions, v, rigid[v]!, pose, turned);
    turnWithHead(turn[v]!, pose.headRotation, turned);
    out[v * 3] = turned[0]!;
    out[v * 3 + 1] = turned[1]!;
    out[v * 3 + 2] = turned[2]!;
  }
}

/** The eye whose lids a vertex belongs to and that roll, or -1. */
function rollingLids(rigid: number, pose: Pose): number {
  const lids = lidsOf(rigid);
  return lids >= 0 && pose.lids[lids * lidFields.count + lidFields.opening]! > 0 ? lids : -1;
}

/** Adds an entry of a point of these lids to `rolls`; false if the point is another one. */
function addRoll(lids: number, entries: Float32Array, at: number, pose: Pose): boolean {
  const isUpper = entries[at] === lidPoints.upper + lids;
  if (!isUpper && entries[at] !== lidPoints.lower + lids) return false;
  const closure = isUpper ? -pose.lidClosures[lids * 2]! : pose.lidClosures[lids * 2 + 1]!;
  for (let i = 0; i < 3; i += 1) rolls[i]! += entries[at + 1 + i]! * closure;
  return true;
}

/**
 * Takes the tangents in `frame`, of a place moved by all other points, along its circle round the eye by `rolls`: see
 * semblante_roll_lid in core/kernel.
 */
function rollFrame(lids: number, place: Float64Array, pose: Pose): void {
  const opening = pose.lids[lids * lidFields.count + lidFields.opening]!;
  const y = place[1]! - pose.eyePivots[lids * 3 + 1]!;
  const z = place[2]! - pose.eyePivots[lids * 3 + 2]!;
  const least = 0.05 * Math.hypot(y, z);
  const raised = y + opening * rolls[0]!;
  const deep = rolls[0] === 0 ? z : Math.sqrt(Math.max(y * y + z * z - raised * raised, least * least));
  for (let t = 0; t < 2; t += 1) {
    const before = frame[t * 3 + 1]!;
    const after = before + opening * rolls[1 + t]!;
    if (z > least) frame[t * 3 + 2] = (y * before + z * frame[t * 3 + 2]! - raised * after) / Math.max(deep, least);
    frame[t * 3 + 1] = after;
  }
}

/** Rotates a normal by the vertex's share of the head's rotation. */
function turnWithHead(turn: number, rotation: Float32Array, normal: Float64Array): void {
  if (turn === fullTurn) {
    rotate(normal, rotation, 0);
    return;
  }
  const share = turn / fullTurn;
  const side = rotation[3]! < 0 ? -share : share;
  roll.set([side * rotation[0]!, side * rotation[1]!, side * rotation[2]!, 1 - share + side * rotation[3]!]);
  const length = Math.hypot(roll[0]!, roll[1]!, roll[2]!, roll[3]!);
  for (let i = 0; i < 4; i += 1) roll[i]! /= length;
  rotate(normal, roll, 0);
}

/** Of a lid: the share of the opening by which it rises, and its slopes along the two tangents. */
const rolls = new Float64Array(3);
const roll = new Float32Array(4);
/** Of a lid: the position by all other points. */
const place = new Float64Array(3);

/** Rotates a normal of the tongue about the tongue's length by the arc's angle: see roll_tongue in core/kernel. */
function turnWithTongue(rest: Float32Array, v: number, rigid: number, pose: Pose, normal: Float64Array): void {
  const { tongue } = pose;
  const roll = tongueShare(rigid) * pose.tongueRoll[0]!;
  const halfWidth = tongue[9]!;
  if (roll === 0 || halfWidth <= 0) return;
  let u = 0;
  let across = 0;
  let upwards = 0;
  for (let i = 0; i < 3; i += 1) {
    u += (rest[v * 3 + i]! - tongue[i]!) * tongue[3 + i]!;
    across += normal[i]! * tongue[3 + i]!;
    upwards += normal[i]! * tongue[6 + i]!;
  }
  const angle = (roll * Math.min(Math.max(u, -halfWidth), halfWidth)) / halfWidth;
  const turnedAcross = across * Math.cos(angle) - upwards * Math.sin(angle);
  const turnedUpwards = across * Math.sin(angle) + upwards * Math.cos(angle);
  for (let i = 0; i < 3; i += 1) {
    normal[i] = normal[i]! + (turnedAcross - across) * tongue[3 + i]! + (turnedUpwards - upwards) * tongue[6 + i]!;
  }
}

const frame = new Float64Array(6);
const turned = new Float64Array(3);

/** Rotates `v` in place by the unit quaternion (q, w) at index `at`: v + 2 q × (q × v + w v). */
function rotate(v: Float64Array, quaternions: Float32Array, at: number): void {
  const qx = quaternions[at]!;
  const qy = quaternions[at + 1]!;
  const qz = quaternions[at + 2]!;
  const qw = quaternions[at + 3]!;
  const tx = qy * v[2]! - qz * v[1]! + qw * v[0]!;
  const ty = qz * v[0]! - qx * v[2]! + qw * v[1]!;
  const tz = qx * v[1]! - qy * v[0]! + qw * v[2]!;
  const x = v[0]! + 2 * (qy * tz - qz * ty);
  const y = v[1]! + 2 * (qz * tx - qx * tz);
  const z = v[2]! + 2 * (qx * ty - qy * tx);
  v[0] = x;
  v[1] = y;
  v[2] = z;
}
