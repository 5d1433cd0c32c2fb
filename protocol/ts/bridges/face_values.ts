import {
  firstLowLevelFap,
  lastLowLevelFap,
  neutralFrame,
  type ExpressionBlend,
  type FaceFrame,
  type VisemeBlend,
} from '../face_frame.ts';
import { limits } from '../generated/messages.ts';
import { quantize, type QuantizerSteps } from '../quantizers.ts';

/** A face state with FAPs in FAP units, as the bridges use it. `faps` by FAP number; 0..2 unused. */
export interface FaceValues {
  viseme: VisemeBlend;
  expression: ExpressionBlend;
  faps: Float64Array;
}

export function neutralValues(): FaceValues {
  const { viseme, expression } = neutralFrame();
  return { viseme, expression, faps: new Float64Array(lastLowLevelFap + 1) };
}

export function valuesOf(frame: FaceFrame, steps: QuantizerSteps): FaceValues {
  const faps = new Float64Array(lastLowLevelFap + 1);
  for (let n = firstLowLevelFap; n <= lastLowLevelFap; ++n) faps[n] = frame.levels[n]! * steps[n]!;
  return { viseme: frame.viseme, expression: frame.expression, faps };
}

/** Quantizes to the nearest level, clamped to the range of levels. */
export function frameOf(values: FaceValues, steps: QuantizerSteps): FaceFrame {
  const frame = neutralFrame();
  frame.viseme = { ...values.viseme };
  frame.expression = { ...values.expression };
  for (let n = firstLowLevelFap; n <= lastLowLevelFap; ++n) {
    frame.levels[n] = quantize(values.faps[n]!, steps[n]!) ?? Math.sign(values.faps[n]!) * limits.max_level;
  }
  return frame;
}

export const clamp = (value: number, least: number, most: number): number => Math.min(Math.max(value, least), most);
