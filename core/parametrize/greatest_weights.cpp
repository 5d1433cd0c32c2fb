#include "core/parametrize/greatest_weights.h"

#include <algorithm>
#include <array>
#include <span>

namespace semblante {

void keep_greatest(WeightRow& weights) {
  struct Entry {
    double weight;
    std::size_t id;
  };
  std::array<Entry, feature_point_count> positive;
  std::size_t count = 0;
  weights.for_each([&](std::size_t id, double weight) {
    positive[count] = {weight, id};
    count += weight > 0.0 ? 1 : 0;
  });
  if (count <= max_smooth_influences) return;
  // The greatest first, of equal ones the lower id; and the first that is dropped.
  std::array<Entry, max_smooth_influences + 1> greatest{};
  double all = 0.0;
  for (const Entry& entry : std::span(positive).first(count)) {
    all += entry.weight;
    if (!(entry.weight > greatest.back().weight)) continue;
    std::size_t at = max_smooth_influences;
    for (; at > 0 && entry.weight > greatest[at - 1].weight; --at) greatest[at] = greatest[at - 1];
    greatest[at] = entry;
  }
  const double first_out = greatest.back().weight;
  double kept = 0.0;
  double lowered = 0.0;
  for (std::size_t k = 0; k < max_smooth_influences; ++k) {
    kept += greatest[k].weight;
    lowered += greatest[k].weight - first_out;
  }
  const double share = std::min(1.0, lowered / (all / 4.0));  // of the continuous choice
  weights.clear();
  for (std::size_t k = 0; k < max_smooth_influences; ++k) {
    const double w = greatest[k].weight;
    weights.at(greatest[k].id) =
        all * ((share > 0.0 ? share * (w - first_out) / lowered : 0.0) + (1.0 - share) * w / kept);
  }
}

void push_row(WeightTable<double>& table, const WeightRow& weights) {
  weights.for_each([&](std::size_t id, double w) {
    if (w >= least_weight) table.push(FeaturePointId(static_cast<std::uint8_t>(id)), w);
  });
  table.end_row();
}

}  // namespace semblante
