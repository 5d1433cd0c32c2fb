/** The adapter to three.js: a face as a mesh that the graphics processor deforms. */
export { FaceView, type DeformPath } from './face_view.ts';
export { makeMaterials } from './face_materials.ts';
export { defaultMaterial, studioMaterial } from './studio_material.ts';
export { drawableMesh, type DrawableMesh, type MaterialGroup } from '../gpu/drawable_mesh.ts';
export { loadMaterials, type FaceMaterial } from '../gpu/face_material.ts';
