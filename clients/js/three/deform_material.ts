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
import { featurePointCount } from '../../../protocol/ts/generated/mpeg4.ts';
import { deformDeclarations, entryTexels, tableWidth } from '../gpu/deform_shader.ts';
import type { TangentTable } from '../gpu/tangent_table.ts';
import { ballPlaces, lidFields, type Pose } from '../kernel.ts';

/** The shader's uniforms. All materials of a face share one object. */
export interface DeformUniforms {
  faceEntries: IUniform<DataTexture>;
  facePoints: IUniform<Float32Array>;
  faceEyeRotation: IUniform<Vector4[]>;
  faceEyePivot: IUniform<Vector3[]>;
  faceEyeTranslation: IUniform<Vector3[]>;
  faceHeadRotation: IUniform<Vector4>;
  faceHeadPivot: IUniform<Vector3>;
  facePupilGrowth: IUniform<Float32Array>;
  faceIrisAxis: IUniform<Vector3[]>;
  /** pupil radius (0: no iris), iris radius, bend */
  faceIrisShape: IUniform<Vector3[]>;
  faceTongueRoll: IUniform<number>;
  faceTongueOrigin: IUniform<Vector3>;
  faceTongueLeft: IUniform<Vector3>;
  faceTongueUp: IUniform<Vector3>;
  faceTongueHalfWidth: IUniform<number>;
  faceLidGaze: IUniform<Vector3[]>;
  /** left, right; 0: the lids do not slide */
  faceLidOpening: IUniform<Float32Array>;
  /** left upper, left lower, right upper, right lower */
  faceLidClosure: IUniform<Float32Array>;
  faceLidBall: IUniform<Float32Array>;
  faceLidLift: IUniform<Float32Array>;
}

export function makeDeformUniforms(table: TangentTable): DeformUniforms {
  const texels = entryTexels(table);
  const texture = new DataTexture(texels, tableWidth, texels.length / 4 / tableWidth, RGBAFormat, FloatType);
  texture.minFilter = NearestFilter;
  texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return {
    faceEntries: { value: texture },
    facePoints: { value: new Float32Array(featurePointCount * 3) },
    faceEyeRotation: { value: [new Vector4(0, 0, 0, 1), new Vector4(0, 0, 0, 1)] },
    faceEyePivot: { value: [new Vector3(), new Vector3()] },
    faceEyeTranslation: { value: [new Vector3(), new Vector3()] },
    faceHeadRotation: { value: new Vector4(0, 0, 0, 1) },
    faceHeadPivot: { value: new Vector3() },
    facePupilGrowth: { value: new Float32Array(2) },
    faceIrisAxis: { value: [new Vector3(0, 0, 1), new Vector3(0, 0, 1)] },
    faceIrisShape: { value: [new Vector3(), new Vector3()] },
    faceTongueRoll: { value: 0 },
    faceTongueOrigin: { value: new Vector3() },
    faceTongueLeft: { value: new Vector3(1, 0, 0) },
    faceTongueUp: { value: new Vector3(0, 1, 0) },
    faceTongueHalfWidth: { value: 0 },
    faceLidGaze: { value: [new Vector3(0, 0, 1), new Vector3(0, 0, 1)] },
    faceLidOpening: { value: new Float32Array(2) },
    faceLidClosure: { value: new Float32Array(4) },
    faceLidBall: { value: new Float32Array(2 * ballPlaces) },
    faceLidLift: { value: new Float32Array(2) },
  };
}

export function setPose(uniforms: DeformUniforms, pose: Pose): void {
  uniforms.facePoints.value.set(pose.featurePoints);
  for (let eye = 0; eye < 2; eye += 1) {
    uniforms.faceEyeRotation.value[eye]!.fromArray(pose.eyeRotations, eye * 4);
    uniforms.faceEyePivot.value[eye]!.fromArray(pose.eyePivots, eye * 3);
    uniforms.faceEyeTranslation.value[eye]!.fromArray(pose.eyeTranslations, eye * 3);
    uniforms.faceIrisAxis.value[eye]!.fromArray(pose.irises, eye * 6);
    uniforms.faceIrisShape.value[eye]!.fromArray(pose.irises, eye * 6 + 3);
    const lids = eye * lidFields.count;
    uniforms.faceLidGaze.value[eye]!.fromArray(pose.lids, lids + lidFields.gaze);
    uniforms.faceLidOpening.value[eye] = pose.lids[lids + lidFields.opening]!;
    uniforms.faceLidLift.value[eye] = pose.lids[lids + lidFields.lift]!;
    for (let k = 0; k < ballPlaces; k += 1) {
      uniforms.faceLidBall.value[eye * ballPlaces + k] = pose.lids[lids + lidFields.ball + k]!;
    }
  }
  uniforms.faceLidClosure.value.set(pose.lidClosures);
  uniforms.faceHeadRotation.value.fromArray(pose.headRotation);
  uniforms.faceHeadPivot.value.fromArray(pose.headPivot);
  uniforms.facePupilGrowth.value.set(pose.pupilGrowth);
  uniforms.faceTongueRoll.value = pose.tongueRoll[0]!;
  uniforms.faceTongueOrigin.value.fromArray(pose.tongue, 0);
  uniforms.faceTongueLeft.value.fromArray(pose.tongue, 3);
  uniforms.faceTongueUp.value.fromArray(pose.tongue, 6);
  uniforms.faceTongueHalfWidth.value = pose.tongue[9]!;
}

/** Adds the deformation by the face's pose to the vertex shader of a three.js material. */
export function deformByShader(material: Material, uniforms: DeformUniforms): void {
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    const deform =
      'vec3 facePosition = position; vec3 faceNormal = vec3(normal); faceDeform(facePosition, faceNormal);';
    // Lit materials compute the normal before the position; unlit materials have no normal.
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
