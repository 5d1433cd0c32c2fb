import type { Kernel } from '@client/index.ts';
import type { DrawableMesh } from './mesh.ts';

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
  mesh: DrawableMesh;
  materials: FaceMaterial[];
  kernel: Kernel;
  /** Bytes of mesh and weights on the wire. */
  packageBytes: number;
}
