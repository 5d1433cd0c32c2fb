import { expect, test } from 'vitest';
import { pickVertex } from '../src/face/ray_pick.ts';

// Two squares of two triangles each, one behind the other: z = 0 (vertices 0 to 3) and z = -1 (4 to 7).
const square = (z: number): number[] => [0, 0, z, 1, 0, z, 1, 1, z, 0, 1, z];
const positions = Float32Array.from([...square(0), ...square(-1)]);
const front = [0, 1, 2, 0, 2, 3];
const both = Uint32Array.from([4, 5, 6, 4, 6, 7, ...front]);
const ray = (x: number, y: number, z: number, dz: number): Float64Array => Float64Array.of(x, y, z, 0, 0, dz);

test('PickVertex_TwoSurfaces_GivesTheNearestCornerOfTheFirst', () => {
  expect(pickVertex(positions, both, ray(0.9, 0.1, 5, -1))).toBe(1);
  expect(pickVertex(positions, both, ray(0.1, 0.9, 5, -3))).toBe(3);
  expect(pickVertex(positions, both, ray(0.9, 0.8, 5, -1))).toBe(2);
  // From behind the farther square comes first, and back faces count.
  expect(pickVertex(positions, both, ray(0.9, 0.1, -5, 1))).toBe(5);
});

test('PickVertex_TrianglesThatAreLeftOut_AreSeenThrough', () => {
  expect(pickVertex(positions, Uint32Array.from([4, 5, 6, 4, 6, 7]), ray(0.9, 0.1, 5, -1))).toBe(5);
});

test('PickVertex_PastTheMeshBehindTheEyeOrWithoutArea_FindsNothing', () => {
  expect(pickVertex(positions, both, ray(1.1, 0.5, 5, -1))).toBe(-1);
  expect(pickVertex(positions, both, ray(0.5, 0.5, 5, 1))).toBe(-1);
  expect(pickVertex(positions, Uint32Array.from([0, 0, 0, 0, 1, 1]), ray(0, 0, 5, -1))).toBe(-1);
  expect(pickVertex(positions, new Uint32Array(), ray(0.5, 0.5, 5, -1))).toBe(-1);
});
