/** A place on the plane of mouth shapes: x from round to spread lips, y from a shut to an open mouth, 0 to 1. */
export type Place = readonly [x: number, y: number];

/** The places of the visemes by number; 0 is silence. Those that a mouth passes between are neighbours. */
export const visemePlaces: readonly Place[] = [
  [0.5, 0.13], // silence
  [0.27, 0.13], // p b m
  [0.75, 0.14], // f v
  [0.42, 0.34], // th
  [0.63, 0.34], // t d
  [0.37, 0.55], // k g
  [0.07, 0.47], // ch sh
  [0.88, 0.3], // s z
  [0.57, 0.53], // n l
  [0.16, 0.29], // r
  [0.58, 0.87], // a: car
  [0.82, 0.74], // e: bed
  [0.93, 0.52], // i: tip
  [0.3, 0.84], // o: top
  [0.08, 0.7], // u: book
];

/** The two visemes nearest to a place, and the share of the first (the nearest), 0.5 to 1; the closer of two places counts more. */
export function visemesAt([x, y]: Place): { first: number; second: number; share: number } {
  const squares = visemePlaces.map(([px, py]) => (x - px) ** 2 + (y - py) ** 2);
  const order = squares.map((_, viseme) => viseme).sort((a, b) => squares[a]! - squares[b]!);
  const [first, second] = [order[0]!, order[1]!];
  return { first, second, share: squares[second]! / (squares[first]! + squares[second]!) };
}

/** Where a blend of two visemes lies: between their places. */
export function placeOf(first: number, second: number, share: number): Place {
  const [a, b] = [visemePlaces[first]!, visemePlaces[second]!];
  // The share goes with the squares of the distances.
  const [ofFirst, ofSecond] = [share, 1 - share].map((part) => Math.sqrt(Math.max(0, part))) as [number, number];
  const along = ofSecond / (ofFirst + ofSecond);
  return [a[0] + (b[0] - a[0]) * along, a[1] + (b[1] - a[1]) * along];
}
