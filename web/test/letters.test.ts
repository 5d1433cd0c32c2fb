import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { preprocessCSS, resolveConfig, type ResolvedConfig } from 'vite';
import { beforeAll, expect, test } from 'vitest';
import { rem } from '../src/ui/shared/rem.ts';

const here = (path: string): string => fileURLToPath(new URL(path, import.meta.url));
const built = async (config: ResolvedConfig, path: string): Promise<string> => (await preprocessCSS(readFileSync(path, 'utf8'), path, config)).code;

let studio: string;
let view: string;
beforeAll(async () => {
  const [ofStudio, ofView] = await Promise.all(['../vite.config.ts', '../vite.view.config.ts'].map((file) => resolveConfig({ configFile: here(file) }, 'build')));
  studio = await built(ofStudio!, here('../src/ui/styles/index.css'));
  view = await built(ofView!, here('../view/view.css'));
});

test('StyleSheets_OfBothPages_HaveNoLengthThatIgnoresTheLettersOfTheBrowser', () => {
  for (const css of [studio, view]) expect(css.match(/.*\dpx\b.*/g)).toBeNull();
});

test('StyleSheets_AtLettersOfTheUsualSize_KeepTheirPixels', () => {
  const body = /\nbody \{[^}]*font: ([\d.]+)rem/.exec(studio)!;
  expect(Number(body[1]) * 16).toBe(14);
  expect(studio).toContain('translate: 1rem 0');
  expect(studio).toContain('vertical-align: -0.1875rem');
});

test('Layout_ChangesInScriptsAndStyleSheetsAtTheSameWidths', () => {
  for (const name of ['page/layout.ts', 'heads/shelf.ts']) {
    const [, side, pixels] = /matchMedia\(`\(max-(\w+): \$\{rem\((\d+)\)\}\)`\)/.exec(readFileSync(here(`../src/ui/${name}`), 'utf8'))!;
    expect(studio).toContain(`(max-${side}: ${rem(Number(pixels))})`);
  }
});
