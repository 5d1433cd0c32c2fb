#pragma once

#include "core/tables/mpeg4.h"
#include "protocol/cpp/face_frame.h"

namespace semblante {

/// The frame of the mirrored face: left and right exchanged. Visemes and expressions are symmetric and stay.
/// Requires quantizer steps that are equal on both sides, as the standard's are.
inline FaceFrame mirrored(const FaceFrame& frame) {
  FaceFrame result = frame;
  for (std::size_t n = first_low_level_fap; n <= last_low_level_fap; ++n) {
    const mpeg4::Fap& fap = mpeg4::fap(n);
    result.level[fap.mirror] = static_cast<std::int16_t>(fap.mirror_sign * frame.level[n]);
  }
  return result;
}

}  // namespace semblante
