import { faps } from '@protocol/generated/mpeg4.ts';
import { standardQuantizers, type QuantizerSteps } from '@protocol/quantizers.ts';

/** How many fine levels make one standard level, for rotation FAPs. */
export const turnsFiner = 8;

const turns = faps.filter((fap) => fap.unit === 'AU').map((fap) => fap.number);

/**
 * The standard's steps, refined for the rotation FAPs of eyes and head: a slow rotation in steps of a tenth of a degree
 * visibly stutters. Only for frames that never leave this page.
 */
export const fineSteps: QuantizerSteps = standardQuantizers.map((step, fap) =>
  turns.includes(fap) ? step / turnsFiner : step,
);

/** Converts levels of the standard's steps to levels of `fineSteps`. */
export function refineLevels(levels: Int16Array, out: Int16Array): void {
  out.set(levels);
  for (let i = 0; i < turns.length; i += 1) out[turns[i]!] = levels[turns[i]!]! * turnsFiner;
}
