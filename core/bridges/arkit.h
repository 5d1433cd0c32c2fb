#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "core/kernel/semblante_kernel.h"
#include "core/types/result.h"

namespace semblante {

/// ARKit's blend shapes, in the order of Live Link Face's stream. Its CSV files have another order; they are read by
/// name. Left and right are the face's own.
inline constexpr std::size_t arkit_count = 52;
using ArkitCoefficients = std::array<float, arkit_count>;

/// The name, such as "jawOpen", with static lifetime.
std::string_view arkit_name(std::size_t index);
/// The index by ARKit's name ("jawOpen") or Live Link's ("JawOpen"); nullopt for any other.
std::optional<std::size_t> find_arkit(std::string_view name);
/// The shape of the other side; the shape itself if it is symmetric.
std::size_t arkit_mirror(std::size_t index);

struct FrameFromArkit {
  semblante_frame frame;  ///< FAPs 3..68 in FAP units, every one within its range, and FAP 1 where jaw or lips need it
  std::size_t clamped = 0;  ///< coefficients that were outside 0..1 and were taken as 0 or 1
};

/// Converts coefficients to FAPs for any head. Error: `not_finite` with the name of the shape for a coefficient that is
/// NaN or infinite. README.md has the rules beyond the sum of the shapes' effects.
Result<FrameFromArkit> frame_from_arkit(std::span<const float, arkit_count> coefficients);

/// Converts a face to ARKit coefficients, each in 0..1, fitted to the displacements of the FPs along the axes of the
/// FAPs (FAPs 1 and 2 by the library's sets and Eq. 5, low-level FAPs over both). Not the inverse of frame_from_arkit:
/// see README.md. Continuous in the frame and deterministic. The frame's FAPs must be finite.
ArkitCoefficients arkit_from_frame(const semblante_frame& frame);

}  // namespace semblante
