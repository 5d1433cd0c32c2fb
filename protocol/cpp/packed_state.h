#pragma once

#include <array>
#include <cstdint>

#include "protocol/cpp/face_frame.h"

namespace semblante {

inline constexpr std::uint64_t max_media_time = 9007199254740991U;  // 2^53 - 1

/// The state that encoder and decoder of a packed stream share: the last four frames and the predicted numbers and
/// times of the next message. There is no other adaptation (tables are fixed), so a keyframe contains the whole state.
struct PackedState {
  std::array<FaceFrame, 4> before{};  ///< the last four frames; [0] is the newest
  std::uint64_t sequence = 0;         ///< sequence number of before[0]
  std::uint64_t media_time = 0;       ///< media time of before[0], ms
  std::uint32_t step = 40;            ///< expected time from the newest frame to the next, ms
  std::uint16_t count = 1;            ///< expected number of frames of the next batch
  std::uint8_t time_class = 0;        ///< of the newest frame: 0 as expected, 1 later, 2 earlier
  std::uint8_t viseme_class = 0;      ///< 0: as before; else 1 + the kind of its change
  std::uint8_t expression_class = 0;  ///< 1: changed
  bool fresh = true;                  ///< no frame has been coded since the keyframe

  friend bool operator==(const PackedState&, const PackedState&) = default;
};

}  // namespace semblante
