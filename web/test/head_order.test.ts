import { expect, test } from 'vitest';
import { listed } from '../src/ui/heads/head_order.ts';
import { importingModel } from './support/models.ts';

const heads = [
  importingModel({ id: 'sample', name: 'Sample head', created: '2026-01-01T00:00:00Z' }),
  importingModel({ id: 'jose', name: 'José, o avô', created: '2026-01-02T00:00:00Z' }),
  importingModel({ id: 'new', name: 'Monkey head', created: '2026-01-03T00:00:00Z' }),
];
const names = (words: string): string[] => listed(heads, words).map(({ id }) => id);

test('Listed_WithoutWords_TheNewestFirst', () => {
  expect(names(' ')).toEqual(['new', 'jose', 'sample']);
});

test('Listed_Words_AreFoundInAnyOrderWithoutCaseAndAccents', () => {
  expect(names('HEAD mon')).toEqual(['new']);
  expect(names('avo jose')).toEqual(['jose']);
  expect(names('nobody')).toEqual([]);
});
