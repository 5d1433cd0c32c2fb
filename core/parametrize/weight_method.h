#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace semblante {

/// How the weights of the feature points are computed.
enum class WeightMethod : std::uint8_t {
  paper,   ///< W of Eq. 1 to 4, exactly; Eq. 7 divides them by their sum
  smooth,  ///< kriging without negative weights: continuous over the surface, at most 8 points per vertex
  fitted,  ///< smooth weights, fitted to the head's own shapes
};
inline constexpr std::array<std::string_view, 3> weight_method_names = {"paper", "smooth", "fitted"};

/// Whether a row of weights is the shares by which a vertex follows its points, D_P = sum(w D), the remainder of a row
/// to 1 belonging to points that never move. False: W of Eq. 4, which Eq. 7 divides by their sum.
constexpr bool are_shares(WeightMethod method) { return method != WeightMethod::paper; }

/// The paths along which surface distances are measured.
enum class DistanceMetric : std::uint8_t {
  edge,      ///< mesh edges, as in the paper
  unfolded,  ///< also the diagonals of unfolded neighbouring triangles: closer to the geodesic
};
inline constexpr std::array<std::string_view, 2> distance_metric_names = {"edge", "unfolded"};

/// The method or metric of that name; empty for any other.
inline std::optional<WeightMethod> parse_weight_method(std::string_view name) {
  for (std::size_t i = 0; i < weight_method_names.size(); ++i) {
    if (name == weight_method_names[i]) return static_cast<WeightMethod>(i);
  }
  return std::nullopt;
}
inline std::optional<DistanceMetric> parse_distance_metric(std::string_view name) {
  if (name == distance_metric_names[0]) return DistanceMetric::edge;
  if (name == distance_metric_names[1]) return DistanceMetric::unfolded;
  return std::nullopt;
}

}  // namespace semblante
