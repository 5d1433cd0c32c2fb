import { Texture, type Material } from 'three';

/** Frees materials with their textures, which three.js keeps on the graphics card until it is told. */
export function disposeMaterials(materials: Iterable<Material>): void {
  for (const material of materials) {
    for (const value of Object.values(material) as unknown[]) if (value instanceof Texture) value.dispose();
    material.dispose();
  }
}
