import { expect, test } from 'vitest';
import { pointById } from '../src/face/feature_points.ts';
import { sideOf } from '../src/ui/page/point_flight.ts';

test('SideOf_PointsOfOneSide_AreSeenFromThere_AndTheirMirrorPointsFromTheOther', () => {
  for (const id of ['10.1', '10.3', '10.5', '2.13']) {
    expect(sideOf(id), id).toBe('left');
    expect(sideOf(pointById(id)!.mirror!), id).toBe('right');
  }
  expect(['2.1', '8.3', '3.7', '11.4', '5.1'].map(sideOf)).toEqual(['front', 'front', 'front', 'front', 'front']);
  expect(sideOf('11.6')).toBe('left');
});
