#include "core/parametrize/greatest_weights.h"

#include <algorithm>
#include <array>

namespace semblante {

void keep_greatest(WeightRow& weights) {
  const auto positive = std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0.0; });
  if (static_cast<std::size_t>(positive) <= max_smooth_influences) return;
  // The greatest first, of equal ones the lower id; and the first that is dropped.
  struct Entry {
    double weight = 0.0;
    std::size_t id = 0;
  };
  std::array<Entry, max_smooth_influences + 1> greatest{};
  for (std::size_t id = 0; id < weights.size(); ++id) {
    const double weight = weights[id];
    if (!(weight > greatest.back().weight)) continue;
    std::size_t at = max_smooth_influences;
    for (; at > 0 && weight > greatest[at - 1].weight; --at) greatest[at] = greatest[at - 1];
    greatest[at] = {weight, id};
  }
  const double first_out = greatest.back().weight;
  const double all = sum_of(weights);
  double kept = 0.0;
  double lowered = 0.0;
  for (std::size_t k = 0; k < max_smooth_influences; ++k) {
    kept += greatest[k].weight;
    lowered += greatest[k].weight - first_out;
  }
  const double share = std::min(1.0, lowered / (all / 4.0));  // of the continuous choice
  weights.fill(0.0);
  for (std::size_t k = 0; k < max_smooth_influences; ++k) {
    const double w = greatest[k].weight;
    weights[greatest[k].id] =
        all * ((share > 0.0 ? share * (w - first_out) / lowered : 0.0) + (1.0 - share) * w / kept);
  }
}

void push_row(WeightTable<double>& table, const WeightRow& weights) {
  for (std::size_t id = 0; id < weights.size(); ++id) {
    if (weights[id] >= least_weight) table.push(FeaturePointId(static_cast<std::uint8_t>(id)), weights[id]);
  }
  table.end_row();
}

}  // namespace semblante
