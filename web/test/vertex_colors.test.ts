import { expect, test } from 'vitest';
import { MeshStandardMaterial } from 'three';
import type { DrawableMesh } from '@client/gpu/drawable_mesh.ts';
import type { FaceMaterial } from '@client/gpu/face_material.ts';
import { makeMaterials } from '@client/three/face_materials.ts';
import { FaceView } from '@client/three/face_view.ts';

const triangle = (colors: Uint8Array | null): DrawableMesh => ({
  vertexCount: 3,
  positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]),
  normals: new Float32Array([0, 0, 1, 0, 0, 1, 0, 0, 1]),
  uvs: null,
  colors,
  indices: new Uint32Array([0, 1, 2]),
  groups: [{ start: 0, count: 3, material: 0 }],
  rowOffsets: new Uint32Array(4),
  rowPoints: new Uint8Array(0),
  rowWeights: new Float32Array(0),
  rigid: new Uint8Array(3),
  turn: new Uint8Array(3).fill(255),
});

const whiteSkin: FaceMaterial = {
  name: 'skin',
  baseColor: [1, 1, 1, 1],
  metallic: 0,
  roughness: 0.55,
  alphaMode: 'opaque',
  alphaCutoff: 0.5,
  doubleSided: false,
  baseColorImage: null,
  normalImage: null,
};

test('VertexColors_OfAFace_AreDrawnAsLinearLight', () => {
  const { geometry } = new FaceView(triangle(new Uint8Array([255, 0, 188, 0, 0, 0, 255, 255, 255])), []).object;
  const drawn = Array.from(geometry.getAttribute('color').array);
  [1, 0, 0.503, 0, 0, 0, 1, 1, 1].forEach((light, i) => expect(drawn[i]).toBeCloseTo(light, 3));
  expect(new FaceView(triangle(null), []).object.geometry.hasAttribute('color')).toBe(false);
});

test('VertexColors_AreNotMultipliedWithTheColourOfBareSkin', async () => {
  const [own] = (await makeMaterials([whiteSkin], true, true)) as MeshStandardMaterial[];
  expect([own!.vertexColors, own!.color.getHex()]).toEqual([true, 0xffffff]);
  const [bare] = (await makeMaterials([whiteSkin], true, false)) as MeshStandardMaterial[];
  expect([bare!.vertexColors, bare!.color.getHex()]).toEqual([false, 0xd8a387]);
});
