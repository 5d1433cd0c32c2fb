import { fapCount } from './generated/mpeg4.ts';

/** FAP 1: viseme(select1) * blend/63 + viseme(select2) * (1 - blend/63). Selects 0..14 (0 is silence), blend 0..63. */
export interface VisemeBlend {
  select1: number;
  select2: number;
  blend: number;
}

/** FAP 2: the sum of expression(select) * intensity/63. Selects 0..6 (0 is none), intensities 0..63. */
export interface ExpressionBlend {
  select1: number;
  intensity1: number;
  select2: number;
  intensity2: number;
}

/** The complete state of a face at one moment (never a difference or an event). */
export interface FaceFrame {
  viseme: VisemeBlend;
  expression: ExpressionBlend;
  /**
   * Quantized levels by FAP number (entries 0..2 unused), -32767..32767; FAP units = level * the stream's step for the
   * FAP. Level 0 means "absent": the FAP does not override visemes and expressions.
   */
  levels: Int16Array;
}

/** A frame with its time: whole milliseconds after the media time of its message. */
export interface TimedFrame {
  time: number;
  state: FaceFrame;
}

export const firstLowLevelFap = 3;
export const lastLowLevelFap = fapCount;
export const maxViseme = 14;
export const maxExpression = 6;
export const maxBlend = 63;

export function neutralFrame(): FaceFrame {
  return {
    viseme: { select1: 0, select2: 0, blend: 0 },
    expression: { select1: 0, intensity1: 0, select2: 0, intensity2: 0 },
    levels: new Int16Array(lastLowLevelFap + 1),
  };
}

export function copyFrame(frame: FaceFrame): FaceFrame {
  return { viseme: { ...frame.viseme }, expression: { ...frame.expression }, levels: frame.levels.slice() };
}

export function sameFrame(a: FaceFrame, b: FaceFrame): boolean {
  const isSame = <Blend extends object>(one: Blend, other: Blend): boolean =>
    (Object.keys(one) as (keyof Blend)[]).every((part) => one[part] === other[part]);
  return (
    isSame(a.viseme, b.viseme) &&
    isSame(a.expression, b.expression) &&
    a.levels.every((level, fap) => level === b.levels[fap])
  );
}
