import { Kernel, loadFace, type DracoModule, type Runtime } from '@client/index.ts';
import { drawableMesh } from '@client/gpu/drawable_mesh.ts';
import { loadMaterials } from '@client/gpu/face_material.ts';
import type { LoadedFace } from './loaded_face.ts';
import { poseCount } from './performer.ts';

export interface FaceSources {
  /** The server's base URL; empty: the server of this page. */
  base: string;
  draco: () => Promise<DracoModule>;
  runtime: () => Promise<Runtime>;
  /** Fetches an image of the package by its content hash. */
  image: (sha256: string, signal: AbortSignal) => Promise<Uint8Array>;
}

/**
 * Fetches one level of detail (0 is the full mesh) of a model's face package and prepares it for drawing and animation.
 * Throws when the parts of the package are inconsistent.
 */
export async function loadStageFace(
  sources: FaceSources,
  model: string,
  level: number,
  signal: AbortSignal,
): Promise<LoadedFace> {
  const [draco, runtime] = await Promise.all([sources.draco(), sources.runtime()]);
  const face = await loadFace(sources.base, model, { draco, runtime, signal, ...(level > 0 ? { level: { lod: level } } : {}) });
  const materials = await loadMaterials(face.rig, (sha256) => sources.image(sha256, signal));
  const kernel = new Kernel(runtime, face, { poseCount });
  return { rig: face.rig, mesh: drawableMesh(face), materials, kernel, packageBytes: face.rig.mesh.bytes + face.rig.weights.bytes };
}
