import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, relative, sep } from 'node:path';
import { fileURLToPath } from 'node:url';
import { expect, test } from 'vitest';

const src = fileURLToPath(new URL('../src', import.meta.url));

/** Which folders each may import from, beside itself: as src/README.md has it. */
const common = ['ui/documents', 'ui/stage', 'ui/shared'];
const mayUse: Record<string, readonly string[]> = {
  net: [],
  face: [],
  view: ['face'],
  'ui/shared': [],
  'ui/stage': ['ui/shared'],
  'ui/documents': ['ui/shared'],
  'ui/heads': common,
  'ui/points': common,
  'ui/fit': [...common, 'ui/points'],
  'ui/animate': [...common, 'ui/fit'],
  'ui/live': common,
  'ui/recordings': [...common, 'ui/live'],
  'ui/page': [...common, 'ui/heads', 'ui/points', 'ui/fit', 'ui/animate', 'ui/live', 'ui/recordings'],
};

/** "ui/points" of src/ui/points/guide.ts, "net" of src/net/api.ts. */
const folderOf = (path: string): string => {
  const [first = '', second = ''] = relative(src, path).split(sep);
  return first === 'ui' ? `ui/${second}` : first;
};

const files = readdirSync(src, { recursive: true, encoding: 'utf8' }).filter(
  (path) => path.endsWith('.ts') && path.includes(sep),
);

test.each(files)('Imports_Of %s_PointDown', (path) => {
  const file = join(src, path);
  const folder = folderOf(file);
  const text = readFileSync(file, 'utf8');
  const specifiers = [...text.matchAll(/\b(?:from|import) '([^']+)'/g)].map(([, specifier]) => specifier!);
  const used = specifiers.filter((one) => one.startsWith('.')).map((one) => folderOf(join(dirname(file), one)));
  const below = folder.startsWith('ui/') ? ['net', 'face', 'view'] : [];
  const allowed = [folder, ...below, ...(mayUse[folder] ?? [])];
  expect(used.filter((one) => !allowed.includes(one))).toEqual([]);
  if (folder === 'net' || folder === 'face') expect(specifiers.filter((one) => one.startsWith('three'))).toEqual([]);
});
