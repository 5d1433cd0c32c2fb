import { describe, expect, test } from 'vitest';
import { featurePointCount, featurePoints } from '@protocol/generated/mpeg4.ts';
import { featurePointIndex } from '@protocol/rig_document.ts';
import {
  colourRegions,
  influencersOf,
  littleWeight,
  movingPoints,
  paintHeat,
  paintRegions,
  paintStrongest,
  paintUncovered,
  skinVertices,
  strongestPoints,
  type InfluenceRows,
} from '../src/face/influence_map.ts';
import {
  coveredColour,
  heatColour,
  heatStops,
  littleColour,
  regionColours,
  restColour,
  uncoveredColour,
  type Rgb,
} from '../src/face/influence_palette.ts';
import { readingWords } from '../src/ui/influence/influence_model.ts';

/** A table with these rows of [point, weight]. */
function table(rows: [number, number][][]): InfluenceRows {
  const offsets = [0];
  for (const row of rows) offsets.push(offsets.at(-1)! + row.length);
  return {
    vertexCount: rows.length,
    rowOffsets: Uint32Array.from(offsets),
    rowPoints: Uint8Array.from(rows.flat().map(([point]) => point)),
    rowWeights: Float32Array.from(rows.flat().map(([, weight]) => weight)),
  };
}

const pixel = (paint: Uint8Array, v: number): number[] => [...paint.subarray(v * 4, v * 4 + 4)];
const rows = table([[[2, 0.25], [7, 0.75]], [[2, 0.5], [7, 0.5]], [], [[7, 0.3]], [[2, 0]], []]);

