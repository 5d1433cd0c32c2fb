#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace semblante {

inline constexpr int first_low_level_fap = 3;
inline constexpr int last_low_level_fap = 68;
inline constexpr std::size_t low_level_fap_count = 66;
inline constexpr std::uint8_t max_viseme = 14;
inline constexpr std::uint8_t max_expression = 6;
inline constexpr std::uint8_t max_blend = 63;  ///< of a viseme's blend and of intensities

/// FAP 1: viseme(select1) * blend/63 + viseme(select2) * (1 - blend/63). Selects 0..14 (0 is silence), blend 0..63.
struct VisemeBlend {
  std::uint8_t select1 = 0;
  std::uint8_t select2 = 0;
  std::uint8_t blend = 0;
  friend bool operator==(const VisemeBlend&, const VisemeBlend&) = default;
};

/// FAP 2: the sum of expression(select) * intensity/63. Selects 0..6 (0 is none), intensities 0..63.
struct ExpressionBlend {
  std::uint8_t select1 = 0;
  std::uint8_t intensity1 = 0;
  std::uint8_t select2 = 0;
  std::uint8_t intensity2 = 0;
  friend bool operator==(const ExpressionBlend&, const ExpressionBlend&) = default;
};

/// The complete state of a face at one moment (never a difference or an event). The default is the neutral face.
struct FaceFrame {
  VisemeBlend viseme;
  ExpressionBlend expression;
  /// Quantized levels by FAP number (entries 0..2 unused), -32767..32767; FAP units = level * the stream's step for
  /// the FAP. Level 0 means "absent": the FAP does not override visemes and expressions.
  std::array<std::int16_t, 69> level{};

  friend bool operator==(const FaceFrame&, const FaceFrame&) = default;
};

/// Whether every member is within its documented range.
bool is_valid(const FaceFrame& state);

/// A frame with its time: whole milliseconds after the media time of its message or request.
struct TimedFrame {
  std::uint32_t time = 0;
  FaceFrame state;
  friend bool operator==(const TimedFrame&, const TimedFrame&) = default;
};

}  // namespace semblante
