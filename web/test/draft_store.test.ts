import { describe, expect, test } from 'vitest';
import { PointDraft, type PlacedPoint } from '../src/face/point_draft.ts';
import { DraftStore } from '../src/ui/points/draft_store.ts';
import { memory } from './support/memory.ts';

const at = (vertex: number): PlacedPoint => ({ vertex, position: [vertex, 0, 0] });

describe('draft store', () => {
  test('Drafts_ChangesOfTwoHeads_AreKeptApart', () => {
    const storage = memory();
    const store = new DraftStore(storage);
    store.keep('a', 'y', new Map([['2.1', at(1)]]));
    store.keep('b', 'y', new Map([['8.1', null]]));
    expect(new DraftStore(storage).read('a', 'y')).toEqual(new Map([['2.1', at(1)]]));
    expect(new DraftStore(storage).read('b', 'y')).toEqual(new Map([['8.1', null]]));
  });

  test('Drafts_NoChanges_LeaveNothingInTheStorage', () => {
    const storage = memory();
    const store = new DraftStore(storage);
    store.keep('a', 'y', new Map([['2.1', at(1)]]));
    store.keep('a', 'y', new Map());
    expect(storage.length).toBe(0);
  });

  test('Drafts_HeadWithOtherAxes_AreNotGiven', () => {
    const store = new DraftStore(memory());
    store.keep('a', 'y', new Map([['2.1', at(1)]]));
    expect(store.read('a', 'z').size).toBe(0);
  });

  test('Drafts_ForeignContents_AreLeftOut', () => {
    const points = {
      '2.1': { vertex: 1, position: [1, 2, 3] },
      '2.2': { vertex: -1, position: [1, 2, 3] },
      '2.3': { vertex: 1, position: [1, 2] },
      '2.4': { vertex: 1, position: [1, 2, 'x'] },
      '99.9': { vertex: 1, position: [1, 2, 3] },
      '8.1': 7,
      '8.2': null,
      '8.3': { vertex: null, position: [1, 2, 3], proposal: { method: 4, confidence: 'sure', expectedError: '1' } },
    };
    const store = new DraftStore(memory({ 'semblante.draft.a': JSON.stringify({ axes: 'y', points }) }));
    expect(Object.fromEntries(store.read('a', 'y'))).toEqual({
      '2.1': { vertex: 1, position: [1, 2, 3] },
      '8.2': null,
      '8.3': { vertex: null, position: [1, 2, 3], proposal: { method: null, confidence: null, expectedError: null } },
    });
    for (const text of ['', '{', '[]', 'null', '{"axes":"y","points":[1]}'])
      expect(new DraftStore(memory({ 'semblante.draft.a': text })).read('a', 'y').size).toBe(0);
  });

  test('Drafts_StorageThatRefuses_IsSurvived', () => {
    const full = memory();
    full.setItem = () => {
      throw new DOMException('full', 'QuotaExceededError');
    };
    for (const storage of [full, null]) {
      const store = new DraftStore(storage);
      store.keep('a', 'y', new Map([['2.1', at(1)]]));
      expect(store.read('a', 'y').size).toBe(0);
    }
  });

  test('Draft_RestoredOverPointsOfOthers_ChangesOnlyItsOwnAndCanBeUndone', () => {
    const mine = new PointDraft();
    mine.reset([['2.1', at(1)], ['8.1', at(2)], ['9.1', at(3)]]);
    mine.place('2.1', at(10));
    mine.remove('8.1');
    const later = new PointDraft();
    later.reset([['2.1', at(1)], ['8.1', at(2)], ['9.1', at(33)], ['3.1', at(4)]]);
    later.restore(mine.changed);
    expect([...later.points].map(([id, { vertex }]) => [id, vertex])).toEqual([['2.1', 10], ['9.1', 33], ['3.1', 4]]);
    expect(later.changes).toBe(2);
    later.undo();
    expect(later.changes).toBe(0);
    expect(later.canUndo).toBe(false);
    later.restore(new Map([['2.1', at(1)]]));
    expect(later.canUndo).toBe(false);
  });
});
