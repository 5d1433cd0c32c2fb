import { decodeWeights } from '@protocol/weights_format.ts';
import { decodeMesh, type DecodedMesh } from './draco.ts';
import { Kernel } from './kernel.ts';
import type { FaceMaterial, LoadedFace } from './loaded_face.ts';
import { joinSeams, smoothNormals, type FaceMesh, type MaterialGroup } from './mesh.ts';
import { parseRig, rigData, type RigDocument } from './rig_document.ts';

/** Where the artefacts come from: the network on the page, files in tests. */
export interface PackageSource {
  artefact(name: 'mesh.drc' | 'weights' | 'rig.json'): Promise<Uint8Array>;
  /** An image of the package by its content hash. */
  image(sha256: string): Promise<Uint8Array>;
  kernel(): Promise<WebAssembly.Module>;
}

/** Fetches, checks and joins the three artefacts. Throws when they do not belong together. */
export async function loadFace(source: PackageSource): Promise<LoadedFace> {
  const [meshBytes, weightBytes, rigBytes, kernelModule] = await Promise.all([source.artefact('mesh.drc'), source.artefact('weights'), source.artefact('rig.json'), source.kernel()]);
  const packageBytes = meshBytes.length + weightBytes.length + rigBytes.length;
  const rig = parseRig(new TextDecoder().decode(rigBytes));
  const [meshHash, table] = await Promise.all([hashOf(meshBytes), decodeWeights(weightBytes)]);
  if (table.meshSha256 !== rig.mesh.sha256 || (meshHash !== null && meshHash !== rig.mesh.sha256)) {
    throw new Error('mesh, weights and rig are of different parametrizations: load the head again');
  }
  const decoded = await decodeMesh(meshBytes, rig.mesh.attributes);
  if (decoded.positions.length !== table.vertexCount * 3) throw new Error(`the mesh has ${decoded.positions.length / 3} vertices, the weights ${table.vertexCount}`);
  const mesh = joinMesh(decoded, table, rig.materials.length);
  const kernel = await Kernel.create(kernelModule, mesh, rigData(rig));
  return {
    mesh,
    materials: await loadMaterials(rig, source),
    packageBytes,
    newPose: () => kernel.newPose(),
    evaluate: (frame, out) => kernel.evaluate(frame, out),
    interpolate: (a, b, t, out) => kernel.interpolate(a, b, t, out),
    deform: (pose) => kernel.deform(pose),
  };
}

/** Lower-case hexadecimal SHA-256, or null where the page has no crypto (plain http on a network address). */
async function hashOf(bytes: Uint8Array): Promise<string | null> {
  if (typeof crypto === 'undefined' || !crypto.subtle) return null;
  const digest = await crypto.subtle.digest('SHA-256', bytes as Uint8Array<ArrayBuffer>);
  return Array.from(new Uint8Array(digest), (byte) => byte.toString(16).padStart(2, '0')).join('');
}

interface Rows {
  vertexCount: number;
  rowOffsets: Uint32Array;
  rowPoints: Uint8Array;
  rowWeights: Float32Array;
  rigid: Uint8Array;
}

function joinMesh(decoded: DecodedMesh, rows: Rows, materialCount: number): FaceMesh {
  const { positions, uvs, indices } = decoded;
  const normals = decoded.normals ?? smoothNormals(positions, indices, joinSeams(positions, null));
  normalize(normals);
  const sorted = sortByMaterial(indices, decoded.materials, materialCount);
  return { vertexCount: rows.vertexCount, positions, normals, uvs, ...sorted, rowOffsets: rows.rowOffsets, rowPoints: rows.rowPoints, rowWeights: rows.rowWeights, rigid: rows.rigid };
}

/** Quantized normals come back a little short or long; the shader counts on unit length. */
function normalize(normals: Float32Array): void {
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i]!, normals[i + 1]!, normals[i + 2]!);
    if (length > 1e-6) for (let k = 0; k < 3; k += 1) normals[i + k]! /= length;
    else normals.set([0, 0, 1], i);
  }
}

/** Triangles of one material lie together, so that each material is one draw call. */
export function sortByMaterial(indices: Uint32Array, materials: Uint8Array | null, materialCount: number): { indices: Uint32Array; groups: MaterialGroup[] } {
  if (!materials) return { indices, groups: [{ start: 0, count: indices.length, material: 0 }] };
  const counts = new Uint32Array(materialCount);
  const materialAt = (i: number): number => Math.min(materials[indices[i]!]!, materialCount - 1);
  for (let i = 0; i < indices.length; i += 3) counts[materialAt(i)]! += 3;
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
    const material = materialAt(i);
    sorted.set(indices.subarray(i, i + 3), next[material]!);
    next[material]! += 3;
  }
  return { indices: sorted, groups };
}

async function loadMaterials(rig: RigDocument, source: PackageSource): Promise<FaceMaterial[]> {
  const types = new Map(rig.images.map((image) => [image.sha256, image.mime_type]));
  const blobs = new Map<string, Promise<Blob>>();
  const image = (sha256: string | null): Promise<Blob | null> => {
    if (sha256 === null) return Promise.resolve(null);
    let blob = blobs.get(sha256);
    if (!blob) {
      blob = source.image(sha256).then((bytes) => new Blob([bytes as Uint8Array<ArrayBuffer>], { type: types.get(sha256) ?? 'image/png' }));
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