describe('influence', () => {
  test('InfluencersOf_ARow_HasTheStrongestFirstAndNoZeros', () => {
    expect(influencersOf(rows, 0)).toEqual([{ point: 7, weight: 0.75 }, { point: 2, weight: 0.25 }]);
    expect(influencersOf(rows, 4)).toEqual([]);
    expect(movingPoints(rows).flatMap((moves, i) => (moves ? [i] : []))).toEqual([2, 7]);
  });

  test('StrongestPoints_TiesAndEmptyRows_GiveTheFirstAndNone', () => {
    expect([...strongestPoints(rows)]).toEqual([7, 2, -1, 7, -1, -1]);
  });

  test('PaintHeat_SeveralPoints_AddsTheirWeights', () => {
    const paint = new Uint8Array(24);
    paintHeat(rows, new Set([7]), paint);
    expect([0, 1, 2, 3].map((v) => pixel(paint, v)[3])).toEqual([191, 128, 0, 77]);
    paintHeat(rows, new Set([2, 7]), paint);
    expect(pixel(paint, 0)).toEqual([...restColour, 255]);
  });

  test('PaintRegions_TwoPointsAtOneVertex_MixByWeight', () => {
    const paint = new Uint8Array(24);
    paintRegions(rows, new Map([[2, 0], [7, 4]]), paint);
    const expected = regionColours[0]!.map((value, i) => Math.floor(0.25 * value + 0.75 * regionColours[4]![i]!));
    for (let i = 0; i < 3; i += 1) expect(Math.abs(paint[i]! - expected[i]!)).toBeLessThanOrEqual(1);
    expect(pixel(paint, 2)).toEqual([...restColour, 0]);
  });

  test('SkinVertices_HairEyesAndTongue_AreNone', () => {
    const indices = Uint32Array.from([0, 1, 2, 3, 4, 5, 6, 6, 6]);
    const groups = [0, 1, 2].map((material) => ({ start: material * 3, count: 3, material }));
    const rigid = Uint8Array.from([0, 1, 5, 0, 0, 0, 0, 0]); // an eye, a lid
    const materials = [
      { name: 'Face', roughness: 0.5, alpha_mode: 'opaque' as const },
      { name: 'Hair', roughness: 0.5, alpha_mode: 'opaque' as const },
      { name: 'Veil', roughness: 0.5, alpha_mode: 'blend' as const },
    ];
    expect([...skinVertices({ vertexCount: 8, indices, groups, rigid }, materials)]).toEqual([1, 0, 1, 0, 0, 0, 0, 0]);
  });

  test('PaintUncovered_NoneAndLittle_AreToldOfSkinOnly', () => {
    const paint = new Uint8Array(24);
    expect(littleWeight).toBeGreaterThan(0.3);
    expect(paintUncovered(rows, Uint8Array.of(1, 1, 1, 1, 1, 0), paint)).toEqual({ vertices: 5, none: 2, little: 1 });
    expect(pixel(paint, 0)).toEqual([...coveredColour, 0]);
    expect(pixel(paint, 2)).toEqual([...uncoveredColour, 255]);
    expect(pixel(paint, 3)).toEqual([...littleColour, 0]);
    expect(pixel(paint, 5)).toEqual([...restColour, 0]); // not skin
  });

  test('ColourRegions_NeighboursDifferAndMirrorPointsMatch', () => {
    // A strip of triangles through the regions of eight points; 8.3 and 8.4 do not touch.
    const ids = ['8.3', '2.2', '2.3', '2.4', '8.4', '2.5', '2.8', '2.9'];
    const strongest = Int16Array.from(ids, (id) => featurePointIndex(id)!);
    const indices = Uint32Array.from(ids.slice(2).flatMap((_, i) => [i, i + 1, i + 2]));
    const colours = colourRegions(strongest, indices);
    expect(colours).toHaveLength(featurePointCount);
    for (let i = 0; i < indices.length; i += 3) {
      const three = [0, 1, 2].map((k) => colours[strongest[indices[i + k]!]!]);
      expect(new Set(three).size).toBe(3);
    }
    expect(colours[featurePointIndex('8.3')!]).toBe(colours[featurePointIndex('8.4')!]);
    const paint = new Uint8Array(ids.length * 4);
    paintStrongest(strongest, colours, paint);
    expect(pixel(paint, 0)).toEqual([...regionColours[colours[strongest[0]!]!]!, 0]);
  });

  test('ColourRegions_MoreNeighboursThanColours_StillColoursEach', () => {
    const count = regionColours.length + 3; // each touches each
    const strongest = Int16Array.from({ length: count }, (_, i) => i);
    const indices: number[] = [];
    for (let a = 0; a < count; a += 1) for (let b = a + 1; b < count; b += 1) indices.push(a, b, a);
    const colours = colourRegions(strongest, Uint32Array.from(indices));
    const used = [...colours.subarray(0, count)];
    expect(Math.max(...used)).toBeLessThan(regionColours.length);
    expect(new Set(used).size).toBe(regionColours.length);
  });

  test('HeatColour_FromLowToHigh_GetsBrighter', () => {
    const brightness = ([r, g, b]: Rgb): number => 0.2126 * r + 0.7152 * g + 0.0722 * b;
    const steps = Array.from({ length: 101 }, (_, i) => brightness(heatColour(i / 100)));
    for (let i = 1; i < steps.length; i += 1) expect(steps[i]!).toBeGreaterThan(steps[i - 1]!);
    expect(heatColour(-1)).toEqual(heatStops[0]);
    expect(heatColour(2)).toEqual(heatStops.at(-1));
  });

  test('ReadingWords_NoneOneAndSeveral_AreSentences', () => {
    const points = [
      { id: '8.3', name: 'Left corner', weight: 0.62 },
      { id: '2.4', name: 'Inner corner', weight: 0.375 },
      { id: '2.1', name: 'Chin', weight: 0.005 },
    ];
    expect(readingWords({ vertex: 4, points: [], total: 0 })).toBe('Vertex 4 follows no feature point.');
    expect(readingWords({ vertex: 4, points: points.slice(0, 1), total: 1 })).toBe('Vertex 4 follows 8.3 Left corner by 62 %.');
    expect(readingWords({ vertex: 4, points, total: 1 })).toBe(
      'Vertex 4 follows 8.3 Left corner by 62 %, 2.4 Inner corner by 38 % and 2.1 Chin by < 1 %.',
    );
    expect(featurePoints).toHaveLength(featurePointCount);
  });
});
