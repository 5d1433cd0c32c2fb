import {
  DataTexture,
  FloatType,
  NearestFilter,
  RGBAFormat,
  Vector3,
  Vector4,
  type IUniform,
  type Material,
} from 'three';
import type { Pose } from '@client/index.ts';
import type { TangentTable } from '../face/tangent_table.ts';

/** Texels across the entry texture: entry k lies at (k mod width, k div width). */
const tableWidth = 1024;

/** What the shader reads each frame. One object serves all materials of a face. */
export interface DeformUniforms {
  faceEntries: IUniform<DataTexture>;
  facePoints: IUniform<Float32Array>;
  faceEyeRotation: IUniform<Vector4[]>;
  faceEyePivot: IUniform<Vector3[]>;
  faceEyeTranslation: IUniform<Vector3[]>;
  faceHeadRotation: IUniform<Vector4>;
  faceHeadPivot: IUniform<Vector3>;
}

export function makeDeformUniforms(table: TangentTable): DeformUniforms {
  const rows = Math.max(1, Math.ceil(table.entries.length / 4 / tableWidth));
  const texels = new Float32Array(rows * tableWidth * 4);
  texels.set(table.entries);
  const texture = new DataTexture(texels, tableWidth, rows, RGBAFormat, FloatType);
  texture.minFilter = NearestFilter;
  texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return {
    faceEntries: { value: texture },
    facePoints: { value: new Float32Array(84 * 3) },
    faceEyeRotation: { value: [new Vector4(0, 0, 0, 1), new Vector4(0, 0, 0, 1)] },
    faceEyePivot: { value: [new Vector3(), new Vector3()] },
    faceEyeTranslation: { value: [new Vector3(), new Vector3()] },
    faceHeadRotation: { value: new Vector4(0, 0, 0, 1) },
    faceHeadPivot: { value: new Vector3() },
  };
}

export function setPose(uniforms: DeformUniforms, pose: Pose): void {
  uniforms.facePoints.value.set(pose.featurePoints);
  for (let eye = 0; eye < 2; eye += 1) {
    uniforms.faceEyeRotation.value[eye]!.fromArray(pose.eyeRotations, eye * 4);
    uniforms.faceEyePivot.value[eye]!.fromArray(pose.eyePivots, eye * 3);
    uniforms.faceEyeTranslation.value[eye]!.fromArray(pose.eyeTranslations, eye * 3);
  }
  uniforms.faceHeadRotation.value.fromArray(pose.headRotation);
  uniforms.faceHeadPivot.value.fromArray(pose.headPivot);
}

/**
 * Eq. 7 in GLSL: the second version of core/kernel's semblante_deform. `faceRow` is (first entry, count + rigid << 16).
 * The normal comes from the slopes beside the weights: see face/tangent_table.ts.
 */
export const deformDeclarations = /* glsl */ `
attribute uvec2 faceRow;
uniform highp sampler2D faceEntries;
uniform vec3 facePoints[84];
uniform vec4 faceEyeRotation[2];
uniform vec3 faceEyePivot[2];
uniform vec3 faceEyeTranslation[2];
uniform vec4 faceHeadRotation;
uniform vec3 faceHeadPivot;

vec3 faceRotate(vec4 q, vec3 v) {
  return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v);
}

void faceDeform(inout vec3 p, inout vec3 n) {
  uint count = faceRow.y & 0xffffu;
  uint rigid = faceRow.y >> 16u;
  if (count > 0u) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    vec3 t1 = vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    vec3 t2 = vec3(b, s + n.y * n.y * a, -n.y);
    vec3 moved = vec3(0.0);
    for (uint k = faceRow.x; k < faceRow.x + count; ++k) {
      vec4 entry = texelFetch(faceEntries, ivec2(int(k % ${tableWidth}u), int(k / ${tableWidth}u)), 0);
      vec3 d = facePoints[int(entry.x)];
      moved += entry.y * d;
      t1 += entry.z * d;
      t2 += entry.w * d;
    }
    p += moved;
    vec3 turned = cross(t1, t2);
    float size = length(turned);
    if (size > 1e-12) n = turned / size;
  }
  if (rigid > 0u) {
    int eye = int(rigid) - 1;
    p = faceRotate(faceEyeRotation[eye], p - faceEyePivot[eye]) + faceEyePivot[eye] + faceEyeTranslation[eye];
    n = faceRotate(faceEyeRotation[eye], n);
  }
  p = faceRotate(faceHeadRotation, p - faceHeadPivot) + faceHeadPivot;
  n = faceRotate(faceHeadRotation, n);
}
`;

/** Makes one of three.js' own materials move its vertices by the face's pose. */
export function deformByShader(material: Material, uniforms: DeformUniforms): void {
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    const deform =
      'vec3 facePosition = position; vec3 faceNormal = vec3(normal); faceDeform(facePosition, faceNormal);';
    // Lit materials need the normal before the position; unlit ones have no use for it.
    const lit = shader.vertexShader.includes('#define STANDARD');
    const normals = lit ? `${deform} vec3 objectNormal = faceNormal;` : '#include <beginnormal_vertex>';
    const positions = `${lit ? '' : deform} vec3 transformed = facePosition;`;
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', `#include <common>\n${deformDeclarations}`)
      .replace('#include <beginnormal_vertex>', normals)
      .replace('#include <begin_vertex>', positions);
  };
  material.customProgramCacheKey = () => 'face-on-gpu';
  material.needsUpdate = true;
}

export function deformByCpu(material: Material): void {
  material.onBeforeCompile = () => {};
  material.customProgramCacheKey = () => 'face-on-cpu';
  material.needsUpdate = true;
}
