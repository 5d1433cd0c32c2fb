import type { Finding, FindingCounts, Severity } from '../../net/types.ts';
import { capital } from './names.ts';

export const severities: readonly { severity: Severity; one: string; many: string }[] = [
  { severity: 'error', one: 'error', many: 'errors' },
  { severity: 'warning', one: 'warning', many: 'warnings' },
  { severity: 'note', one: 'note', many: 'notes' },
];

/** The meaning of each severity, as shown in the panel. */
export const severityMeanings: Record<Severity, string> = {
  error: 'moves wrongly, or not at all',
  warning: 'looks worse than it could',
  note: 'worth knowing',
};

const titles: Record<string, string> = {
  'non-manifold-edges': 'Edges of more than two triangles',
  'no-points': 'No points yet',
  'left-right-swapped': 'Left and right exchanged',
  'unit-not-positive': 'A unit of zero',
  'unit-implausible': 'An implausible unit',
  'unit-by-hand': 'A unit set by hand',
  'point-on-other-rim': 'A point on the other lip or lid',
};

/** "lips-joined" -> "Lips joined". */
export const findingTitle = (finding: Finding): string =>
  titles[finding.code] ?? capital(finding.code.replaceAll('-', ' '));

/** Adds capital and full stop; the report's sentences have neither, so that they can be joined. */
export const sentence = (text: string): string => (text === '' ? '' : capital(text) + (/[.!?]$/.test(text) ? '' : '.'));

/** "2 errors, 1 warning"; empty when there are no findings. */
export function countWords(counts: FindingCounts): string {
  const numbers = { error: counts.errors, warning: counts.warnings, note: counts.notes };
  return severities
    .filter(({ severity }) => numbers[severity] > 0)
    .map(({ severity, one, many }) => `${numbers[severity]} ${numbers[severity] === 1 ? one : many}`)
    .join(', ');
}

/** The number of findings and the worst severity; null when there are none. */
export function badgeOf(counts: FindingCounts | null | undefined): { count: number; severity: Severity } | null {
  if (!counts) return null;
  const count = counts.errors + counts.warnings + counts.notes;
  if (count === 0) return null;
  return { count, severity: counts.errors > 0 ? 'error' : counts.warnings > 0 ? 'warning' : 'note' };
}
