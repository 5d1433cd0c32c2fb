import { expect, test } from 'vitest';
import { dropPlace } from '../src/ui/page/drop_place.ts';

const file = (name: string, text = '{"format":"semblante.performance"}'): File => new File([text], name);

test('Drop_ByTheTab_GoesToTheStreamOrStaysOnThePage', async () => {
  expect(await dropPlace(file('a.json'), 'live')).toBe('stream');
  expect(await dropPlace(file('a.fap'), 'live')).toBe('stream');
  expect(await dropPlace(file('a.JSON'), 'animate')).toBe('page');
  expect(await dropPlace(file('a.FAP'), 'animate')).toBe('page');
  expect(await dropPlace(file('a.json'), 'heads')).toBe('stream');
  expect(await dropPlace(file('a.fap'), 'points')).toBe('page');
  for (const tab of ['heads', 'animate', 'live'] as const) expect(await dropPlace(file('json.glb'), tab)).toBe('heads');
});

test('Drop_FeaturePoints_AreThemOnEveryTab', async () => {
  for (const tab of ['heads', 'fit', 'points', 'animate', 'live'] as const)
    expect(await dropPlace(file('ana.json', '{"points":{"2.1":{"vertex":12}}}'), tab)).toBe('points');
  // What cannot be read, or is something else, goes where a performance goes, which says what is wrong.
  for (const text of ['{"points"', '"points"', 'null', '["points"]']) expect(await dropPlace(file('a.json', text), 'animate')).toBe('page');
  const large = new File([`{"points":{}${' '.repeat(1 << 20)}}`], 'large.json');
  expect(await dropPlace(large, 'points')).toBe('stream');
});

test('Drop_Sound_GoesToTheSpeakPanel_WhateverTabIsOpen', async () => {
  for (const name of ['a.wav', 'a.MP3', 'my voice.opus']) expect(await dropPlace(file(name), 'live')).toBe('speech');
});
