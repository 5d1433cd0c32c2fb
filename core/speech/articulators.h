#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/speech/segments.h"

namespace semblante {

enum class Articulator : std::uint8_t { jaw, lips, width, protrusion, tongue };
inline constexpr std::size_t articulator_count = 5;

/// A mouth as the displacements of some feature points along some axes, FAPU units, weighted by how well they are seen.
inline constexpr std::size_t mouth_size = 14;
using MouthVector = std::array<float, mouth_size>;

/// Of each viseme of the library, by number.
std::span<const MouthVector> viseme_mouths();
/// Whose each component is.
Articulator articulator_of(std::size_t component);

/// Where the mouth should be at a time: the dominances' mean of the segments' targets.
MouthVector mouth_at(double ms, std::span<const Segment> segments);

}  // namespace semblante
