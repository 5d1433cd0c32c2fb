import { expect, test } from 'vitest';
import type { Finding, FitReport } from '../src/net/types.ts';
import { movesOf } from '../src/ui/fit/mend.ts';

const finding = (severity: Finding['severity'], point: string | null, vertex = 0): Finding =>
  ({ severity, ...(point === null ? {} : { move: { point, vertex, position: [vertex, 0, 0] } }) }) as Finding;

test('MovesOf_Report_AreThoseOfErrorsAndWarnings_TheWorstFirst', () => {
  const findings = [finding('warning', '2.2', 1), finding('warning', '3.1', 2), finding('error', '2.2', 3), finding('error', null), finding('note', '9.3', 4)];
  expect(movesOf({ findings } as unknown as FitReport)).toEqual([
    { point: '2.2', vertex: 3, position: [3, 0, 0] },
    { point: '3.1', vertex: 2, position: [2, 0, 0] },
  ]);
});
