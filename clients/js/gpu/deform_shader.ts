import { featurePointCount } from '../../../protocol/ts/generated/mpeg4.ts';
import { fullTurn, rigidMotion } from '../../../protocol/ts/weights_format.ts';
import { ballPlaces, lidPoints } from '../kernel.ts';
import type { DrawableMesh } from './drawable_mesh.ts';
import type { TangentTable } from './tangent_table.ts';

/** Width of the entry texture, texels: entry k is at (k mod width, k div width). */
export const tableWidth = 1024;

/** The texels of the entry texture, RGBA; `tableWidth` wide. */
export function entryTexels(table: TangentTable): Float32Array {
  const rows = Math.max(1, Math.ceil(table.entries.length / 4 / tableWidth));
  const texels = new Float32Array(rows * tableWidth * 4);
  texels.set(table.entries);
  return texels;
}

/** #V by 2: the attribute `faceRow`. */
export function rowNumbers(mesh: DrawableMesh, table: TangentTable): Uint32Array {
  const rows = new Uint32Array(mesh.vertexCount * 2);
  for (let v = 0; v < mesh.vertexCount; v += 1) {
    rows[v * 2] = table.offsets[v]!;
    rows[v * 2 + 1] = (table.offsets[v + 1]! - table.offsets[v]!) | (mesh.rigid[v]! << 16) | (mesh.turn[v]! << 24);
  }
  return rows;
}

/**
 * Eq. 7 and the rigid motion of parts in GLSL: the same as semblante_deform in core/kernel. `faceRow` is
 * (first entry, count + rigid << 16 + turn << 24). The normal is computed from the slopes of the weights: see tangent_table.ts.
 */
