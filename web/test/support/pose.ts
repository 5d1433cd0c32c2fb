import { lidFields, type Pose } from '@client/index.ts';

/** A pose in plain memory, as the kernel makes one of the neutral frame. */
export function neutralPose(): Pose {
  return {
    featurePoints: new Float32Array(84 * 3),
    eyeRotations: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1]),
    eyeTranslations: new Float32Array(6),
    headRotation: new Float32Array([0, 0, 0, 1]),
    eyePivots: new Float32Array(6),
    headPivot: new Float32Array(3),
    pupilGrowth: new Float32Array(2),
    tongueRoll: new Float32Array(1),
    irises: new Float32Array(12),
    tongue: new Float32Array(11),
    lidClosures: new Float32Array(4),
    lids: new Float32Array(2 * lidFields.count),
  };
}
