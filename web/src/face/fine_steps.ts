import { faps } from '@protocol/generated/mpeg4.ts';
import { standardQuantizers, type QuantizerSteps } from '@protocol/quantizers.ts';

/** Levels in one of the standard's, for FAPs that turn something. */
export const turnsFiner = 8;

const turns = faps.filter((fap) => fap.unit === 'AU').map((fap) => fap.number);

/**
 * The standard's steps, but finer where eyes and head turn: a slow turn by steps of a tenth of a degree can be seen to
 * jerk. For frames that stay on this page.
 */
export const fineSteps: QuantizerSteps = standardQuantizers.map((step, fap) =>
  turns.includes(fap) ? step / turnsFiner : step,
);

/** Writes levels of the standard's steps as levels of `fineSteps`. */
export function refineLevels(levels: Int16Array, out: Int16Array): void {
  out.set(levels);
  for (const fap of turns) out[fap] = levels[fap]! * turnsFiner;
}
