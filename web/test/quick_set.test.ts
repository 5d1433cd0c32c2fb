import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, test } from 'vitest';
import { leastKnownPoints, quickSet } from '../src/face/quick_set.ts';
import { pointById } from '../src/face/feature_points.ts';

const core = (name: string): string =>
  readFileSync(fileURLToPath(new URL(`../../core/propose/${name}`, import.meta.url)), 'utf8');

test('QuickSet_OfTheStudio_IsThatOfTheCore', () => {
  const list = /quick_set = \{([^}]*)\}/.exec(core('quick_set.h'))![1]!;
  expect(quickSet.map(({ id }) => id)).toEqual([...list.matchAll(/"([\d.]+)"/g)].map((match) => match[1]));
  for (const { id, hint } of quickSet) {
    expect(pointById(id), id).toBeDefined();
    expect(hint).toMatch(/\.$/);
  }
});

test('LeastKnownPoints_OfTheStudio_AreThoseOfTheCore', () => {
  expect(Number(/least_known_points = (\d+)/.exec(core('propose.h'))![1])).toBe(leastKnownPoints);
});
