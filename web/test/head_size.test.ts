import { expect, test } from 'vitest';
import { sizeWords } from '../src/ui/head_size.ts';
import { importingModel } from './support/models.ts';

test('SizeWords_WhileImporting_GiveTheBytesOfTheFile', () => {
  expect(sizeWords(importingModel())).toBe('2.0 MB');
});

test('SizeWords_AfterTheImport_GiveTheVertices', () => {
  const counts = { vertices: 26_719, triangles: 53_000, parts: 3 };
  expect(sizeWords(importingModel({ state: 'ready', counts }))).toBe('26,719 vertices');
});
