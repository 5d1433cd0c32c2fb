#pragma once

#include <string>

namespace semblante {

/// How far a face articulates: the multiple of the library's opening of the jaw in its visemes.
inline constexpr double usual_articulation = 1.0;
inline constexpr double least_articulation = 0.25;
inline constexpr double most_articulation = 4.0;
constexpr bool is_articulation(double value) { return value >= least_articulation && value <= most_articulation; }

/// A value of it and where it comes from, as a sentence for people.
struct Articulation {
  double value = usual_articulation;
  std::string reason;
};

}  // namespace semblante
