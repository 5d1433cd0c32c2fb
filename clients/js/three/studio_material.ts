import { Color, DoubleSide, MeshPhysicalMaterial, MeshStandardMaterial, type Material } from 'three';
import {
  bareSkinColor,
  isSkinLike,
  leastOpacity,
  mostMetalness,
  skinLook,
  skinRoughness,
  whiteLevel,
} from '../gpu/studio_look.ts';

/**
 * The file's material, adapted to studio light: a skin colour instead of plain white, limited metalness and roughness,
 * and a soft sheen at grazing angles as an approximation of subsurface scattering in skin.
 */
export function studioMaterial(material: Material, richSkin: boolean): Material {
  if (!(material instanceof MeshStandardMaterial)) return material;
  const bare = material.map === null && !material.vertexColors;
  const { r, g, b } = material.color;
  if (bare && Math.min(r, g, b) > whiteLevel) material.color.copy(new Color(bareSkinColor));
  material.metalness = Math.min(material.metalness, mostMetalness);
  if (!richSkin || !isSkinLike(material.name, material.roughness, material.transparent)) return tidy(material);
  const skin = new MeshPhysicalMaterial();
  MeshStandardMaterial.prototype.copy.call(skin, material);
  skin.defines = { STANDARD: '', PHYSICAL: '' };
  skin.metalness = 0;
  skin.roughness = skinRoughness(material.roughness);
  skin.sheen = skinLook.sheen;
  skin.sheenRoughness = skinLook.sheenRoughness;
  skin.sheenColor = new Color(skinLook.sheenColor);
  skin.specularIntensity = skinLook.specularIntensity;
  return tidy(skin);
}

function tidy<T extends Material>(material: T): T {
  // The back faces of open meshes (heads cut at the neck, lids, lashes) are visible.
  material.side = DoubleSide;
  material.shadowSide = DoubleSide;
  if (material.transparent) {
    // Transparent lashes and brows are not sorted per triangle; without depth writes they leave no hard edges.
    material.depthWrite = false;
    material.alphaTest = Math.max(material.alphaTest, leastOpacity);
  }
  return material;
}

/** The material of meshes without one. */
export function defaultMaterial(richSkin: boolean): Material {
  return studioMaterial(new MeshStandardMaterial({ color: 0xffffff, roughness: 0.6 }), richSkin);
}
