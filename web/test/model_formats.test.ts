import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { headFileEndings } from '../src/net/head_files.ts';
import { anyFormat, mediaTypeOf, modelFormats } from '../src/net/model_formats.ts';

test('ModelFormats_AreTheTableOfTheServer', () => {
  const source = readFileSync(new URL('../../core/import/model_formats.h', import.meta.url), 'utf8');
  const constants = { glb_media_type: /glb_media_type = "([^"]+)"/.exec(source)?.[1] };
  const rows = [...source.matchAll(/\{"(\.\w+)", ModelFormat::\w+, (?:"([^"]+)"|(\w+)), "([^"]+)"\}/g)];
  const table = rows.map(([, extension, literal, name, title]) => ({
    extension,
    mediaType: literal ?? constants[name as keyof typeof constants],
    title,
  }));
  expect(table.length, 'the table has another shape: mend this test').toBeGreaterThan(5);
  expect(modelFormats).toEqual(table);
});

test('MediaTypeOf_NamesInAnyCase_GoByTheExtension', () => {
  expect(mediaTypeOf('Ana.of.1.VRM')).toBe('model/gltf-binary');
  expect(mediaTypeOf('head.Ply')).toBe('model/ply');
  expect(mediaTypeOf('head.fbx')).toBe('application/octet-stream');
  expect(mediaTypeOf('head')).toBe('application/octet-stream');
});

test('ModelFormats_ForPeopleAndTheFileChooser_NameEach', () => {
  expect(headFileEndings.split(',')).toContain('.vrm');
  expect(anyFormat).toBe('GLB, VRM, glTF, OBJ, PLY, STL, or ZIP');
});
