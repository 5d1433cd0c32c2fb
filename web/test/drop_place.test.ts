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

test('a sound goes to the Speak panel, whatever tab is open', () => {
  for (const name of ['a.wav', 'a.MP3', 'my voice.opus']) expect(dropPlace(name, 'live')).toBe('speech');
});
