#pragma once

#include <array>
#include <cstdint>

#include "protocol/cpp/face_frame.h"
#include "protocol/cpp/quantizers.h"

namespace semblante {

/// The complete state of a face at one moment in FAP units, before quantization, for files and tools.
/// The default is the neutral face.
struct FaceValues {
  VisemeBlend viseme;
  ExpressionBlend expression;
  /// Values by FAP number (entries 0..2 unused), finite. 0 means "absent", like level 0 in a FaceFrame.
  std::array<double, 69> fap{};

  friend bool operator==(const FaceValues&, const FaceValues&) = default;
};

/// Whole milliseconds from the start of its sequence; times never decrease.
struct TimedValues {
  std::uint32_t time = 0;
  FaceValues state;
  friend bool operator==(const TimedValues&, const TimedValues&) = default;
};

FaceValues to_values(const FaceFrame& frame, const QuantizerSteps& steps = standard_quantizers());

/// Quantizes to the nearest level, clamped to +-32767.
FaceFrame to_frame(const FaceValues& values, const QuantizerSteps& steps = standard_quantizers());

}  // namespace semblante
