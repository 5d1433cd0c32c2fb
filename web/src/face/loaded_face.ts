import type { Kernel } from '@client/index.ts';
import type { DrawableMesh } from './mesh.ts';

/** The subset of glTF's metallic-roughness material that a face uses. */
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

/** One face package, validated and ready to animate. */
export interface LoadedFace {
  mesh: DrawableMesh;
  materials: FaceMaterial[];
  kernel: Kernel;
  /** Transferred bytes of mesh and weights. */
  packageBytes: number;
}
