import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { acceptedFiles, anyFormat, mediaTypeOf, modelFormats } from '../src/net/model_formats.ts';

const sourceOf = (path: string): string => readFileSync(new URL(`../../${path}`, import.meta.url), 'utf8');
/** The string literals of the C++ text from `start` up to `end`. */
const literals = (text: string, start: string, end: string): string[] => {
  const from = text.indexOf(start);
  expect(from, `${start} is gone: mend this test`).toBeGreaterThan(0);
  return [...text.slice(from, text.indexOf(end, from)).matchAll(/"([^"]+)"/g)].map(([, literal]) => literal!);
};

test('ModelFormats_Extensions_AreThoseTheServerReads', () => {
  const read = literals(sourceOf('core/import/import.cpp'), 'format_of_name(std::string_view name) {', '\n}');
  expect(read.length).toBeGreaterThan(5);
  expect(modelFormats.map(({ extension }) => extension).sort()).toEqual(read.sort());
});

test('ModelFormats_MediaTypes_AreTakenByTheServer', () => {
  const taken = literals(sourceOf('server/api/api.cpp'), 'auto uploads = ', ';');
  for (const { mediaType } of modelFormats) expect(taken).toContain(mediaType);
});

test('MediaTypeOf_NamesInAnyCase_GoByTheExtension', () => {
  expect(mediaTypeOf('Ana.of.1.VRM')).toBe('model/gltf-binary');
  expect(mediaTypeOf('head.Ply')).toBe('model/ply');
  expect(mediaTypeOf('head.fbx')).toBe('application/octet-stream');
  expect(mediaTypeOf('head')).toBe('application/octet-stream');
});

test('ModelFormats_ForPeopleAndTheFileChooser_NameEach', () => {
  expect(acceptedFiles.split(',')).toContain('.vrm');
  expect(anyFormat).toBe('GLB, VRM, glTF, OBJ, PLY, STL or ZIP');
});
