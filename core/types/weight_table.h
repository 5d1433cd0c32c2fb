#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types/feature_point_id.h"

namespace semblante {

/// Rows of (feature point, weight), one row per vertex, in one allocation. Ids increase within a row.
/// W is double for the weights of Eq. 4, float for the normalized quotients of Eq. 7 that clients use.
template <class W>
struct WeightTable {
  std::vector<std::uint32_t> offsets{0};  ///< #V + 1
  std::vector<FeaturePointId> points;     ///< #entries
  std::vector<W> weights;                 ///< #entries

  [[nodiscard]] std::size_t row_count() const { return offsets.size() - 1; }
  [[nodiscard]] std::span<const FeaturePointId> points_of(std::size_t row) const {
    return std::span(points).subspan(offsets[row], offsets[row + 1] - offsets[row]);
  }
  [[nodiscard]] std::span<const W> weights_of(std::size_t row) const {
    return std::span(weights).subspan(offsets[row], offsets[row + 1] - offsets[row]);
  }
  void push(FeaturePointId point, W weight) {
    points.push_back(point);
    weights.push_back(weight);
  }
  void end_row() { offsets.push_back(static_cast<std::uint32_t>(points.size())); }
};

}  // namespace semblante
