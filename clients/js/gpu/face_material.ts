import type { RigDocument } from '../../../protocol/ts/rig_document.ts';

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

/** The materials of a face with their images, each fetched once by its content hash. */
export async function loadMaterials(
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
