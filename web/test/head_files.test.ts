import { unzipSync } from 'fflate';
import { expect, test } from 'vitest';
import { headUploads, type PathFile } from '../src/net/head_files.ts';

const named = (path: string): PathFile => ({ path, file: new File([`content of ${path}`], path.slice(path.lastIndexOf('/') + 1)) });

async function uploads(...paths: string[]): Promise<Record<string, string[] | 'as it is'>> {
  const result: Record<string, string[] | 'as it is'> = {};
  for (const file of await headUploads(paths.map(named))) {
    if (!file.name.endsWith('.zip')) {
      result[file.name] = 'as it is';
      continue;
    }
    const entries = unzipSync(new Uint8Array(await file.arrayBuffer()));
    for (const [path, bytes] of Object.entries(entries)) expect(new TextDecoder().decode(bytes)).toBe(`content of ${path}`);
    result[file.name] = Object.keys(entries);
  }
  return result;
}

test('a model alone is sent as it is', async () => {
  expect(await uploads('ana.glb')).toEqual({ 'ana.glb': 'as it is' });
  expect(await uploads('ana.obj')).toEqual({ 'ana.obj': 'as it is' });
  expect(await uploads('ana/ana.glb', 'ana/skin.png', 'ana/LICENSE.txt')).toEqual({ 'ana.glb': 'as it is' });
});

test('a glTF or OBJ takes its files along, wherever they lie', async () => {
  expect(await uploads('head.gltf', 'head.bin', 'skin.png')).toEqual({ 'head.zip': ['head.gltf', 'head.bin', 'skin.png'] });
  expect(await uploads('ana/source/head.OBJ', 'ana/source/head.mtl', 'ana/textures/skin.JPG')).toEqual({
    'head.zip': ['ana/source/head.OBJ', 'ana/source/head.mtl', 'ana/textures/skin.JPG'],
  });
});

test('of several models each takes what lies beside it, and those that need nothing stay alone', async () => {
  expect(await uploads('a/a.gltf', 'a/a.bin', 'b/b.gltf', 'b/maps/b.png', 'c/c.obj', 'd.glb')).toEqual({
    'a.zip': ['a/a.gltf', 'a/a.bin'],
    'b.zip': ['b/b.gltf', 'b/maps/b.png'],
    'c.obj': 'as it is',
    'd.glb': 'as it is',
  });
});

test('without a model by name the server decides by content', async () => {
  expect(await uploads('skin.png')).toEqual({ 'skin.png': 'as it is' });
  expect(await uploads('scan.dat')).toEqual({ 'scan.dat': 'as it is' });
});
