import { expect, test } from 'vitest';
import { visemes } from '@protocol/generated/mpeg4.ts';
import { placeOf, visemePlaces, visemesAt } from '../src/face/viseme_plane.ts';

test('Plane_HasEachVisemeOnce_ApartFromTheOthersAndInside', () => {
  expect(visemePlaces).toHaveLength(visemes.length);
  for (const [i, a] of visemePlaces.entries()) {
    expect(Math.min(...a)).toBeGreaterThan(0);
    expect(Math.max(...a)).toBeLessThan(1);
    for (const b of visemePlaces.slice(i + 1)) expect(Math.hypot(a[0] - b[0], a[1] - b[1])).toBeGreaterThan(0.15);
  }
});

test('Plane_AtAViseme_IsItAlone_AndBetweenTwo_BothAlike', () => {
  for (const [viseme, place] of visemePlaces.entries()) expect(visemesAt(place)).toMatchObject({ first: viseme, share: 1 });
  const [e, i] = [visemePlaces[11]!, visemePlaces[12]!];
  const half = visemesAt([(e[0] + i[0]) / 2, (e[1] + i[1]) / 2]);
  expect(new Set([half.first, half.second])).toEqual(new Set([11, 12]));
  expect(half.share).toBeCloseTo(0.5);
});

test('Plane_PlaceOfABlend_GivesTheBlendBack', () => {
  for (const share of [0.55, 0.7, 0.9, 1]) {
    const { first, second, share: back } = visemesAt(placeOf(11, 12, share));
    expect([first, second]).toEqual([11, share === 1 ? second : 12]);
    expect(back).toBeCloseTo(share);
  }
});
