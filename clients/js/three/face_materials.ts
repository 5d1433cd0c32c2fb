import {
  Color,
  LinearSRGBColorSpace,
  MeshStandardMaterial,
  SRGBColorSpace,
  Texture,
  Vector2,
  RepeatWrapping,
  type Material,
} from 'three';
import type { FaceMaterial } from '../gpu/face_material.ts';
import { studioMaterial } from './studio_material.ts';

/** `vertexColors`: whether the mesh has them. */
export function makeMaterials(
  facts: readonly FaceMaterial[],
  richSkin: boolean,
  vertexColors: boolean,
): Promise<Material[]> {
  return Promise.all(facts.map((one) => makeMaterial(one, richSkin, vertexColors)));
}

async function makeMaterial(facts: FaceMaterial, richSkin: boolean, vertexColors: boolean): Promise<Material> {
  const [r, g, b, a] = facts.baseColor;
  const material = new MeshStandardMaterial({
    name: facts.name,
    color: new Color().setRGB(r, g, b, LinearSRGBColorSpace),
    metalness: facts.metallic,
    roughness: facts.roughness,
    opacity: facts.alphaMode === 'blend' ? a : 1,
    transparent: facts.alphaMode === 'blend',
    alphaTest: facts.alphaMode === 'mask' ? facts.alphaCutoff : 0,
    vertexColors,
  });
  if (facts.baseColorImage) material.map = await makeTexture(facts.baseColorImage, true);
  if (facts.normalImage) {
    material.normalMap = await makeTexture(facts.normalImage, false);
    // Without tangents three.js derives the tangent frame from screen space; the green channel of glTF points up.
    material.normalScale = new Vector2(1, -1);
  }
  return studioMaterial(material, richSkin);
}

async function makeTexture(image: Blob, color: boolean): Promise<Texture> {
  const bitmap = await createImageBitmap(image, { colorSpaceConversion: 'none' });
  const texture = new Texture(bitmap);
  texture.flipY = false;
  texture.wrapS = RepeatWrapping;
  texture.wrapT = RepeatWrapping;
  texture.anisotropy = 4;
  texture.colorSpace = color ? SRGBColorSpace : '';
  texture.needsUpdate = true;
  return texture;
}
