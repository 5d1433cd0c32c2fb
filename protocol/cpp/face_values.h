#pragma once

#include <array>
#include <cstdint>

#include "protocol/cpp/face_frame.h"
#include "protocol/cpp/quantizers.h"

namespace semblante {

/// The whole state of a face at one moment in FAP units, as files and tools have it before (or without) a stream's
/// quantizers. A default one is the neutral face.
struct FaceValues {
  VisemeBlend viseme;
  ExpressionBlend expression;
  /// By FAP number (entries 0..2 unused), finite. 0 is "absent", as level 0 is in a FaceFrame.
  std::array<double, 69> fap{};

  friend bool operator==(const FaceValues&, const FaceValues&) = default;
};

/// Whole milliseconds from the beginning of its sequence; times do not fall.
struct TimedValues {
  std::uint32_t time = 0;
  FaceValues state;
  friend bool operator==(const TimedValues&, const TimedValues&) = default;
};

FaceValues to_values(const FaceFrame& frame, const QuantizerSteps& steps = standard_quantizers());

/// Levels to the nearest; what is beyond +-32767 levels becomes that.
FaceFrame to_frame(const FaceValues& values, const QuantizerSteps& steps = standard_quantizers());

}  // namespace semblante
