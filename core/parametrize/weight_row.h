#pragma once

#include <array>
#include <cstddef>

#include "core/types/feature_point_id.h"

namespace semblante {

/// Weights of all feature points at one vertex.
using WeightRow = std::array<double, feature_point_count>;

/// Four sums side by side: additions need not wait for each other.
inline double sum_of(const WeightRow& row) {
  static_assert(feature_point_count % 4 == 0);
  std::array<double, 4> sums{};
  for (std::size_t id = 0; id < row.size(); id += 4) {
    for (std::size_t k = 0; k < 4; ++k) sums[k] += row[id + k];
  }
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace semblante
