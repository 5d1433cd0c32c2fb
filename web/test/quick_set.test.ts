import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, test } from 'vitest';
import { leastKnownPoints, quickSet } from '../src/face/quick_set.ts';

test('QuickSet_EachPoint_HasASentence', () => {
  for (const { id, hint } of quickSet) expect(hint, id).toMatch(/^[A-Z].*\.$/);
});

const header = readFileSync(fileURLToPath(new URL('../../core/propose/propose.h', import.meta.url)), 'utf8');

test('LeastKnownPoints_OfTheStudio_AreThoseOfTheCore', () => {
  expect(Number(/least_known_points = (\d+)/.exec(header)![1])).toBe(leastKnownPoints);
});
