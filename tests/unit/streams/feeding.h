#pragma once

#include <array>
#include <cstdint>

#include "server/streams/stream.h"

namespace semblante::streams {

inline constexpr std::array all_sources = {Source::connection, Source::request,   Source::performance,
                                           Source::fap,        Source::recording, Source::demo};

inline TimedFrame frame_with(std::int16_t level) {
  TimedFrame frame;
  frame.state.level[3] = level;
  return frame;
}

}  // namespace semblante::streams
