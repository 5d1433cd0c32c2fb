#pragma once

#include <optional>

#include "core/frame/frame.h"

namespace semblante {

/// A unit in which a length is a human's.
struct UnitBySize {
  LengthUnit unit = LengthUnit::metre;
  /// No other unit fits, and the unit is metric: inches are so rare that a length which fits only them is more likely
  /// that of a model without a true size.
  bool is_sure = false;

  bool operator==(const UnitBySize&) const = default;
};

/// The unit in which this eye distance is an adult's, with tolerance for cartoons; nullopt when none fits.
std::optional<UnitBySize> unit_of_eye_separation(double separation);

/// The unit in which this height is that of a head, a bust or a whole body; nullopt when none fits. In both functions
/// the unit used by more files is taken where several fit.
std::optional<UnitBySize> unit_of_height(double height);

}  // namespace semblante
