#include "core/frame/human_size.h"

#include <array>

namespace semblante {
namespace {

/// Of the units for which `fits(metres per unit, unit)` is true.
template <class Fits>
std::optional<UnitBySize> first_that_fits(Fits fits) {
  // By the number of files that use them.
  constexpr std::array<LengthUnit, length_unit_names.size()> units = {
      LengthUnit::metre, LengthUnit::centimetre, LengthUnit::millimetre, LengthUnit::decimetre, LengthUnit::inch};
  std::optional<UnitBySize> found;
  for (const LengthUnit unit : units) {
    if (!fits(metres_per(unit), unit)) continue;
    if (found) {
      found->is_sure = false;
    } else {
      found = UnitBySize{unit, unit != LengthUnit::inch};
    }
  }
  return found;
}

}  // namespace

std::optional<UnitBySize> unit_of_eye_separation(double separation) {
  constexpr double usual = 0.063;  // metres
  return first_that_fits([separation](double metres_per_unit, LengthUnit /*unit*/) {
    const double ratio = separation * metres_per_unit / usual;
    return ratio >= 0.6 && ratio <= 1.65;
  });
}

std::optional<UnitBySize> unit_of_height(double height) {
  return first_that_fits([height](double metres_per_unit, LengthUnit unit) {
    const double metres = height * metres_per_unit;
    const bool is_head_or_bust = metres >= 0.15 && metres <= 0.7;
    const bool is_body = metres >= 1.2 && metres <= 2.3;
    return is_head_or_bust || (is_body && unit != LengthUnit::decimetre);
  });
}

}  // namespace semblante
