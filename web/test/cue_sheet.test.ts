import { expect, test } from 'vitest';
import { durationOf, emptyDocument, placed, targetOf, withCues, type Cue } from '../src/face/cue_sheet.ts';

test('Placed_Moved_KeepsItsLengthAndNeverStartsBeforeZero', () => {
  const cue: Cue = { time: 100, duration: 200, viseme: 'a', attack: 70 };
  expect(placed(cue, 350, 550)).toEqual({ time: 350, duration: 200, viseme: 'a', attack: 70 });
  expect(placed(cue, -50, 150)).toMatchObject({ time: 0, duration: 150 });
});

test('Placed_Shortened_AttackAndReleaseFitIntoIt', () => {
  const cue = placed({ time: 0, duration: 1000, expression: 'joy', attack: 300, release: 500 }, 0, 400);
  expect(cue).toMatchObject({ duration: 400, attack: 150, release: 250 });
  expect(placed(cue, 0, 0)).toMatchObject({ duration: 20 });
});

test('Placed_Keys_KeepTheirPlacesInTheCue', () => {
  const cue: Cue = { time: 400, fap: 'open_jaw', keys: [[0, 0], [120, 300], [400, 0]] };
  expect(durationOf(cue)).toBe(400);
  expect(placed(cue, 400, 1200).keys).toEqual([[0, 0], [240, 300], [800, 0]]);
});

test('TargetOf_NamesAndNumbers_AreOneTrack', () => {
  expect(targetOf({ time: 0, fap: 'open_jaw', value: 1 })).toEqual({ kind: 'fap', number: 3 });
  expect(targetOf({ time: 0, expression: 'sadness' })).toEqual(targetOf({ time: 0, expression: 2 }));
  expect(targetOf({ time: 0, blink: 'both' }).kind).toBe('blink');
});

test('WithCues_SortsAndLengthensTheDocument', () => {
  const document = withCues(emptyDocument('x'), [{ time: 5000, duration: 900, viseme: 1 }, { time: 10, duration: 100, viseme: 2 }]);
  expect(document.cues!.map(({ time }) => time)).toEqual([10, 5000]);
  expect(document.duration).toBe(5900);
});
