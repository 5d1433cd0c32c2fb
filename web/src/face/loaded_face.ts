import type { FaceFrame } from './frame.ts';
import type { FaceMesh } from './mesh.ts';
import type { Pose } from './pose.ts';

/** glTF's metallic-roughness in the few values a face needs. */
export interface FaceMaterial {
  name: string;
  /** linear RGBA */
  baseColor: readonly [number, number, number, number];
  metallic: number;
  roughness: number;
  alphaMode: 'opaque' | 'mask' | 'blend';
  alphaCutoff: number;
  doubleSided: boolean;
  baseColorImage: Blob | null;
  normalImage: Blob | null;
}

/** Everything of one face package, checked and ready to move. */
export interface LoadedFace {
  mesh: FaceMesh;
  materials: FaceMaterial[];
  /** Bytes that went over the wire for mesh, weights and rig. */
  packageBytes: number;
  newPose(): Pose;
  /** Eq. 5, 6. */
  evaluate(frame: FaceFrame, out: Pose): void;
  /** `t` of the way from `a` to `b`; `out` may be either. */
  interpolate(a: Pose, b: Pose, t: number, out: Pose): void;
  /** Eq. 7 on the CPU; read the result before the next call. */
  deform(pose: Pose): Float32Array;
}
