import type { FaceFrame } from '../../protocol/ts/face_frame.ts';
import { fapCount } from '../../protocol/ts/generated/mpeg4.ts';
import type { QuantizerSteps } from '../../protocol/ts/quantizers.ts';
import { frameLayout } from './layouts.ts';

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
    view.setFloat32(at + frameLayout.faps + fap * 4, levels[fap]! * steps[fap]!, true);
  }
}

/** The inverse of `writeFrame`. Allocates nothing. */
export function readFrame(view: DataView, at: number, into: FaceFrame, steps: QuantizerSteps): FaceFrame {
  const { viseme, expression, levels } = into;
  viseme.select1 = view.getUint8(at);
  viseme.select2 = view.getUint8(at + 1);
  viseme.blend = view.getUint8(at + 2);
  expression.select1 = view.getUint8(at + 3);
  expression.intensity1 = view.getUint8(at + 4);
  expression.select2 = view.getUint8(at + 5);
  expression.intensity2 = view.getUint8(at + 6);
  for (let fap = 3; fap <= fapCount; ++fap) {
    levels[fap] = Math.round(view.getFloat32(at + frameLayout.faps + fap * 4, true) / steps[fap]!);
  }
  return into;
}
