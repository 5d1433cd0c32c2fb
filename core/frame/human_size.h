#pragma once

#include <optional>

#include "core/frame/frame.h"

namespace semblante {

/// The unit in which eyes this far apart are an adult's, give or take a cartoon; inches only where no metric unit fits.
std::optional<LengthUnit> unit_of_eye_separation(double separation);

/// The unit in which something this tall is a head, a bust or a whole body: of several that fit the one more files are
/// in, and then not sure. nullopt when none fits.
struct UnitBySize {
  LengthUnit unit = LengthUnit::metre;
  bool is_sure = false;
};
std::optional<UnitBySize> unit_of_height(double height);

}  // namespace semblante
