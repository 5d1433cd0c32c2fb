import { Triangle, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { meantCorner, moveToEdge } from '../src/view/triangle_place.ts';

const triangle = new Triangle(new Vector3(0, 0, 0), new Vector3(10, 0, 0), new Vector3(0, 2, 0));

test('MeantCorner_WithinATenthOfItsShorterEdge', () => {
  expect(meantCorner(new Vector3(0.19, 0, 0), triangle)).toBe(0);
  expect(meantCorner(new Vector3(0.21, 0, 0), triangle)).toBe(-1);
  expect(meantCorner(new Vector3(9.1, 0.1, 0), triangle)).toBe(1);
  expect(meantCorner(new Vector3(3, 0.5, 0), triangle)).toBe(-1);
});

test('MoveToEdge_WithinATwentiethOfTheWayAcross', () => {
  // A share of 0.04 at the third corner goes to the others, by their shares.
  const moved = moveToEdge(new Vector3(4.8, 0.08, 0), triangle);
  expect(moved.y).toBe(0);
  expect(moved.x).toBeCloseTo(5, 12);
  expect(moveToEdge(new Vector3(4, 0.2, 0), triangle).toArray()).toEqual([4, 0.2, 0]);
});
