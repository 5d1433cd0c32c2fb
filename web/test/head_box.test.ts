import { CapsuleGeometry, BoxGeometry, CylinderGeometry, PlaneGeometry, SphereGeometry, type BufferGeometry } from 'three';
import { expect, test } from 'vitest';
import { findHead, framedHead, headOfPoints, type Box, type Piece } from '../src/view/head_box.ts';

/** In metres, like a person: the head is 0.16 wide and reaches from 1.52 to 1.75. */
function piece(geometry: BufferGeometry, y: number, x = 0): Piece {
  geometry.translate(x, y, 0);
  return { positions: geometry.getAttribute('position').array, triangles: geometry.index!.array };
}
const skull = (segments: number): Piece => {
  const sphere = new SphereGeometry(0.115, segments, segments);
  sphere.scale(0.7, 1, 0.9);
  return piece(sphere, 1.635);
};
const neck = (): Piece => piece(new CylinderGeometry(0.05, 0.055, 0.12, 12), 1.49);
const torso = (): Piece => piece(new BoxGeometry(0.4, 0.6, 0.2), 1.14);
const legs = (): Piece => piece(new BoxGeometry(0.34, 0.85, 0.2), 0.42);
const arms = (): Piece => piece(new CylinderGeometry(0.04, 0.04, 1.6, 8).rotateZ(Math.PI / 2), 1.38);

test.each([
  ['a body', [skull(32), neck(), torso(), legs()]],
  ['a body with its arms spread', [skull(32), neck(), torso(), legs(), arms()]],
  ['a coarse body', [skull(6), neck(), torso(), legs()]],
  ['a body with a bun of hair', [piece(new SphereGeometry(0.03, 16, 16), 1.76), skull(32), neck(), torso(), legs()]],
  ['a bust', [skull(32), neck(), torso()]],
  ['a cartoon with a thick neck and sloping shoulders', [skull(32), piece(new CylinderGeometry(0.067, 0.067, 0.2, 24), 1.48), piece(new CylinderGeometry(0.067, 0.3, 0.35, 24), 1.265), legs()]],
  ['long hair', [skull(32), neck(), torso(), legs(), piece(new CylinderGeometry(0.085, 0.09, 0.34, 16), 1.58)]],
])('findHead_OfAStandingFigure_EndsAtTheNeck: %s', (_, pieces) => {
  const head = findHead(pieces)!;
  expect(head.max[1]).toBeCloseTo(1.75, 1);
  expect(head.min[1]).toBeGreaterThan(1.4);
  expect(head.min[1]).toBeLessThan(1.56);
  expect(head.max[0] - head.min[0]).toBeLessThan(0.3);
});

test('findHead_FaceAsNarrowAsItsThickNeck_IsInIt', () => {
  // A cartoon: ears at 1.65, and a muzzle below them that is as wide as the neck.
  const muzzle = piece(new CylinderGeometry(0.067, 0.067, 0.2, 24), 1.5);
  const shoulders = piece(new CylinderGeometry(0.067, 0.3, 0.2, 24), 1.3);
  expect(findHead([skull(32), muzzle, shoulders, legs()])!.min[1]).toBeCloseTo(1.4, 2);
});

test('framedHead_CollarAboveTheChin_HasTheChinInIt', () => {
  const bent = [skull(32), piece(new BoxGeometry(0.14, 0.06, 0.2), 1.585), piece(new CylinderGeometry(0.13, 0.2, 0.4, 24), 1.37), torso()];
  const cut = findHead(bent)!;
  const shown = framedHead(bent)!;
  expect(cut.min[1]).toBeGreaterThan(1.54); // above the chin, at 1.52
  expect(shown.min[1]).toBeLessThan(1.53);
});

test('findHead_WhereAllIsTheHead_FindsNone', () => {
  expect(findHead([skull(32)])).toBeNull();
  expect(findHead([skull(32), neck()])).toBeNull();
  expect(findHead([piece(new CapsuleGeometry(0.08, 0.1, 8, 12), 0)])).toBeNull();
});

