import { faps } from '@protocol/generated/mpeg4.ts';

/** FAPs 1..68 at one moment; all zero is the neutral face. `faps[n]` is FAP n in FAP units, entries 0..2 unused. */
export interface FaceFrame {
  viseme: { select1: number; select2: number; blend: number };
  expression: { select1: number; intensity1: number; select2: number; intensity2: number };
  faps: Float32Array;
}

export const blendMax = 63;

export function neutralFrame(): FaceFrame {
  return {
    viseme: { select1: 0, select2: 0, blend: 0 },
    expression: { select1: 0, intensity1: 0, select2: 0, intensity2: 0 },
    faps: new Float32Array(69),
  };
}

export function clearFrame(frame: FaceFrame): void {
  Object.assign(frame.viseme, { select1: 0, select2: 0, blend: 0 });
  Object.assign(frame.expression, { select1: 0, intensity1: 0, select2: 0, intensity2: 0 });
  frame.faps.fill(0);
}

export function isNeutral(frame: FaceFrame): boolean {
  const { viseme, expression } = frame;
  const shown = (viseme.select1 > 0 && viseme.blend > 0) || (viseme.select2 > 0 && viseme.blend < blendMax);
  const felt = (expression.select1 > 0 && expression.intensity1 > 0) || (expression.select2 > 0 && expression.intensity2 > 0);
  return !shown && !felt && frame.faps.every((value) => value === 0);
}

/** Shows one viseme, or none. Strength 0..1 blends it with silence. */
export function setViseme(frame: FaceFrame, viseme: number, strength: number): void {
  frame.viseme.select1 = viseme;
  frame.viseme.select2 = 0;
  frame.viseme.blend = viseme === 0 ? 0 : Math.round(strength * blendMax);
}

/**
 * Sets one expression's intensity (0..63). Two fit into a frame: a third one takes the place of the weaker. Returns the
 * expression that had to go, or 0.
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

/** Sets a FAP, and its partner on the other side of the face when `both`. Returns the partner that changed, or 0. */
export function setFap(frame: FaceFrame, number: number, value: number, both: boolean): number {
  frame.faps[number] = value;
  const fap = faps[number - 1];
  if (!both || !fap || fap.mirror === number || fap.mirror === 0) return 0;
  // Gaze is the exception: eyes look the same way, so the partner takes the value as it is.
  const partner = fap.unit === 'AU' ? value : value * fap.mirrorSign;
  frame.faps[fap.mirror] = partner;
  return fap.mirror;
}
