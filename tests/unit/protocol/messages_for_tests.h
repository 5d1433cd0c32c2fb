#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "protocol/cpp/messages.h"

namespace semblante {

/// A face that talks: a few FAPs drift, now and then a viseme or an expression changes.
inline std::vector<TimedFrame> talking_face(std::size_t count, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::vector<TimedFrame> frames;
  TimedFrame frame;
  for (std::size_t i = 0; i < count; ++i) {
    for (unsigned k = 0; k < 1 + random() % 6; ++k) {
      auto& level = frame.state.level[3 + random() % 66];
      level = static_cast<std::int16_t>(
          std::clamp(static_cast<int>(level) + static_cast<int>(random() % 401) - 200, -32767, 32767));
    }
    if (random() % 4 == 0) {
      frame.state.viseme = {static_cast<std::uint8_t>(random() % 15), static_cast<std::uint8_t>(random() % 15),
                            static_cast<std::uint8_t>(random() % 64)};
    }
    if (random() % 10 == 0) {
      frame.state.expression = {static_cast<std::uint8_t>(random() % 7), static_cast<std::uint8_t>(random() % 64),
                                static_cast<std::uint8_t>(random() % 7), static_cast<std::uint8_t>(random() % 64)};
    }
    frames.push_back(frame);
    frame.time += static_cast<std::uint32_t>(random() % 80);
  }
  return frames;
}

/// One of each message, with nothing left at its default.
inline std::vector<Message> one_of_each() {
  Header header{1,
                "demo",
                "A demo \xC3\xA9",
                "sample",
                7,
                41,
                1640,
                1.7e12 + 0.25,
                25.0,
                40,
                {},
                true,
                0.7,
                SoundTrack{SoundCodec::opus, 48'000, 1, 20'000}};
  for (int i = 0; i < 66; ++i) header.quantizers.push_back(0.5 + i);
  Keyframe keyframe{41, 1640, talking_face(5).back().state};
  Frames frames{42, 1680, talking_face(10, 2)};
  return {Hello{1, StreamRole::publish, ResumePoint{7, 41}, true, true},
          header,
          keyframe,
          frames,
          End{EndReason::shutdown},
          StreamError{StreamErrorCode::out_of_range, "/frames/0/faps/99", "no such FAP"},
          SoundPacket{1640, {0x18, 1, 2, 3}},
          Ping{5, 123.5},
          Pong{5, 123.5, 1.7e12, 99}};
}

}  // namespace semblante
