import { expect, test } from 'vitest';
import { placeLoupe } from '../src/ui/page/loupe_place.ts';

test('Loupe_AnyPlaceOfTheFinger_IsInThePictureAndNotUnderTheFinger', () => {
  const at = { x: 0, y: 0 };
  const radius = 62;
  const wrong: string[] = [];
  for (const [width, height] of [[390, 330], [880, 560], [1440, 900]] as const)
    for (const gap of [20, 44])
      for (let x = 0; x <= width; x += 10)
        for (let y = 0; y <= height; y += 10) {
          placeLoupe({ x, y }, width, height, radius, gap, at);
          const inside = at.x >= radius && at.x <= width - radius && at.y >= radius && at.y <= height - radius;
          if (!inside || Math.hypot(at.x - x, at.y - y) < radius + gap) wrong.push(`${x}, ${y} of ${width} x ${height}`);
        }
  expect(wrong).toEqual([]);
});

test('Loupe_WithRoomAbove_IsAboveTheFinger', () => {
  const at = { x: 0, y: 0 };
  placeLoupe({ x: 200, y: 300 }, 390, 400, 60, 40, at);
  expect(at).toEqual({ x: 200, y: 200 });
});
