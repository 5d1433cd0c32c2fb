import { describe, expect, test } from 'vitest';
import type { Finding } from '../src/net/types.ts';
import { actionFor } from '../src/ui/fit/finding_actions.ts';
import { badgeOf, countWords, findingTitle, sentence } from '../src/ui/shared/finding_words.ts';

const finding = (
  code: string,
  place: Partial<Finding['place']> = {},
  severity: Finding['severity'] = 'warning',
): Finding => ({
  code,
  severity,
  words: '',
  remedy: '',
  place: { part: null, points: [], vertices: { sample: [], count: 0 }, position: null, ...place },
  measured: null,
});

describe('actions', () => {
  test('Action_MissingPoints_DependsOnWhatIsPlaced', () => {
    const missing = finding('missing-points', { points: ['4.1', '4.2'] });
    expect(actionFor(missing, true)?.kind).toBe('propose');
    expect(actionFor(missing, false)?.kind).toBe('mark');
    expect(actionFor(finding('missing-points', { points: ['11.5'] }, 'note'), true)).toBeNull();
  });

  test('Action_Part_NamesItWhereThereIsOne', () => {
    expect(actionFor(finding('idle-part', { part: 3 }), true)).toMatchObject({ kind: 'role', part: 3 });
    expect(actionFor(finding('eye-cannot-turn'), true)).toMatchObject({ kind: 'role', part: null });
  });

  test('Action_PointOnTheOtherLip_MovesIt', () => {
    const move = { point: '2.8', vertex: 17, position: [1, 2, 3] as [number, number, number] };
    expect(actionFor({ ...finding('point-on-other-rim', { points: ['2.8'] }), move }, true)).toMatchObject({
      kind: 'move',
      move,
    });
  });

  test('Action_MeshFault_HasNone', () => expect(actionFor(finding('degenerate-triangles'), true)).toBeNull());

  test('Action_OtherKinds_LeadToTheirScreen', () => {
    expect(actionFor(finding('not-upright'), true)?.kind).toBe('axes');
    expect(actionFor(finding('left-right-swapped'), true)?.kind).toBe('exchange');
    expect(actionFor(finding('point-off-mirror', { points: ['8.3', '8.4'] }), true)).toMatchObject({ point: '8.3' });
  });
});

describe('words', () => {
  test('Words_OfAFinding_AreSentences', () => {
    expect(findingTitle(finding('lips-joined'))).toBe('Lips joined');
    expect(sentence('the lips are joined')).toBe('The lips are joined.');
    expect(sentence('Done!')).toBe('Done!');
  });

  test('Counts_OfAReport_NameTheWorst', () => {
    expect(countWords({ errors: 1, warnings: 2, notes: 0 })).toBe('1 error, 2 warnings');
    expect(badgeOf({ errors: 0, warnings: 2, notes: 3 })).toEqual({ count: 5, severity: 'warning' });
    expect(badgeOf({ errors: 0, warnings: 0, notes: 0 })).toBeNull();
    expect(badgeOf(null)).toBeNull();
  });
});
