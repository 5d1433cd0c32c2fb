#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "core/kernel/semblante_kernel.h"
#include "core/types/result.h"

namespace semblante {

/// ARKit's blend shapes, in the order of Live Link Face's stream (its CSV files have another; read those by name).
/// Left and right are the face's own.
inline constexpr std::size_t arkit_count = 52;
using ArkitCoefficients = std::array<float, arkit_count>;

/// "jawOpen"; lives as long as the program.
std::string_view arkit_name(std::size_t index);
/// By ARKit's name ("jawOpen") or Live Link's ("JawOpen"); empty for any other.
std::optional<std::size_t> find_arkit(std::string_view name);
/// The shape of the other side; itself where a shape has both sides or none.
std::size_t arkit_mirror(std::size_t index);

struct FrameFromArkit {
  semblante_frame frame;  ///< FAPs 3..68 in FAP units, every one within its range, and FAP 1 where jaw or lips need it
  std::size_t clamped = 0;  ///< coefficients that were outside 0..1 and were taken as 0 or 1
};

/// Coefficients -> low-level FAPs for any head. Refused with `not_finite` and the name of the shape where a coefficient
/// is NaN or infinite. The rules beyond the sum of what each shape does: README.md.
Result<FrameFromArkit> frame_from_arkit(std::span<const float, arkit_count> coefficients);

/// What ARKit would say of a face, each in 0..1: read from how far each FP is along the axes of the FAPs, wherever that
/// comes from (FAPs 1 and 2 by the library's sets, shared as Eq. 5 says, low-level FAPs over both). Not the inverse of
/// frame_from_arkit: see README.md. Continuous in the frame, the same on every call. The frame's FAPs must be finite.
ArkitCoefficients arkit_from_frame(const semblante_frame& frame);

}  // namespace semblante
