import { Kernel, loadFace, type DracoModule, type Face, type RigDocument } from '@client/index.ts';
import type { FaceMaterial, LoadedFace } from './loaded_face.ts';
import { joinSeams, smoothNormals, type DrawableMesh, type MaterialGroup } from './mesh.ts';
import { poseCount } from './performer.ts';

export interface FaceSources {
  /** The server's base URL; empty: the server of this page. */
  base: string;
  draco: () => Promise<DracoModule>;
  kernel: () => Promise<WebAssembly.Module>;
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
  const [draco, module] = await Promise.all([sources.draco(), sources.kernel()]);
  const face = await loadFace(sources.base, model, { draco, signal, ...(level > 0 ? { level: { lod: level } } : {}) });
  const [kernel, materials] = await Promise.all([
    Kernel.create(module, face, { poseCount }),
    loadMaterials(face.rig, (sha256) => sources.image(sha256, signal)),
  ]);
  return { mesh: drawableMesh(face), materials, kernel, packageBytes: face.rig.mesh.bytes + face.rig.weights.bytes };
}

/** Converts the package's arrays for the view: normals of unit length, triangles sorted by material. */
export function drawableMesh({ mesh, influence, rig }: Face): DrawableMesh {
  const { positions, uvs, triangles } = mesh;
  const normals = mesh.normals ?? smoothNormals(positions, triangles, joinSeams(positions, null));
  normalize(normals);
  const { indices, groups } = sortByMaterial(triangles, mesh.materials, rig.materials.length);
  const { vertexCount, rowOffsets, rowPoints, rowWeights, rigid, turn } = influence;
  return { vertexCount, positions, normals, uvs, indices, groups, rowOffsets, rowPoints, rowWeights, rigid, turn };
}

/** Normalizes in place: quantized normals decode to slightly other lengths, and the shader assumes unit length. */
function normalize(normals: Float32Array): void {
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i]!, normals[i + 1]!, normals[i + 2]!);
    if (length > 1e-6) for (let k = 0; k < 3; k += 1) normals[i + k]! /= length;
    else normals.set([0, 0, 1], i);
  }
}

/** Sorts the triangles by material, so that each material needs one draw call. */
export function sortByMaterial(
  indices: Uint32Array,
  materials: Uint8Array | null,
  materialCount: number,
): { indices: Uint32Array; groups: MaterialGroup[] } {
  if (!materials) return { indices, groups: [{ start: 0, count: indices.length, material: 0 }] };
  const counts = new Uint32Array(materialCount);
  for (let i = 0; i < indices.length; i += 3) counts[materials[indices[i]!]!]! += 3;
  const next = new Uint32Array(materialCount);
  const groups: MaterialGroup[] = [];
  let start = 0;
  counts.forEach((count, material) => {
    next[material] = start;
    if (count > 0) groups.push({ start, count, material });
    start += count;
  });
  const sorted = new Uint32Array(indices.length);
  for (let i = 0; i < indices.length; i += 3) {
    const material = materials[indices[i]!]!;
    sorted.set(indices.subarray(i, i + 3), next[material]!);
    next[material]! += 3;
  }
  return { indices: sorted, groups };
}

async function loadMaterials(
  rig: RigDocument,
  fetchImage: (sha256: string) => Promise<Uint8Array>,
): Promise<FaceMaterial[]> {
  const types = new Map(rig.images.map((image) => [image.sha256, image.mime_type]));
  const blobs = new Map<string, Promise<Blob>>();
  const image = (sha256: string | null): Promise<Blob | null> => {
    if (sha256 === null) return Promise.resolve(null);
    let blob = blobs.get(sha256);
    if (!blob) {
      blob = fetchImage(sha256).then(
        (bytes) => new Blob([bytes as Uint8Array<ArrayBuffer>], { type: types.get(sha256) ?? 'image/png' }),
      );
      blobs.set(sha256, blob);
    }
    return blob;
  };
  return Promise.all(
    rig.materials.map(async (material) => ({
      name: material.name,
      baseColor: material.base_color,
      metallic: material.metallic,
      roughness: material.roughness,
      alphaMode: material.alpha_mode,
      alphaCutoff: material.alpha_cutoff,
      doubleSided: material.double_sided,
      baseColorImage: await image(material.base_color_image),
      normalImage: await image(material.normal_image),
    })),
  );
}
