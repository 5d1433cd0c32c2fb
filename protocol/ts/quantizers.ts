import { firstLowLevelFap, lastLowLevelFap } from './face_frame.ts';
import { limits, type Header } from './generated/messages.ts';
import { quantizerSteps } from './generated/mpeg4.ts';

/** FAP units per quantized level, by FAP number (entries 0..2 are 1 and unused). */
export type QuantizerSteps = Float64Array;

/** The quantizer steps of the standard. */
export const standardQuantizers: QuantizerSteps = (() => {
  const steps = new Float64Array(lastLowLevelFap + 1).fill(1);
  steps.set(quantizerSteps, 1);
  return steps;
})();

/** The quantizer steps of a stream: those of its header, else the standard's. */
export function quantizersOf(header: Header): QuantizerSteps {
  if (header.quantizers.length === 0) return standardQuantizers;
  const steps = new Float64Array(lastLowLevelFap + 1).fill(1);
  steps.set(header.quantizers.slice(0, lastLowLevelFap - firstLowLevelFap + 1), firstLowLevelFap);
  return steps;
}

/**
 * Quantizes a value in FAP units to the nearest level (halves away from zero); null beyond +-32767 levels or for a
 * value that is not finite.
 */
export function quantize(fapUnits: number, step: number): number | null {
  const level = Math.sign(fapUnits) * Math.round(Math.abs(fapUnits) / step);
  return Math.abs(level) <= limits.max_level ? level + 0 : null;
}

/** The nearest level of a number, limited to those of a message. */
export function nearestLevel(fapUnits: number, step: number): number {
  return quantize(fapUnits, step) ?? Math.sign(fapUnits) * limits.max_level;
}
