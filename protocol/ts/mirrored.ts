import { copyFrame, firstLowLevelFap, lastLowLevelFap, type FaceFrame } from './face_frame.ts';
import { faps } from './generated/mpeg4.ts';

/**
 * The frame of the mirrored face: left and right exchanged. Visemes and expressions are symmetric and stay. Requires
 * quantizer steps that are equal on both sides, as the standard's are.
 */
export function mirrored(frame: FaceFrame): FaceFrame {
  const result = copyFrame(frame);
  for (let n = firstLowLevelFap; n <= lastLowLevelFap; n += 1) {
    const { mirror, mirrorSign } = faps[n - 1]!;
    // + 0: a level is never -0
    result.levels[mirror] = mirrorSign * frame.levels[n]! + 0;
  }
  return result;
}
