/**
 * A frame on one model: how far each feature point went and how the rigid parts turned. The memory is the kernel's
 * `semblante_pose`: floats in this order, so that the kernel can write it and the view can read it.
 */
export interface Pose {
  /** 84 by 3, model units */
  readonly points: Float32Array;
  /** 2 by 4: left, right; quaternions x, y, z, w */
  readonly eyeRotation: Float32Array;
  /** 2 by 3 */
  readonly eyeTranslation: Float32Array;
  /** 4 */
  readonly headRotation: Float32Array;
  /** 2 by 3 */
  readonly eyePivot: Float32Array;
  /** 3 */
  readonly headPivot: Float32Array;
}

export const poseFloats = 84 * 3 + 8 + 6 + 4 + 6 + 3;
export const poseBytes = poseFloats * 4;

/** A pose over `poseFloats` floats at a byte offset: a view, not a copy. */
export function poseAt(buffer: ArrayBufferLike, byteOffset: number): Pose {
  let at = byteOffset;
  const take = (floats: number): Float32Array => {
    const view = new Float32Array(buffer, at, floats);
    at += floats * 4;
    return view;
  };
  return {
    points: take(84 * 3),
    eyeRotation: take(8),
    eyeTranslation: take(6),
    headRotation: take(4),
    eyePivot: take(6),
    headPivot: take(3),
  };
}

export function neutralPose(): Pose {
  const pose = poseAt(new ArrayBuffer(poseBytes), 0);
  pose.eyeRotation[3] = 1;
  pose.eyeRotation[7] = 1;
  pose.headRotation[3] = 1;
  return pose;
}
