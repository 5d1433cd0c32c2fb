import { describe, expect, test } from 'vitest';
import { featurePoints } from '@protocol/generated/mpeg4.ts';
import { middleOf, pairOf, partnerOf } from '../src/face/mirror_points.ts';
import type { PlacedPoint } from '../src/face/point_draft.ts';

const at = (x: number): PlacedPoint => ({ vertex: 0, position: [x, 0, 0] });

describe('mirror points', () => {
  test('Partner_OfEveryPoint_IsMutualAndOfTheSamePair', () => {
    for (const { id, side } of featurePoints) {
      const partner = partnerOf(id);
      expect(partner === null, id).toBe(side === 'center');
      if (partner === null) continue;
      expect(partnerOf(partner), id).toBe(id);
      expect(pairOf(partner), id).toBe(pairOf(id));
    }
  });

  test('Middle_OfPlacedPoints_IsTheMeanOfThoseBetweenTheSides', () => {
    expect(middleOf(new Map())).toBe(0);
    expect(middleOf(new Map([['2.1', at(1)], ['9.3', at(2)], ['8.3', at(90)]]))).toBe(1.5);
  });
});
