import { describe, expect, test } from 'vitest';
import { PointDraft, type PlacedPoint, type PointChange } from '../src/face/point_draft.ts';
import { DraftStore } from '../src/ui/points/draft_store.ts';
import { memory } from './support/memory.ts';

const at = (vertex: number): PlacedPoint => ({ vertex, position: [vertex, 0, 0] });
const placed = (vertex: number): PointChange => ({ point: at(vertex), over: null });

describe('draft store', () => {
  test('Drafts_ChangesOfTwoHeads_AreKeptApart', () => {
    const storage = memory();
    const store = new DraftStore(storage);
    store.keep('a', 'y', new Map([['2.1', placed(1)]]));
    store.keep('b', 'y', new Map([['8.1', { point: null, over: at(2) }]]));
    expect(new DraftStore(storage).read('a', 'y')).toEqual(new Map([['2.1', placed(1)]]));
    expect(new DraftStore(storage).read('b', 'y')).toEqual(new Map([['8.1', { point: null, over: at(2) }]]));
  });

  test('Drafts_NoChanges_LeaveNothingInTheStorage', () => {
    const storage = memory();
    const store = new DraftStore(storage);
    store.keep('a', 'y', new Map([['2.1', placed(1)]]));
    store.keep('a', 'y', new Map());
    expect(storage.length).toBe(0);
  });

  test('Drafts_OfTwoPagesAtOneHead_LoseNothingOfEachOther', () => {
    const storage = memory();
    const [one, two] = [new DraftStore(storage), new DraftStore(storage)];
    one.keep('a', 'y', new Map([['2.1', placed(1)]]));
    two.keep('a', 'y', new Map([['8.1', placed(2)]]));
    const both = new Map([['2.1', placed(1)], ['8.1', placed(2)]]);
    expect(new DraftStore(storage).read('a', 'y')).toEqual(both);
    two.keep('a', 'y', new Map()); // it has saved
    expect(new DraftStore(storage).read('a', 'y')).toEqual(new Map([['2.1', placed(1)]]));
    const reloaded = new DraftStore(storage);
    reloaded.read('a', 'y');
    reloaded.keep('a', 'y', new Map());
    expect(storage.length).toBe(0);
  });

  test('Drafts_OfAForgottenHead_AreGoneForEveryPage', () => {
    const storage = memory();
    new DraftStore(storage).keep('a', 'y', new Map([['2.1', placed(1)]]));
    new DraftStore(storage).forget('a');
    expect(storage.length).toBe(0);
  });

  test('Drafts_HeadWithOtherAxes_AreNotGiven', () => {
    const store = new DraftStore(memory());
    store.keep('a', 'y', new Map([['2.1', placed(1)]]));
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
    const store = new DraftStore(memory({ 'semblante.draft.a': JSON.stringify({ axes: 'y', points, over: { '2.1': at(7), '8.2': 7 } }) }));
    expect(Object.fromEntries(store.read('a', 'y'))).toEqual({
      '2.1': { point: { vertex: 1, position: [1, 2, 3] }, over: at(7) },
      '8.2': { point: null, over: undefined },
      '8.3': {
        point: { vertex: null, position: [1, 2, 3], proposal: { method: null, confidence: null, expectedError: null } },
        over: undefined,
      },
    });
    for (const text of ['', '{', '[]', 'null', '{"axes":"y","points":[1]}'])
      expect(new DraftStore(memory({ 'semblante.draft.a': text })).read('a', 'y').size).toBe(0);
  });

  test('Drafts_StorageThatRefuses_IsSurvived', () => {
    const full = memory();
    full.setItem = full.removeItem = () => {
      throw new DOMException('full', 'QuotaExceededError');
    };
    for (const storage of [full, null]) {
      const store = new DraftStore(storage);
      store.keep('a', 'y', new Map([['2.1', placed(1)]]));
      store.forget('a');
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
    expect(later.restore(mine.changed, true).size).toBe(0);
    expect([...later.points].map(([id, { vertex }]) => [id, vertex])).toEqual([['2.1', 10], ['9.1', 33], ['3.1', 4]]);
    expect(later.changes).toBe(2);
    later.undo();
    expect(later.changes).toBe(0);
    expect(later.canUndo).toBe(false);
    later.restore(new Map([['2.1', placed(1)]]), true);
    expect(later.canUndo).toBe(false);
  });

  test('Draft_RestoredOverAPointThatOthersChanged_IsContested', () => {
    const mine = new PointDraft();
    mine.reset([['2.1', at(1)], ['8.1', at(2)], ['9.1', at(3)]]);
    mine.place('2.1', at(10));
    mine.place('9.1', at(30));
    mine.remove('8.1');
    const later = new PointDraft();
    later.reset([['2.1', at(11)], ['8.1', at(2)], ['9.1', at(30)]]);
    expect([...later.restore(mine.changed, true)]).toEqual([['2.1', at(1)]]);
    expect([...later.points].map(([id, { vertex }]) => [id, vertex])).toEqual([['2.1', 10], ['9.1', 30]]);
    later.undo();
    expect([...later.points].map(([id, { vertex }]) => [id, vertex])).toEqual([['2.1', 11], ['8.1', 2], ['9.1', 30]]);
  });

  test('Draft_RestoredWithoutTheServer_IsContestedWhenTheServerIsBack', () => {
    const mine = new PointDraft();
    mine.reset([['2.1', at(1)], ['9.1', at(3)]]);
    mine.place('2.1', at(10));
    mine.place('9.1', at(30));
    const later = new PointDraft();
    expect(later.restore(mine.changed, false).size).toBe(0);
    expect(later.changed).toEqual(mine.changed);
    expect([...later.rebase([['2.1', at(1)], ['9.1', at(33)]]).contested]).toEqual([['9.1', at(3)]]);
  });
});
