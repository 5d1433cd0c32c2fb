/** A box in model units, y up. */
export interface Box {
  min: [number, number, number];
  max: [number, number, number];
}

/** A mesh: x, y, z per vertex, and three vertices per triangle. */
export interface Piece {
  positions: ArrayLike<number>;
  triangles: ArrayLike<number>;
}

/** Slices of the height that the outline is measured in. */
const slices = 200;
/** The neck: this much narrower than the head above it. */
const neckOfHead = 0.85;
/** A neck hardly narrower than the head may be a part of the face, above the mouth: such a head ends at the foot of it. */
const thickNeck = 0.75;
const aboutAsNarrow = 1.03;
/** The shoulders: this much wider than the head above them; hair down to the shoulders hides a neck. */
const shouldersOfHead = 1.45;
/** Height of a head with its neck, in widths of the head: outside of this range what was found is no head. */
const leastHeight = 0.7;
const mostHeight = 2.6;
/** The least share of a figure's height that is a head. */
const leastShare = 0.07;

/**
 * The head of a body, a bust or a scan, found by the outline from in front: from the top down to where it becomes as wide as
 * shoulders. Null when there are no shoulders: all of it is the head, or it does not
 * stand upright.
 */
export function findHead(pieces: readonly Piece[]): Box | null {
  const all = boxOf(pieces, -Infinity);
  const [bottom, top] = [all.min[1], all.max[1]];
  const height = top - bottom;
  if (!(height > 0)) return null;

  const widths = outline(pieces, top, height);
  let head = 0; // the greatest width so far
  let neck = -1; // the narrowest slice below it
  let neckWidth = Infinity;
  let foot = -1; // the lowest slice that is about as narrow as the neck
  for (let slice = 0; slice < slices; slice += 1) {
    const width = widths[slice]!;
    if (width === 0) continue;
    const fromTop = ((slice + 1) / slices) * height;
    const isLikeAHead = head > 0 && fromTop >= leastHeight * head;
    // Every top of a head widens fast: without a neck above them, shoulders lie as low as a head is tall.
    const areShoulders =
      neck >= 0
        ? width > (shouldersOfHead * neckWidth) / neckOfHead
        : width > shouldersOfHead * head && fromTop >= (leastHeight * width) / shouldersOfHead;
    if (isLikeAHead && areShoulders) {
      if (fromTop > mostHeight * head) return null;
      const cut = neck < 0 ? slice : (neckWidth > thickNeck * head ? foot : neck) + 1;
      const end = top - (cut / slices) * height;
      if (top - end >= leastShare * height) {
        const box = boxOf(pieces, end);
        box.min[1] = end; // where the mesh is coarse, its lowest vertex above the cut is far away
        return box;
      }
      // A bun, a horn or a hat's tip: the head is below.
      neck = -1;
      neckWidth = Infinity;
    }
    if (isLikeAHead && width < neckOfHead * head && width <= neckWidth) {
      neck = slice;
      neckWidth = width;
    }
    if (neck >= 0 && width <= neckWidth * aboutAsNarrow) foot = slice;
    if (neck < 0) head = Math.max(head, width);
  }
  return null;
}

/** Room below the chin, as a share of the head's height. */
const belowChin = 0.08;

/** A head with its chin is at least so many times as high as it is wide; a collar may rise above the chin of a bent head. */
const leastFramed = 1.35;

/**
 * The head as the camera shows it, with its chin and room below it; null where all of it is the head. `eyeballs`: the meshes of both
 * eyes, where the model has them apart from its skin.
 */
export function framedHead(pieces: readonly Piece[], eyeballs: readonly [Piece, Piece] | null = null): Box | null {
  const found = findHead(pieces);
  const eyes = eyeballs?.map((ball) => boxOf([ball], -Infinity)) as [Box, Box] | undefined;
  if (eyes && !(found && eyes.every((eye) => middleOf(eye, 1) > found.min[1]))) return headOfEyes(eyes, boxOf(pieces, -Infinity));
  if (!found) return null;
  const { min, max } = found;
  const height = Math.max(max[1] - min[1], leastFramed * (max[0] - min[0]));
  min[1] = max[1] - height * (1 + belowChin);
  return found;
}

/** What a head with its hair needs around the middle of its eyes, in distances of the eyes. */
const aroundEyes = { side: 1.3, up: 1.8, down: 2, forward: 0.4, back: 1.6 };
/** The least distance of the eyes in diameters of an eyeball: a drawn figure has large eyes near to each other. */
const leastApart = 2.5;
/** A figure that is at most so many times as tall as the head by its eyes is a head or a bust, and seen whole. */
const mostOfAHead = 2;

