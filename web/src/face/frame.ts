import { faps } from '@protocol/generated/mpeg4.ts';
import { maxBlend, type FaceFrame } from '@protocol/face_frame.ts';
import { quantize, standardQuantizers } from '@protocol/quantizers.ts';

/** Editing of a frame by the sliders; its levels count the standard's quantizer steps. */

export function clearFrame(frame: FaceFrame): void {
  Object.assign(frame.viseme, { select1: 0, select2: 0, blend: 0 });
  Object.assign(frame.expression, { select1: 0, intensity1: 0, select2: 0, intensity2: 0 });
  frame.levels.fill(0);
}

export function isNeutral(frame: FaceFrame): boolean {
  const { viseme, expression } = frame;
  const shown = (viseme.select1 > 0 && viseme.blend > 0) || (viseme.select2 > 0 && viseme.blend < maxBlend);
  const felt =
    (expression.select1 > 0 && expression.intensity1 > 0) || (expression.select2 > 0 && expression.intensity2 > 0);
  return !shown && !felt && frame.levels.every((level) => level === 0);
}

/**
 * Blends two visemes: `first` with weight `share` (0..1), `second` with 1 - `share`. Viseme 0 is silence; blending with
 * silence weakens a viseme.
 */
export function setVisemes(frame: FaceFrame, first: number, second: number, share: number): void {
  const none = first === 0 && second === 0;
  Object.assign(frame.viseme, { select1: first, select2: second, blend: none ? 0 : Math.round(share * maxBlend) });
}

/**
 * Sets one expression's intensity (0..63). A frame holds two expressions: a third one replaces the weaker. Returns the
 * replaced expression, or 0.
 */
export function setExpression(frame: FaceFrame, expression: number, intensity: number): number {
  const e = frame.expression;
  if (e.select1 === expression || e.select2 === expression) {
    const slot = e.select1 === expression ? 1 : 2;
    e[`intensity${slot}`] = intensity;
    if (intensity === 0) e[`select${slot}`] = 0;
    return 0;
  }
  if (intensity === 0) return 0;
  const free = e.select1 === 0 ? 1 : e.select2 === 0 ? 2 : null;
  const slot = free ?? (e.intensity1 <= e.intensity2 ? 1 : 2);
  const gone = free === null ? e[`select${slot}`] : 0;
  e[`select${slot}`] = expression;
  e[`intensity${slot}`] = intensity;
  return gone;
}

export function expressionIntensity(frame: FaceFrame, expression: number): number {
  const e = frame.expression;
  if (e.select1 === expression) return e.intensity1;
  if (e.select2 === expression) return e.intensity2;
  return 0;
}

/** The value of a FAP, FAP units. */
export const fapValue = (frame: FaceFrame, number: number): number =>
  frame.levels[number]! * standardQuantizers[number]!;

/**
 * Sets a FAP (FAP units, rounded to the nearest level), and with `both` its mirror FAP on the other side of the face.
 * Returns the mirror FAP that changed, or 0.
 */
export function setFap(frame: FaceFrame, number: number, value: number, both: boolean): number {
  const level = quantize(value, standardQuantizers[number]!) ?? 0;
  frame.levels[number] = level;
  const fap = faps[number - 1];
  if (!both || !fap || fap.mirror === number || fap.mirror === 0) return 0;
  // Exception: both eyes look in the same direction, so the mirror FAP of a gaze FAP takes the value unmirrored.
  frame.levels[fap.mirror] = fap.unit === 'AU' ? level : level * fap.mirrorSign;
  return fap.mirror;
}

/** Mirrors the frame: exchanges left and right. Visemes and expressions are symmetric and stay. */
export function mirrorFrame(frame: FaceFrame): void {
  const before = frame.levels.slice();
  for (const { number, mirror, mirrorSign } of faps)
    if (mirror !== 0) frame.levels[mirror] = before[number]! * mirrorSign;
}

/** Values of FAPs 19 to 22 for closed eyes, as performances close them. FAP units: 1024ths. */
export const shutLids: readonly (readonly [number, number])[] = [
  [19, 940],
  [20, 940],
  [21, 84],
  [22, 84],
];

/** Closes the eyes; returns the function that restores the lids. A lid that was moved meanwhile keeps its value. */
export function shutEyes(frame: FaceFrame): () => void {
  const undo = shutLids.map(([number, value]) => {
    const before = frame.levels[number]!;
    const shut = quantize(value, standardQuantizers[number]!) ?? 0;
    frame.levels[number] = shut;
    return (): void => {
      if (frame.levels[number] === shut) frame.levels[number] = before;
    };
  });
  return () => undo.forEach((open) => open());
}
