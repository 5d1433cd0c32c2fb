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

/** A face that stands still. */
export interface StillFace {
  rig: LoadedFace['rig'];
  mesh: LoadedFace['mesh'];
  materials: LoadedFace['materials'];
}

/** Fetches one level of detail to draw it, unless its images have more than `most` bytes: null. */
export async function loadStillFace(sources: FaceSources, model: string, level: number, most: number): Promise<{ still: StillFace | null; imageBytes: number }> {
  const { signal } = new AbortController();
  const [draco, runtime] = await Promise.all([sources.draco(), sources.runtime()]);
  const face = await loadFace(sources.base, model, { draco, runtime, level: { lod: level } });
  const imageBytes = face.rig.images.reduce((sum, { bytes }) => sum + bytes, 0);
  if (imageBytes > most) return { still: null, imageBytes: 0 };
  const materials = await loadMaterials(face.rig, (sha256) => sources.image(sha256, signal));
  return { still: { rig: face.rig, mesh: drawableMesh(face), materials }, imageBytes };
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