export const deformDeclarations = /* glsl */ `
attribute uvec2 faceRow;
uniform highp sampler2D faceEntries;
uniform vec3 facePoints[${featurePointCount}];
uniform vec4 faceEyeRotation[2];
uniform vec3 faceEyePivot[2];
uniform vec3 faceEyeTranslation[2];
uniform vec4 faceHeadRotation;
uniform vec3 faceHeadPivot;
uniform float facePupilGrowth[2];
uniform vec3 faceIrisAxis[2];
uniform vec3 faceIrisShape[2];
uniform float faceTongueRoll;
uniform vec3 faceTongueOrigin;
uniform vec3 faceTongueLeft;
uniform vec3 faceTongueUp;
uniform float faceTongueHalfWidth;
uniform vec3 faceLidGaze[2];
uniform float faceLidClosure[4];
uniform float faceLidOpening[2];
uniform float faceLidBall[${2 * ballPlaces}];
uniform float faceLidLift[2];

vec3 faceRotate(vec4 q, vec3 v) {
  return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v);
}

/** The displacement of a vertex of the iris by the pupil's growth. */
vec3 faceIris(int eye, vec3 rest) {
  vec3 shape = faceIrisShape[eye];
  float growth = facePupilGrowth[eye];
  vec3 axis = faceIrisAxis[eye];
  vec3 d = rest - faceEyePivot[eye];
  vec3 outwards = d - dot(d, axis) * axis;
  float r = length(outwards);
  float stretch = 0.0;
  if (r < shape.x) stretch = growth / shape.x;
  else if (r < shape.y) stretch = growth * (shape.y - r) / ((shape.y - shape.x) * r);
  return stretch * outwards + shape.z * r * r * stretch * (2.0 + stretch) * axis;
}

/** Sine, as GLSL's own guarantees eleven bits only. Error 1e-7 for |x| < pi / 2; a tongue rolls less than twice that. */
float faceSine(float x) {
  float y = x * x;
  return x * (1.0 + y * (-1.0 / 6.0 + y * (1.0 / 120.0 + y * (-1.0 / 5040.0 + y * (1.0 / 362880.0 - y / 39916800.0)))));
}
float faceCosine(float x) {
  float y = x * x;
  return 1.0 + y * (-0.5 + y * (1.0 / 24.0 + y * (-1.0 / 720.0 + y * (1.0 / 40320.0 - y / 3628800.0))));
}

/** Rolls the tongue: moves a vertex and rotates its normal. */
void faceRollTongue(float roll, vec3 rest, inout vec3 p, inout vec3 n) {
  if (roll == 0.0 || faceTongueHalfWidth <= 0.0) return;
  vec3 d = rest - faceTongueOrigin;
  float u = dot(d, faceTongueLeft);
  float v = dot(d, faceTongueUp);
  float curvature = roll / faceTongueHalfWidth;
  float onArc = clamp(u, -faceTongueHalfWidth, faceTongueHalfWidth);
  float beyond = u - onArc;
  float angle = curvature * onArc;
  float halfSine = faceSine(0.5 * angle);
  float s = 2.0 * halfSine * faceCosine(0.5 * angle);
  float versine = 2.0 * halfSine * halfSine;
  float across = (s / curvature - onArc) - beyond * versine - v * s;
  float upwards = versine / curvature + beyond * s - v * versine;
  p += across * faceTongueLeft + upwards * faceTongueUp;
  float nu = dot(n, faceTongueLeft);
  float nv = dot(n, faceTongueUp);
  n += (-versine * nu - s * nv) * faceTongueLeft + (s * nu - versine * nv) * faceTongueUp;
}

/** The radius of the eyeball in the direction d about its pole. */
float faceBallRadius(int eye, vec3 pole, vec3 d) {
  float at = sqrt(1.0 - clamp(dot(d, pole) / length(d), 0.0, 1.0)) * ${ballPlaces - 1}.0;
  int k = min(int(at), ${ballPlaces - 2}) + eye * ${ballPlaces};
  return mix(faceLidBall[k], faceLidBall[k + 1], at - float(k - eye * ${ballPlaces}));
}

${/* Keeps a vertex of lids off the eyeball; way: by which its height changes. See clear_ball in core/kernel/lane_motions.h. */ ''}
void faceClearBall(int eye, float way, vec3 rest, inout vec3 p) {
  float radius = faceLidBall[(eye + 1) * ${ballPlaces} - 1];
  float hidden = 0.03 * radius;
  float wanted = hidden + faceLidLift[eye] * min(abs(p.y - rest.y), faceLidOpening[eye]);
  vec3 r = rest - faceEyePivot[eye];
  vec3 d = p - faceEyePivot[eye] - faceEyeTranslation[eye];
  float distance = length(d);
  if (hidden <= 0.0 || dot(r, r) <= 0.0 || distance <= 0.0) return;
  float clearance = length(r) - faceBallRadius(eye, faceLidGaze[eye], r);
  vec3 pole = faceRotate(faceEyeRotation[eye], faceLidGaze[eye]);
  float gained = (abs(way) / radius + length(pole - faceLidGaze[eye])) / 0.1;
  if (clearance >= wanted) clearance = wanted;
  else if (clearance > -hidden) clearance = mix(clearance, wanted, min(gained, 1.0));
  float least = faceBallRadius(eye, pole, d) + clearance;
  if (distance >= least) return;
  float square = least * least - dot(d.xy, d.xy);
  if (d.z > 0.0 && square > 0.25 * least * least) p.z += sqrt(square) - d.z;
  else p += d * ((least - distance) / distance);
}

void faceDeform(inout vec3 p, inout vec3 n) {
  vec3 rest = p;
  uint count = faceRow.y & 0xffffu;
  uint rigid = (faceRow.y >> 16u) & 0xffu;
  uint turn = faceRow.y >> 24u;
  int lids = rigid == ${rigidMotion.leftLids}u ? 0 : rigid == ${rigidMotion.rightLids}u ? 1 : -1;
  if (lids >= 0 && faceLidOpening[lids] <= 0.0) lids = -1;
  if (count > 0u) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    vec3 t1 = vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    vec3 t2 = vec3(b, s + n.y * n.y * a, -n.y);
    vec3 moved = vec3(0.0);
    vec3 rolls = vec3(0.0); ${/* of a lid: the share of its roll upwards, and the slopes of that */ ''}
    for (uint k = faceRow.x; k < faceRow.x + count; ++k) {
      vec4 entry = texelFetch(faceEntries, ivec2(int(k % ${tableWidth}u), int(k / ${tableWidth}u)), 0);
      int point = int(entry.x);
      vec3 d = facePoints[point];
      if (lids >= 0 && (point == ${lidPoints.upper} + lids || point == ${lidPoints.lower} + lids)) {
        bool isUpper = point == ${lidPoints.upper} + lids;
        rolls += entry.yzw * (isUpper ? -faceLidClosure[lids * 2] : faceLidClosure[lids * 2 + 1]);
        continue;
      }
      moved += entry.y * d;
      t1 += entry.z * d;
      t2 += entry.w * d;
    }
    p += moved;
    if (lids >= 0) {
      ${/* The height of Eq. 7, on the circle round the line through the pivot along x. */ ''}
      vec3 way = faceLidOpening[lids] * rolls;
      vec2 from = p.yz - faceEyePivot[lids].yz;
      float least = 0.05 * length(from);
      vec2 to = vec2(from.x + way.x, from.y);
      if (from.y > least && way.x != 0.0) to.y = sqrt(max(dot(from, from) - to.x * to.x, least * least));
      p.yz = faceEyePivot[lids].yz + to;
      vec2 risen = vec2(t1.y, t2.y) + way.yz;
      if (from.y > least) {
        ${/* Along a tangent the depth changes so that the place stays on its circle. */ ''}
        vec2 deep = (from.x * vec2(t1.y, t2.y) + from.y * vec2(t1.z, t2.z) - to.x * risen) / max(to.y, least);
        t1.z = deep.x;
        t2.z = deep.y;
      }
      t1.y = risen.x;
      t2.y = risen.y;
      faceClearBall(lids, way.x, rest, p);
    }
    vec3 turned = cross(t1, t2);
    float size = length(turned);
    if (size > 1e-12) n = turned / size;
  }
  if (rigid >= ${rigidMotion.tongue}u) {
    faceRollTongue(float(rigid - ${rigidMotion.tongue - 1}u) / 128.0 * faceTongueRoll, rest, p, n);
  } else if (rigid > 0u && rigid <= ${rigidMotion.rightIris}u) {
    int eye = (rigid & 1u) == 1u ? 0 : 1;
    if (rigid >= ${rigidMotion.leftIris}u && facePupilGrowth[eye] != 0.0 && faceIrisShape[eye].x > 0.0) {
      p += faceIris(eye, rest);
    }
    p = faceRotate(faceEyeRotation[eye], p - faceEyePivot[eye]) + faceEyePivot[eye] + faceEyeTranslation[eye];
    n = faceRotate(faceEyeRotation[eye], n);
  }
  vec4 head = faceHeadRotation;
  if (turn < ${fullTurn}u) {
    float share = float(turn) / ${fullTurn}.0;
    float side = head.w < 0.0 ? -share : share;
    head = normalize(vec4(side * head.xyz, (1.0 - share) + side * head.w));
  }
  p = faceRotate(head, p - faceHeadPivot) + faceHeadPivot;
  n = faceRotate(head, n);
}
`;
