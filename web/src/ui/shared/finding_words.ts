import type { Finding, FindingCounts, Severity } from '../../net/types.ts';
import { capital } from './names.ts';
import { findingTexts, nameOf, t } from '../../words/words.ts';

export const severities: readonly Severity[] = ['error', 'warning', 'note'];

/** "2 errors". */
export function severityCount(severity: Severity, count: number): string {
  if (severity === 'error') return count === 1 ? t('1 error') : t('{count} errors', { count });
  if (severity === 'warning') return count === 1 ? t('1 warning') : t('{count} warnings', { count });
  return count === 1 ? t('1 note') : t('{count} notes', { count });
}

/** The meaning of each severity, as shown in the panel. */
export const severityMeanings: Record<Severity, string> = {
  error: t('moves wrongly, or not at all'),
  warning: t('looks worse than it could'),
  note: t('worth knowing'),
};

const titles: Record<string, string> = {
  'non-manifold-edges': t('Edges of more than two triangles'),
  'no-points': t('No points yet'),
  'left-right-swapped': t('Left and right exchanged'),
  'unit-not-positive': t('A unit of zero'),
  'unit-implausible': t('An implausible unit'),
  'unit-by-hand': t('A unit set by hand'),
  'point-on-other-rim': t('A point on the other lip or lid'),
  'point-off-lid-edge': t('A point on the fold of a lid'),
  'point-on-eye': t('A point on the eye'),
};

/** "lips-joined" -> "Lips joined". */
export const findingTitle = (finding: Finding): string =>
  titles[finding.code] ?? nameOf(capital(finding.code.replaceAll('-', ' ')));

/** What is wrong and what to do about it. */
export function textsOf({ code, words, remedy, place, measured, move }: Finding): readonly [words: string, remedy: string] {
  const facts = {
    points: place.points,
    count: place.vertices.count,
    value: measured?.value ?? NaN,
    what: measured?.what ?? '',
    vertex: move?.vertex ?? null,
  };
  const [what, todo] = findingTexts(code, facts) ?? [words, remedy];
  return [sentence(what), sentence(todo)];
}

/** Adds capital and full stop; the report's sentences have neither, so that they can be joined. */
export const sentence = (text: string): string => (text === '' ? '' : capital(text) + (/[.!?]$/.test(text) ? '' : '.'));

/** "2 errors, 1 warning"; empty when there are no findings. */
export function countWords(counts: FindingCounts): string {
  const numbers = { error: counts.errors, warning: counts.warnings, note: counts.notes };
  return severities
    .filter((severity) => numbers[severity] > 0)
    .map((severity) => severityCount(severity, numbers[severity]))
    .join(', ');
}

/** The number of findings and the worst severity; null when there are none. */
export function badgeOf(counts: FindingCounts | null | undefined): { count: number; severity: Severity } | null {
  if (!counts) return null;
  const count = counts.errors + counts.warnings + counts.notes;
  if (count === 0) return null;
  return { count, severity: counts.errors > 0 ? 'error' : counts.warnings > 0 ? 'warning' : 'note' };
}
