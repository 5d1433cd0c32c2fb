import { expect, test } from 'vitest';
import type { Tab } from '../src/ui/shared/studio.ts';
import { dropPlace, kindOfFile, type DroppedKind } from '../src/ui/page/drop_place.ts';

const performance = '{"format":"semblante.performance"}';
const fap = '# a take\n2.1 hello.fap 25 2\n0 0 1\n';
const file = (name: string, text: string): File => new File([text], name);

test('Drop_ByTheTab_GoesToTheStreamOrStaysOnThePage', () => {
  const tabs: Tab[] = ['heads', 'fit', 'points', 'animate', 'live'];
  const places = (kind: DroppedKind): string[] => tabs.map((tab) => dropPlace(kind, tab));
  expect(places('performance')).toEqual(['stream', 'stream', 'stream', 'page', 'stream']);
  expect(places('fap')).toEqual(['page', 'page', 'page', 'page', 'stream']);
  for (const [kind, place] of [['points', 'points'], ['sound', 'speech'], ['head', 'heads']] as const) expect(new Set(places(kind))).toEqual(new Set([place]));
});

test.each<[DroppedKind, string]>([
  ['performance', performance],
  ['performance', ` {"version":1,"format" : "semblante.performance"}`],
  ['fap', fap],
  ['fap', '2.1 with-windows-lines 30 1\r\n0 0 1\r\n'],
  ['points', '{"points":{"2.1":{"vertex":12}}}'],
  ['points', '\uFEFF{"points":{}}'],
  ['sound', 'RIFF\u0001\u0002\u0003\u0004WAVEfmt '],
  ['sound', 'OggS\u0000'],
])('Kind_IsThatOfTheContent_WhateverTheName: %s %#', async (kind, text) => {
  for (const name of ['a.json', 'a.fap', 'a.wav', 'a.glb', 'a.txt', 'a']) expect(await kindOfFile(file(name, text)), name).toBe(kind);
});

test('Kind_OfAModel_IsAHead', async () => {
  expect(await kindOfFile(file('a.glb', 'glTF\u0002'))).toBe('head');
  expect(await kindOfFile(file('a.gltf', '{"asset":{"version":"2.0"}}'))).toBe('head');
  expect(await kindOfFile(file('a.obj', '# 8 points\nv 0 0 1\nv 2.1 3 25 2\n'))).toBe('head');
  expect(await kindOfFile(file('a.ply', 'ply\nformat ascii 1.0\n'))).toBe('head');
  expect(await kindOfFile(file('a.stl', 'solid 1\n'))).toBe('head');
});

test('Kind_OfWhatTellsNothing_GoesByItsName', async () => {
  for (const text of ['{"points"', '"points"', 'null', '["points"]', '']) expect(await kindOfFile(file('a.JSON', text))).toBe('performance');
  expect(await kindOfFile(file('a.FAP', 'rubbish'))).toBe('fap');
  for (const name of ['a.wav', 'a.MP3', 'my voice.opus']) expect(await kindOfFile(file(name, ''))).toBe('sound');
  const large = new File([`{"points":{}${' '.repeat(1 << 20)}}`], 'large.json');
  expect(await kindOfFile(large)).toBe('performance');
});
