import { BufferAttribute, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { outwardAt } from '../src/view/outward.ts';

type Vertex = readonly [place: readonly number[], normal: readonly number[]];
const piece = (vertices: readonly Vertex[]): { positions: BufferAttribute; normals: BufferAttribute } => ({
  positions: new BufferAttribute(Float32Array.from(vertices.flatMap(([place]) => place)), 3),
  normals: new BufferAttribute(Float32Array.from(vertices.flatMap(([, normal]) => normal)), 3),
});
const edge = new Vector3(0, 0, 0);

test('Outward_OfALipsEdgeThatLooksDown_IsForward', () => {
  const lip = piece([
    [[0, 0, 0], [0, -0.8, 0.6]],
    ...[-1, 0, 1].flatMap((x): Vertex[] => [1, 2].map((y) => [[x, y, 0.2], [0, 0.1, 1]])),
  ]);
  const outward = outwardAt([lip], edge, 3).normalize();
  expect(outward.z).toBeGreaterThan(0.95);
  expect(outwardAt([lip], edge, 0.1).normalize().z).toBeCloseTo(0.6); // of the nearest vertex alone
});

test('Outward_OfAnEar_IsThatOfItsOwnSide', () => {
  const ear = (x: number): Vertex[] => [0, 1, 2].map((y) => [[x, y, 0], [Math.sign(x), 0, 0]]);
  const both = piece([...ear(0.1), ...ear(-0.1), ...ear(-0.1)]);
  expect(outwardAt([both], new Vector3(0.1, 0, 0), 3).normalize().x).toBeCloseTo(1);
});

test('Outward_BetweenCoarseVertices_IsThatOfTheNearest', () => {
  const coarse = piece([[[10, 0, 0], [1, 0, 0]], [[0, 9, 0], [0, 1, 0]]]);
  expect(outwardAt([coarse], edge, 1).toArray()).toEqual([0, 1, 0]);
});
