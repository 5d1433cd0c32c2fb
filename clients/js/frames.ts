import type { FaceFrame } from '../../protocol/ts/face_frame.ts';
import { fapCount } from '../../protocol/ts/generated/mpeg4.ts';
import { nearestLevel, type QuantizerSteps } from '../../protocol/ts/quantizers.ts';
import { frameLayout } from './generated/layouts.ts';

/** Writes a frame as semblante_frame, whose FAPs are in FAP units. Allocates nothing. */
export function writeFrame(view: DataView, at: number, { viseme, expression, levels }: FaceFrame, steps: QuantizerSteps): void {
  view.setUint8(at, viseme.select1);
  view.setUint8(at + 1, viseme.select2);
  view.setUint8(at + 2, viseme.blend);
  view.setUint8(at + 3, expression.select1);
  view.setUint8(at + 4, expression.intensity1);
  view.setUint8(at + 5, expression.select2);
  view.setUint8(at + 6, expression.intensity2);
  for (let fap = 3; fap <= fapCount; ++fap) {
    view.setFloat32(at + frameLayout.fap + fap * 4, levels[fap]! * steps[fap]!, true);
  }
}

/** The inverse of `writeFrame`; FAPs become the nearest level of a message. Allocates nothing. */
export function readFrame(view: DataView, at: number, into: FaceFrame, steps: QuantizerSteps): FaceFrame {
  readSelects(view, at, into);
  for (let fap = 3; fap <= fapCount; ++fap) into.levels[fap] = nearestLevel(fapOf(view, at, fap), steps[fap]!);
  return into;
}

/** FAPs 1 and 2 of a semblante_frame. */
export function readSelects(view: DataView, at: number, { viseme, expression }: Pick<FaceFrame, 'viseme' | 'expression'>): void {
  viseme.select1 = view.getUint8(at);
  viseme.select2 = view.getUint8(at + 1);
  viseme.blend = view.getUint8(at + 2);
  expression.select1 = view.getUint8(at + 3);
  expression.intensity1 = view.getUint8(at + 4);
  expression.select2 = view.getUint8(at + 5);
  expression.intensity2 = view.getUint8(at + 6);
}

/** A low-level FAP of a semblante_frame, FAP units. */
export function fapOf(view: DataView, at: number, fap: number): number {
  return view.getFloat32(at + frameLayout.fap + fap * 4, true);
}
