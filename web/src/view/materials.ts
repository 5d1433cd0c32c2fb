import { Color, DoubleSide, MeshPhysicalMaterial, MeshStandardMaterial, type Material } from 'three';

/**
 * Materials as the file gives them, with what a face under studio light needs: skin that is not chalk where the file
 * says nothing, and a soft sheen at grazing angles in place of light that would pass through skin.
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
  // Open meshes (heads cut at the neck, lids, lashes) show their back faces.
  material.side = DoubleSide;
  material.shadowSide = DoubleSide;
  if (material.transparent) {
    // Lashes and brows: sorted poorly by depth alone, well enough when they leave no hard rim.
    material.depthWrite = false;
    material.alphaTest = Math.max(material.alphaTest, 0.02);
  }
  return material;
}

function isSkinLike(material: MeshStandardMaterial): boolean {
  const name = material.name.toLowerCase();
  return !/eye|iris|cornea|sclera|teeth|tooth|tongue|lash|brow|hair|fluid/.test(name);
}

/** For meshes without any material. */
export function defaultMaterial(richSkin: boolean): Material {
  return studioMaterial(new MeshStandardMaterial({ color: 0xffffff, roughness: 0.6 }), richSkin);
}
