import { expect, test } from 'vitest';
import { emptyDocument, type CueDocument } from '../src/face/cue_sheet.ts';
import { TimelineModel } from '../src/ui/animate/timeline_model.ts';

function opened(): { model: TimelineModel; edits: CueDocument[] } {
  const edits: CueDocument[] = [];
  const model = new TimelineModel((document) => edits.push(document));
  model.open({ ...emptyDocument('x'), cues: [{ time: 0, duration: 100, viseme: 1 }, { time: 200, duration: 100, viseme: 2 }] });
  return { model, edits };
}

test('Timeline_MovedPastAnother_StaysChosen', () => {
  const { model, edits } = opened();
  model.choose(0);
  model.place(300, 400);
  expect(model.cues.map(({ viseme }) => viseme)).toEqual([2, 1]);
  expect(model.chosen.value).toBe(1);
  expect(edits).toHaveLength(1);
});

test('Timeline_UndoAndRedo_GoThroughEveryChange', () => {
  const { model, edits } = opened();
  model.choose(1);
  model.remove();
  expect(model.chosen.value).toBe(0);
  model.add({ time: 50, duration: 10, blink: 'both' });
  expect(model.cues).toHaveLength(2);
  model.undo();
  model.undo();
  expect(model.cues.map(({ viseme }) => viseme)).toEqual([1, 2]);
  expect(model.canUndo).toBe(false);
  model.redo();
  expect(model.cues).toHaveLength(1);
  model.choose(0);
  model.place(10, 20);
  expect(model.canRedo).toBe(false);
  expect(edits).toHaveLength(6);
});

test('Timeline_NothingChosen_NothingIsMovedOrRemoved', () => {
  const { model, edits } = opened();
  model.place(1, 2);
  model.remove();
  expect(edits).toEqual([]);
});
