#pragma once

#include <optional>

#include "core/frame/frame.h"

namespace semblante {

/// The unit in which this eye distance is an adult's, with tolerance for cartoons; inches only if no metric unit fits.
std::optional<LengthUnit> unit_of_eye_separation(double separation);

/// The unit in which this height is that of a head, a bust or a whole body; of several that fit the one used by more
/// files, marked as uncertain. nullopt when none fits.
struct UnitBySize {
  LengthUnit unit = LengthUnit::metre;
  bool is_sure = false;
};
std::optional<UnitBySize> unit_of_height(double height);

}  // namespace semblante
