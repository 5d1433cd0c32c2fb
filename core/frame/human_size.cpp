#include "core/frame/human_size.h"

namespace semblante {
std::optional<LengthUnit> unit_of_eye_separation(double separation) {
  constexpr double usual = 0.063;  // metres
  // Metric units are a factor of ten apart; inches are used only if no metric unit fits.
  for (std::size_t i = 0; i < length_unit_names.size(); ++i) {
    const double ratio = separation * metres_per(static_cast<LengthUnit>(i)) / usual;
    if (ratio >= 0.6 && ratio <= 1.65) return static_cast<LengthUnit>(i);
  }
  return std::nullopt;
}

std::optional<UnitBySize> unit_of_height(double height) {
  const auto fits = [height](LengthUnit unit) {
    const double metres = height * metres_per(unit);
    const bool is_head_or_bust = metres >= 0.15 && metres <= 0.7;
    const bool is_body = metres >= 1.2 && metres <= 2.3;
    return is_head_or_bust || (is_body && unit != LengthUnit::decimetre);
  };
  std::optional<UnitBySize> found;
  for (const LengthUnit unit :
       {LengthUnit::metre, LengthUnit::centimetre, LengthUnit::millimetre, LengthUnit::decimetre}) {
    if (!fits(unit)) continue;
    if (found) {
      found->is_sure = false;
    } else {
      found = UnitBySize{unit, true};
    }
  }
  if (!found && fits(LengthUnit::inch)) found = UnitBySize{LengthUnit::inch, true};
  return found;
}

}  // namespace semblante
