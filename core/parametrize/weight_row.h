#pragma once

#include <array>
#include <cstddef>

#include "core/parametrize/slot_set.h"

namespace semblante {

/// Weights of all feature points at one vertex. Few are not zero: a list of those that may be spares loops over all.
class WeightRow {
 public:
  [[nodiscard]] double operator[](std::size_t id) const { return weights_[id]; }
  /// For writing.
  [[nodiscard]] double& at(std::size_t id) {
    listed_.insert(id);
    return weights_[id];
  }
  /// Calls `visit(id, weight)` in rising order of ids: for every weight that is not zero, and for some that are zero.
  template <class Visit>
  void for_each(Visit visit) const {
    listed_.for_each([&](std::size_t id) { visit(id, weights_[id]); });
  }
  /// The same with weights that `visit` may change.
  template <class Visit>
  void for_each(Visit visit) {
    listed_.for_each([&](std::size_t id) { visit(id, weights_[id]); });
  }
  void scale(double factor) {
    for_each([&](std::size_t, double& w) { w *= factor; });
  }
  void clear() {
    for_each([](std::size_t, double& w) { w = 0.0; });
    listed_ = {};
  }
  [[nodiscard]] bool operator==(const WeightRow& other) const { return weights_ == other.weights_; }

 private:
  std::array<double, feature_point_count> weights_{};
  SlotSet listed_;
};

inline double sum_of(const WeightRow& row) {
  double sum = 0.0;
  row.for_each([&](std::size_t, double w) { sum += w; });
  return sum;
}

}  // namespace semblante
