#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "protocol/cpp/face_frame.h"

namespace semblante::streams {

/// A minute of a face that talks, looks about, blinks and feels, composed once from a seed and played in a loop. The
/// same seed gives the same minute on every machine; the end meets the beginning without a jump. Immutable: any thread.
class DemoPerformance {
 public:
  explicit DemoPerformance(std::uint32_t seed = 7);

  /// The state at a time from the beginning of the stream, whatever loop that falls in.
  [[nodiscard]] FaceFrame frame_at(std::chrono::milliseconds time) const;

  static constexpr std::chrono::milliseconds length{60'000};

 private:
  struct Viseme {
    double begin;  ///< s
    double ease;   ///< s it takes to arrive
    std::uint8_t shape;
  };
  struct Feeling {
    double begin, rise, hold, fall;  ///< s
    std::uint8_t expression;
    double strength;  ///< 0..1
  };
  struct Glance {
    double begin;       ///< s
    double yaw, pitch;  ///< rad, +: to the face's left, down
  };
  struct Accent {
    double at;        ///< s
    double strength;  ///< 0..1: brows up and a nod with a stressed syllable
  };

  void speak(std::uint32_t& random);

  std::vector<Viseme> visemes_;    ///< by begin
  std::vector<Feeling> feelings_;  ///< by begin, without overlap
  std::vector<Glance> glances_;    ///< by begin
  std::vector<double> blinks_;     ///< s
  std::vector<Accent> accents_;    ///< by time
};

}  // namespace semblante::streams