test('findHead_OfWhatDoesNotStand_FindsNone', () => {
  const lying = [skull(16), neck(), torso(), legs()].map(({ positions, triangles }) => ({
    positions: Float32Array.from(positions, (_, i) => positions[i % 3 === 0 ? i + 1 : i % 3 === 1 ? i - 1 : i]!),
    triangles,
  }));
  expect(findHead(lying)).toBeNull();
  expect(findHead([piece(new PlaneGeometry(1, 1).rotateX(Math.PI / 2), 0)])).toBeNull();
  expect(findHead([])).toBeNull();
});

const eyeballs = (): [Piece, Piece] => [piece(new SphereGeometry(0.012, 8, 8), 1.635, 0.032), piece(new SphereGeometry(0.012, 8, 8), 1.635, -0.032)];

/** The head of the figure above, with some room: not its shoulders, not its chest. */
function expectTheHead({ min, max }: Box): void {
  expect(max[1]).toBeGreaterThanOrEqual(1.74);
  expect(max[1]).toBeLessThan(1.85);
  expect(min[1]).toBeGreaterThan(1.42);
  expect(min[1]).toBeLessThan(1.52);
}

test.each([
  ['hair to the waist', piece(new CylinderGeometry(0.1, 0.2, 0.7, 16), 1.39)],
  ['a hat as wide as the shoulders', piece(new CylinderGeometry(0.26, 0.26, 0.01, 24), 1.7)],
])('framedHead_OfAStandingFigureWithEyes_IsAroundThemWhereTheOutlineShowsNoHead: %s', (_, worn) => {
  const figure = [skull(32), neck(), torso(), legs(), worn];
  expect(framedHead(figure)).toBeNull();
  expectTheHead(framedHead(figure, eyeballs())!);
});

test('framedHead_WithEyes_TakesTheOutlineWhereItShowsAHeadAndAllOfABust', () => {
  const figure = [skull(32), neck(), torso(), legs()];
  expect(framedHead(figure, eyeballs())).toEqual(framedHead(figure));
  expect(framedHead([skull(32), neck()], eyeballs())).toBeNull();
});

/** `count` points between a chin at 1.54 and `top`, 0.12 apart from left to right. */
const pointsUpTo = (top: number, count: number): [number, number, number][] =>
  Array.from({ length: count }, (_, i) => [i % 2 === 0 ? -0.06 : 0.06, 1.54 + ((top - 1.54) * i) / (count - 1), 0.1]);

const framed = (radius: number): { height: number; radius: number } => ({ height: 1.645, radius });

test('headOfPoints_FigureWhoseOutlineShowsNoHead_IsAroundThePoints', () => {
  const body = { height: 0.88, radius: 0.88 };
  const head = headOfPoints(pointsUpTo(1.75, 60), body)!;
  expect(head.min[1]).toBeCloseTo(1.54 - 0.08 * 0.21);
  expect(head.max[1]).toBeCloseTo(1.75 + 0.08 * 0.21);
  const face = headOfPoints(pointsUpTo(1.66, 10), body)!;
  expect(face.min[1]).toBeLessThan(1.48);
  expect(face.max[1]).toBeGreaterThan(1.72);
});

test('headOfPoints_FramedHead_StaysAsItIs', () => {
  expect(headOfPoints(pointsUpTo(1.75, 60), framed(0.12))).toBeNull();
  expect(headOfPoints(pointsUpTo(1.66, 10), framed(0.12))).toBeNull();
  // A hat or long hair is a part of the picture.
  expect(headOfPoints(pointsUpTo(1.75, 60), framed(0.17))).toBeNull();
});

test('headOfPoints_FewPointsOrAllInOnePlace_SayNothing', () => {
  expect(headOfPoints(pointsUpTo(1.75, 7), framed(10))).toBeNull();
  expect(headOfPoints(new Array<[number, number, number]>(60).fill([0, 1, 0]), framed(10))).toBeNull();
});

test('headOfPoints_ChinBelowThePicture_IsInIt', () => {
  const head = headOfPoints(pointsUpTo(1.75, 60), { height: 1.7, radius: 0.1 })!;
  expect(head.min[1]).toBeLessThan(1.54);
});
