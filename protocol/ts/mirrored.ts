import { copyFrame, firstLowLevelFap, lastLowLevelFap, type FaceFrame } from './face_frame.ts';
import { faps } from './generated/mpeg4.ts';

/**
 * The frame that makes the mirror image of the face: left becomes right. Visemes and expressions are symmetric by their
 * nature and stay. For streams whose quantizer steps are alike on both sides, as the standard's are.
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
