import { Color, DoubleSide, MeshPhysicalMaterial, MeshStandardMaterial, type Material } from 'three';

/**
 * The file's material, adapted to studio light: a skin colour instead of plain white, limited metalness and roughness,
 * and a soft sheen at grazing angles as an approximation of subsurface scattering in skin.
 */
export function studioMaterial(material: Material, richSkin: boolean): Material {
  if (!(material instanceof MeshStandardMaterial)) return material;
  const bare = material.map === null && !(material.vertexColors ?? false);
  const white = material.color.r > 0.94 && material.color.g > 0.94 && material.color.b > 0.94;
  if (bare && white) material.color.copy(new Color(0xd8a387));
  material.metalness = Math.min(material.metalness, 0.4);
  if (material.roughness < 0.25 || material.transparent || !richSkin || !isSkinLike(material)) return tidy(material);
  const skin = new MeshPhysicalMaterial();
  MeshStandardMaterial.prototype.copy.call(skin, material);
  skin.defines = { STANDARD: '', PHYSICAL: '' };
  skin.metalness = 0;
  skin.roughness = Math.min(Math.max(material.roughness, 0.45), 0.62);
  skin.sheen = 0.35;
  skin.sheenRoughness = 0.55;
  skin.sheenColor = new Color(0xff9d7a);
  skin.specularIntensity = 0.65;
  return tidy(skin);
}

function tidy<T extends Material>(material: T): T {
  // The back faces of open meshes (heads cut at the neck, lids, lashes) are visible.
  material.side = DoubleSide;
  material.shadowSide = DoubleSide;
  if (material.transparent) {
    // Transparent lashes and brows are not sorted per triangle; without depth writes they leave no hard edges.
    material.depthWrite = false;
    material.alphaTest = Math.max(material.alphaTest, 0.02);
  }
  return material;
}

function isSkinLike(material: MeshStandardMaterial): boolean {
  const name = material.name.toLowerCase();
  return !/eye|iris|cornea|sclera|teeth|tooth|tongue|lash|brow|hair|fluid/.test(name);
}

/** The material of meshes without one. */
export function defaultMaterial(richSkin: boolean): Material {
  return studioMaterial(new MeshStandardMaterial({ color: 0xffffff, roughness: 0.6 }), richSkin);
}
