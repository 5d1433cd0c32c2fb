import { firstLowLevelFap, lastLowLevelFap } from './face_frame.ts';
import { limits, type Header } from './generated/messages.ts';
import { faps } from './generated/mpeg4.ts';

/** By FAP number (entries 0..2 are 1 and unused): FAP units per quantized level. */
export type QuantizerSteps = Float64Array;

/** The steps of the standard's table. */
export const standardQuantizers: QuantizerSteps = (() => {
  const steps = new Float64Array(lastLowLevelFap + 1).fill(1);
  for (const fap of faps) steps[fap.number] = fap.quantizerStep;
  return steps;
})();

/** The steps a stream uses: its header's own, or the standard ones when it gives none. */
export function quantizersOf(header: Header): QuantizerSteps {
  if (header.quantizers.length === 0) return standardQuantizers;
  const steps = new Float64Array(lastLowLevelFap + 1).fill(1);
  steps.set(header.quantizers.slice(0, lastLowLevelFap - firstLowLevelFap + 1), firstLowLevelFap);
  return steps;
}

/**
 * A value in FAP units as a level, rounded to nearest (halves away from zero); null beyond +-32767 levels, or when it is
 * not finite.
 */
export function quantize(fapUnits: number, step: number): number | null {
  const level = Math.sign(fapUnits) * Math.round(Math.abs(fapUnits) / step);
  return Math.abs(level) <= limits.max_level ? level + 0 : null;
}
