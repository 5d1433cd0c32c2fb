#pragma once

#include "core/kernel/semblante_kernel.h"
#include "core/tables/mpeg4.h"

namespace semblante {

/// The frame that makes the mirror image of the face: left becomes right. Visemes and expressions are symmetric and are
/// not changed.
inline semblante_frame mirrored(const semblante_frame& frame) {
  semblante_frame result = frame;
  for (std::size_t n = 3; n <= mpeg4::fap_count; ++n) {
    const mpeg4::Fap& fap = mpeg4::fap(n);
    result.fap[fap.mirror] = static_cast<float>(fap.mirror_sign) * frame.fap[n];
  }
  return result;
}

}  // namespace semblante
