import { expect, test } from 'vitest';
import { headSize } from '../src/ui/heads/head_size.ts';
import { importingModel } from './support/models.ts';

test('HeadSize_WhileImporting_GiveTheBytesOfTheFile', () => {
  expect(headSize(importingModel())).toBe('2.0 MB');
});

test('HeadSize_AfterTheImport_GiveTheVertices', () => {
  const counts = { vertices: 26_719, triangles: 53_000, parts: 3 };
  expect(headSize(importingModel({ state: 'ready', counts }))).toBe('26,719 vertices');
});
