import type { Kernel } from '@client/index.ts';
import type { DrawableMesh } from '@client/gpu/drawable_mesh.ts';
import type { RigDocument } from '@protocol/rig_document.ts';
import type { FaceMaterial } from '@client/gpu/face_material.ts';

/** One face package, validated and ready to animate. */
export interface LoadedFace {
  rig: RigDocument;
  mesh: DrawableMesh;
  materials: FaceMaterial[];
  kernel: Kernel;
  /** Transferred bytes of mesh and weights. */
  packageBytes: number;
}
