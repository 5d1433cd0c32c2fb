import { describe, expect, test } from 'vitest';
import { PointDraft, type PlacedPoint } from '../src/face/point_draft.ts';
import { bestView, drawings } from '../src/ui/points/guide_data.ts';
import { pointGroups } from '../src/face/feature_points.ts';

const at = (vertex: number | null): PlacedPoint => ({ vertex, position: [vertex ?? 0, 0, 0] });

const verticesOf = (draft: PointDraft): object =>
  Object.fromEntries(Object.entries(draft.toBody().points).map(([id, { vertex }]) => [id, vertex]));

describe('point draft', () => {
  test('Draft_PlaceUnknownId_Throws', () => expect(() => new PointDraft().place('1.1', at(3))).toThrow(RangeError));

  test('Draft_UndoRedo_GoesThereAndBack', () => {
    const draft = new PointDraft();
    draft.reset([['2.1', at(5)]]);
    draft.place('2.1', at(6));
    draft.remove('2.1');
    expect(draft.undo()).toBe(true);
    expect(draft.points.get('2.1')?.vertex).toBe(6);
    expect(draft.undo()).toBe(true);
    expect(draft.changes).toBe(0);
    expect(draft.undo()).toBe(false);
    draft.redo();
    expect(draft.points.get('2.1')?.vertex).toBe(6);
  });

  test('Draft_PairPlacedOrRemoved_IsOneStep', () => {
    const draft = new PointDraft();
    draft.placeAll([['8.3', at(1)], ['8.4', at(2)]]);
    draft.remove('8.3', '8.4');
    expect(draft.points.size).toBe(0);
    draft.undo();
    expect(verticesOf(draft)).toEqual({ '8.3': 1, '8.4': 2 });
    draft.undo();
    expect(draft.canUndo).toBe(false);
    expect(draft.points.size).toBe(0);
    expect(() => draft.placeAll([['8.3', at(1)], ['1.1', at(2)]])).toThrow(RangeError);
    expect(draft.points.size).toBe(0);
  });

  test('Draft_PlaceAfterUndo_ForgetsWhatWasUndone', () => {
    const draft = new PointDraft();
    draft.place('2.1', at(1));
    draft.undo();
    draft.place('2.2', at(2));
    expect(draft.canRedo).toBe(false);
  });

  test('Draft_PointsOfOthers_AreTakenInEveryStep_AndOwnChangesStay', () => {
    const draft = new PointDraft();
    draft.reset([['2.1', at(1)], ['3.1', at(2)], ['8.3', at(3)], ['8.4', at(4)]]);
    draft.place('2.1', at(10));
    draft.place('8.3', at(30));
    draft.undo();
    // Another person moves a point of each kind (changed here, changed here and undone, unchanged), removes one and adds one.
    const { changed, contested } = draft.rebase([['2.1', at(11)], ['3.1', at(21)], ['8.3', at(31)], ['9.3', at(91)]]);
    expect(new Set(changed)).toEqual(new Set(['2.1', '3.1', '8.3', '8.4', '9.3']));
    expect([...contested.keys()]).toEqual(['2.1']);
    expect(verticesOf(draft)).toEqual({ '2.1': 10, '3.1': 21, '8.3': 31, '9.3': 91 });
    expect(draft.changed).toEqual(new Map([['2.1', { point: at(10), over: at(11) }]]));
    draft.redo();
    expect(verticesOf(draft)).toEqual({ '2.1': 10, '3.1': 21, '8.3': 30, '9.3': 91 });
    draft.undo();
    draft.undo();
    expect(verticesOf(draft)).toEqual({ '2.1': 11, '3.1': 21, '8.3': 31, '9.3': 91 });
    expect(draft.changes).toBe(0);
    draft.redo();
    draft.takeSaved(['2.1', '3.1']);
    expect(draft.changes).toBe(0);
    draft.undo();
    expect(draft.points.get('2.1')?.vertex).toBe(10);
  });

  test('Draft_SameChangeOnBothSides_IsNoNews', () => {
    const draft = new PointDraft();
    draft.reset([['2.1', at(1)]]);
    draft.place('2.1', at(5));
    expect(draft.rebase([['2.1', at(5)]])).toEqual({ changed: [], contested: new Map() });
    expect(draft.changes).toBe(0);
  });

  test('Draft_SavedMirroredAndProposed_CanBeUndone', () => {
    const proposal = { method: 'shape', confidence: 'low', expectedError: 0.1 } as const;
    const draft = new PointDraft();
    draft.reset([['2.1', at(5)]]);
    draft.place('8.3', at(6));
    draft.accept([['2.1', at(5)], ['8.3', at(6)]]); // saved as they are: no step
    expect(draft.changes).toBe(0);
    draft.accept([['2.1', at(5)], ['8.3', at(6)], ['8.4', { ...at(7), proposal }], ['9.3', { ...at(8), proposal }]]);
    expect(draft.proposed).toEqual(['8.4', '9.3']);
    draft.confirm(['8.4']);
    draft.undo();
    expect(draft.proposed).toEqual(['8.4', '9.3']);
    draft.undo(); // the proposals
    expect(verticesOf(draft)).toEqual({ '2.1': 5, '8.3': 6 });
    expect(draft.changes).toBe(2); // the server has them until the draft is saved
    draft.undo(); // the point that was placed before saving
    expect(verticesOf(draft)).toEqual({ '2.1': 5 });
    draft.redo();
    draft.redo();
    expect(draft.proposed).toEqual(['8.4', '9.3']);
    expect(draft.changes).toBe(0);
  });

  test('Draft_SameVertexAgain_CountsNoChange', () => {
    const draft = new PointDraft();
    draft.reset([['2.1', at(5)]]);
    draft.place('2.1', { vertex: 5, position: [9, 9, 9] });
    expect(draft.changes).toBe(0);
  });

  test('Draft_Proposal_IsOneUntilConfirmedOrMoved', () => {
    const proposal = { method: 'mirror', confidence: 'high', expectedError: 0.05, remark: 'joined lips' } as const;
    const draft = new PointDraft();
    draft.reset([
      ['2.1', at(5)],
      ['8.3', { ...at(6), proposal }],
      ['8.4', { ...at(7), proposal }],
      ['9.3', { ...at(8), proposal }],
    ]);
    expect(draft.proposed).toEqual(['8.3', '8.4', '9.3']);
    expect(draft.toBody().points['8.3']).toEqual({
      vertex: 6,
      position: [6, 0, 0],
      proposed: true,
      method: 'mirror',
      confidence: 'high',
      expected_error: 0.05,
      remark: 'joined lips',
    });
    draft.confirm(['8.3', '2.1']);
    draft.place('8.4', at(9));
    draft.discard(['2.1', '9.3']);
    expect(draft.proposed).toEqual([]);
    expect(verticesOf(draft)).toEqual({ '2.1': 5, '8.3': 6, '8.4': 9 });
    expect(Object.values(draft.toBody().points).some((point) => point.proposed)).toBe(false);
    expect(draft.changes).toBe(3);
  });

  test('Draft_Exchange_SwapsLeftAndRightOnce', () => {
    const draft = new PointDraft();
    draft.reset([
      ['8.3', at(1)],
      ['8.4', at(2)],
      ['3.7', at(3)],
    ]);
    draft.exchange(['8.3', '8.4', '3.7']);
    expect(verticesOf(draft)).toEqual({ '8.3': 2, '8.4': 1, '3.12': 3 });
    draft.undo();
    expect(draft.changes).toBe(0);
  });

  test('Draft_VertexOfAnotherFile_IsSentWithItsPosition', () => {
    const draft = new PointDraft();
    draft.reset([
      ['7.1', at(null)],
      ['2.1', at(5)],
    ]);
    expect(draft.toBody()).toEqual({
      points: { '7.1': { position: [0, 0, 0] }, '2.1': { vertex: 5, position: [5, 0, 0] } },
    });
  });
});

describe('guide', () => {
  test('Guide_EveryFeaturePoint_IsOnTheDrawingThatShowsIt', () => {
    const ids = pointGroups.flatMap((group) => group.points.map((point) => point.id));
    expect(ids).toHaveLength(84);
    expect(ids.filter((id) => !(id in drawings[bestView(id)].spots))).toEqual([]);
  });

  test('Guide_MirrorPairs_LeftIsOnTheRightOfThePicture', () => {
    // 3.5 is the left pupil; the face looks at us, so its left is on our right.
    expect(drawings.front.spots['3.5']![0]).toBeGreaterThan(drawings.front.spots['3.6']![0]);
    expect(drawings.mouth.spots['2.4']![0]).toBeGreaterThan(drawings.mouth.spots['2.5']![0]);
  });
});
