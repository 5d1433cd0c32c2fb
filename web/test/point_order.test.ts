import { expect, test } from 'vitest';
import { featurePoints } from '@protocol/generated/mpeg4.ts';
import { quickSet } from '../src/face/quick_set.ts';
import type { PlacedPoint } from '../src/face/point_draft.ts';
import { nextPoint, nextProposed, quickLeft } from '../src/ui/points/point_order.ts';

const placed: PlacedPoint = { vertex: 1, position: [0, 0, 0] };
const proposed: PlacedPoint = { ...placed, proposal: { method: null, confidence: 'high', expectedError: null } };
const quick = quickSet.map(({ id }) => id);
const all = featurePoints.map(({ id }) => id);

test('Order_Guided_LeadsThroughTheQuickSetAndBeginsAgain', () => {
  expect(nextPoint(new Map(), null, true)).toBe(quick[0]);
  expect(nextPoint(new Map(), quick[3]!, true)).toBe(quick[4]);
  expect(nextPoint(new Map([[quick[4]!, placed]]), quick[3]!, true)).toBe(quick[5]);
  expect(nextPoint(new Map(), quick.at(-1)!, true)).toBe(quick[0]);
  expect(quickLeft(new Map([[quick[4]!, placed]]))).toBe(quick.length - 1);
});

test('Order_AllPlaced_LeadsThroughTheProposals', () => {
  const points = new Map(all.map((id, i) => [id, i === 7 || i === 9 ? proposed : placed]));
  expect(nextPoint(points, null, false)).toBe(all[7]);
  expect(nextPoint(points, all[7]!, true)).toBe(all[9]);
  expect(nextProposed(points, all[9]!)).toBe(all[7]);
  expect(nextProposed(new Map([[all[0]!, placed]]), null)).toBeNull();
});
