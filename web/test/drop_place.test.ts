import { expect, test } from 'vitest';
import { dropPlace } from '../src/ui/page/drop_place.ts';

test('Drop_ByTheTab_GoesToTheStreamOrStaysOnThePage', () => {
  expect(dropPlace('a.json', 'live')).toBe('stream');
  expect(dropPlace('a.fap', 'live')).toBe('stream');
  expect(dropPlace('a.JSON', 'animate')).toBe('page');
  expect(dropPlace('a.FAP', 'animate')).toBe('page');
  expect(dropPlace('a.json', 'heads')).toBe('stream');
  expect(dropPlace('a.fap', 'points')).toBe('page');
  for (const tab of ['heads', 'animate', 'live'] as const) expect(dropPlace('json.glb', tab)).toBe('heads');
});
