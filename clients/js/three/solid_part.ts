import { Mesh, MeshBasicMaterial, type Material } from 'three';
import { solidOpacity } from '../gpu/studio_look.ts';

/**
 * What is solid of the transparent materials of a mesh that have an image (hair, brows), as a mesh of the same geometry:
 * three.js draws it before all transparent materials. Null if the mesh has no such material.
 */
export function makeSolidPart({ geometry, material }: Mesh): Mesh | null {
  const solid = [material].flat().map(solidMaterial);
  if (solid.every((one) => one === null)) return null;
  const none = new MeshBasicMaterial({ visible: false });
  const materials = solid.map((one) => one ?? none);
  return new Mesh(geometry, Array.isArray(material) ? materials : materials[0]);
}

function solidMaterial(material: Material): Material | null {
  if (!material.transparent || !('map' in material) || !material.map) return null;
  const solid = material.clone();
  solid.transparent = false;
  solid.depthWrite = true;
  solid.alphaTest = solidOpacity;
  return solid;
}
