#pragma once

#include <initializer_list>
#include <utility>

#include "core/bridges/arkit.h"

namespace semblante {

/// The named coefficients as given, the others 0.
inline ArkitCoefficients coefficients_with(std::initializer_list<std::pair<const char*, float>> given) {
  ArkitCoefficients c{};
  for (const auto& [name, value] : given) c.at(find_arkit(name).value()) = value;
  return c;
}

}  // namespace semblante
