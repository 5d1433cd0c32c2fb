#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace semblante {

/// How the weights of the feature points come about.
enum class WeightMethod : std::uint8_t {
  paper,   ///< W of Eq. 1 to 4, exactly; Eq. 7 divides them by their sum
  smooth,  ///< kriging without negative weights: continuous over the surface, at most 8 points a vertex
};
inline constexpr std::array<std::string_view, 2> weight_method_names = {"paper", "smooth"};

}  // namespace semblante