/**
 * The head of a figure whose outline does not show it, because hair hides the neck or a hat is as wide as the shoulders: around its eyes,
 * as large as a person's. Null where that is about all of it.
 */
export function headOfEyes(eyes: readonly [Box, Box], all: Box): Box | null {
  const sizes = eyes.map(({ min, max }) => max[1] - min[1]);
  const apart = Math.hypot(...([0, 1, 2] as const).map((axis) => middleOf(eyes[0], axis) - middleOf(eyes[1], axis)));
  const unit = Math.max(apart, leastApart * Math.max(...sizes));
  const height = (aroundEyes.up + aroundEyes.down) * unit;
  if (!(height > 0) || all.max[1] - all.min[1] <= mostOfAHead * height) return null;
  const [x, y, z] = ([0, 1, 2] as const).map((axis) => (middleOf(eyes[0], axis) + middleOf(eyes[1], axis)) / 2) as [number, number, number];
  return {
    min: [x - aroundEyes.side * unit, y - aroundEyes.down * unit, z - aroundEyes.back * unit],
    max: [x + aroundEyes.side * unit, y + aroundEyes.up * unit, z + aroundEyes.forward * unit],
  };
}

function middleOf({ min, max }: Box, axis: 0 | 1 | 2): number {
  return (min[axis] + max[axis]) / 2;
}

/** Feature points from which on they reach from the chin to the top of the skull; fewer lie between brows and chin. */
const pointsOfSkull = 40;
/** Fewer points than these say nothing about the size of the head. */
const fewestPoints = 8;
/** What is framed may be so many times as large as the feature points: more is a body whose head the outline did not show. */
const roomAround = { skull: 1.8, face: 3 };
/** Room around the feature points, as a share of their height. */
const aroundPoints = { skull: 0.08, face: 0.6 };

/**
 * The head by its feature points, where what is framed (its height, and half its size: `radius`) is much larger than a head around them
 * or does not have them all in it; else null.
 */
export function headOfPoints(
  points: readonly (readonly [number, number, number])[],
  { height: middle, radius }: { height: number; radius: number },
): Box | null {
  if (points.length < fewestPoints) return null;
  const box = boxOf([{ positions: points.flat(), triangles: [] }], -Infinity);
  const kind = points.length >= pointsOfSkull ? 'skull' : 'face';
  const height = box.max[1] - box.min[1];
  const half = Math.max(height, box.max[0] - box.min[0]) / 2;
  const isSeen = box.min[1] >= middle - radius && box.max[1] <= middle + radius;
  if (!(half > 0) || (isSeen && radius <= half * roomAround[kind])) return null;
  for (let axis = 0; axis < 2; axis += 1) {
    box.min[axis] = box.min[axis]! - height * aroundPoints[kind];
    box.max[axis] = box.max[axis]! + height * aroundPoints[kind];
  }
  return box;
}

/** The width from in front in every slice, from the top down; 0 where there is nothing. */
function outline(pieces: readonly Piece[], top: number, height: number): Float64Array {
  const left = new Float64Array(slices).fill(Infinity);
  const right = new Float64Array(slices).fill(-Infinity);
  const extend = (slice: number, x: number): void => {
    left[slice] = Math.min(left[slice]!, x);
    right[slice] = Math.max(right[slice]!, x);
  };
  // Along the edges: a triangle may be taller than many slices.
  for (const { positions, triangles } of pieces) {
    for (let i = 0; i < triangles.length; i += 1) {
      const from = triangles[i]! * 3;
      const to = triangles[i % 3 === 2 ? i - 2 : i + 1]! * 3;
      const [start, end] = [from, to].map((at) => ((top - positions[at + 1]!) / height) * slices) as [number, number];
      const last = Math.min(slices - 1, Math.floor(Math.max(start, end)));
      for (let slice = Math.max(0, Math.floor(Math.min(start, end))); slice <= last; slice += 1) {
        const along = start === end ? 0 : Math.min(1, Math.max(0, (slice + 0.5 - start) / (end - start)));
        extend(slice, positions[from]! + (positions[to]! - positions[from]!) * along);
      }
    }
  }
  return left.map((x, slice) => Math.max(0, right[slice]! - x));
}

/** The box of the vertices at or above a height. */
function boxOf(pieces: readonly Piece[], least: number): Box {
  const box: Box = { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };
  for (const { positions } of pieces) {
    for (let i = 0; i + 2 < positions.length; i += 3) {
      if (positions[i + 1]! < least) continue;
      for (let axis = 0; axis < 3; axis += 1) {
        box.min[axis] = Math.min(box.min[axis]!, positions[i + axis]!);
        box.max[axis] = Math.max(box.max[axis]!, positions[i + axis]!);
      }
    }
  }
  return box;
}
