import { expect, test } from 'vitest';
import { discShare } from '../src/view/markers.ts';

test('DiscShare_ManyOnASmallFace_ShrinksToALimit', () => {
  expect(discShare(84, 700)).toBe(1);
  expect(discShare(84, 260)).toBeCloseTo(0.788, 3);
  expect(discShare(84, 100)).toBe(0.6);
  // A few on one place of the skin, as of a finding.
  expect(discShare(2, 5)).toBe(1);
});
