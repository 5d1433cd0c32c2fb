#include "core/parametrize/greatest_weights.h"

#include <algorithm>

namespace semblante {

void keep_greatest(WeightRow& weights, std::vector<std::size_t>& order) {
  const auto positive = std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0.0; });
  if (static_cast<std::size_t>(positive) <= max_smooth_influences) return;
  order.clear();
  for (std::size_t id = 0; id < weights.size(); ++id) {
    if (weights[id] > 0.0) order.push_back(id);
  }
  std::partial_sort(
      order.begin(), order.begin() + max_smooth_influences + 1, order.end(),
      [&](std::size_t a, std::size_t b) { return weights[a] != weights[b] ? weights[a] > weights[b] : a < b; });
  const double first_out = weights[order[max_smooth_influences]];
  const double all = sum_of(weights);
  double kept = 0.0;
  double lowered = 0.0;
  for (std::size_t k = 0; k < max_smooth_influences; ++k) {
    kept += weights[order[k]];
    lowered += weights[order[k]] - first_out;
  }
  const double share = std::min(1.0, lowered / (all / 4.0));  // of the continuous choice
  for (std::size_t k = 0; k < order.size(); ++k) {
    double& w = weights[order[k]];
    if (k >= max_smooth_influences) {
      w = 0.0;
    } else {
      w = all * ((share > 0.0 ? share * (w - first_out) / lowered : 0.0) + (1.0 - share) * w / kept);
    }
  }
}

void push_row(WeightTable<double>& table, const WeightRow& weights) {
  for (std::size_t id = 0; id < weights.size(); ++id) {
    if (weights[id] >= least_weight) table.push(FeaturePointId(static_cast<std::uint8_t>(id)), weights[id]);
  }
  table.end_row();
}

}  // namespace semblante
