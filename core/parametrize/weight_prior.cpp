#include "core/parametrize/weight_prior.h"

#include <algorithm>
#include <numeric>

#include "core/tables/mpeg4.h"
#include "core/tables/openings.h"

namespace semblante {
namespace {

constexpr WeightPrior::Entry trained_entries[] = {
#include "core/parametrize/weight_prior_table.inc"
};

bool on_edge(const mpeg4::Opening& opening, std::size_t id) {
  if (id == WeightPrior::root) return false;
  for (const auto& names : {opening.upper, opening.lower, opening.corners}) {
    for (const std::string_view name : names) {
      if (parse_feature_point(name)->value() == id) return true;
    }
  }
  return false;
}

}  // namespace

bool WeightPrior::allows(std::size_t i, std::size_t j) {
  return std::none_of(mpeg4::openings.begin(), mpeg4::openings.end(),
                      [&](const mpeg4::Opening& o) { return on_edge(o, i) && on_edge(o, j); });
}

std::size_t WeightPrior::mirrored(std::size_t id) { return id == root ? root : mpeg4::feature_points[id].mirror; }

WeightPrior::WeightPrior(std::span<const Entry> entries) {
  struct Placed {
    std::size_t cell;
    Correction correction;
  };
  std::vector<Placed> placed;
  for (const Entry& e : entries) {
    const double factor = e.hundredths / 100.0;
    placed.push_back({cell(std::min(e.i, e.j), std::max(e.i, e.j)), {e.k, factor}});
    const auto [i, j] = std::minmax({mirrored(e.i), mirrored(e.j)});
    const std::size_t k = mirrored(e.k);
    if (cell(i, j) == placed.back().cell && k == e.k) continue;
    placed.push_back({cell(i, j), {static_cast<std::uint8_t>(k), factor}});
  }
  std::stable_sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) { return a.cell < b.cell; });
  offsets_.assign((feature_point_count + 1) * (feature_point_count + 1) + 1, 0);
  for (const Placed& p : placed) {
    ++offsets_[p.cell + 1];
    corrections_.push_back(p.correction);
  }
  std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
}

void WeightPrior::correct(WeightRow& row, const Places& places) const {
  if (offsets_.empty()) return;
  std::array<std::uint8_t, feature_point_count + 1> ids{};
  std::array<double, feature_point_count + 1> shares{};
  std::size_t count = 0;
  double sum = 0.0;
  for (std::size_t id = 0; id < row.size(); ++id) {
    if (!(row[id] > 0.0)) continue;
    sum += row[id];
    shares[count] = row[id];
    ids[count++] = static_cast<std::uint8_t>(id);
  }
  if (count == 0) return;
  if (sum < 1.0) {
    shares[count] = 1.0 - sum;
    ids[count++] = root;
  }
  WeightRow change{};
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = a + 1; b < count; ++b) {
      if (ids[b] != root && places[ids[a]] == places[ids[b]]) continue;
      const double both = shares[a] * shares[b] * (ids[b] == root ? sum : 1.0);
      const std::size_t at = cell(ids[a], ids[b]);
      for (std::uint32_t c = offsets_[at]; c < offsets_[at + 1]; ++c) {
        const Correction& correction = corrections_[c];
        if (places[correction.point] != nowhere) change[correction.point] += both * correction.factor;
      }
    }
  }
  double corrected = 0.0;
  for (std::size_t id = 0; id < row.size(); ++id) {
    double& w = row[id];
    if (change[id] >= 0.0) {
      w += change[id];
    } else if (w > 0.0) {
      w *= w / (w - change[id]);
    }
    corrected += w;
  }
  if (corrected <= 1.0) return;
  for (double& w : row) w /= corrected;
}

const WeightPrior& trained_weight_prior() {
  static const WeightPrior prior{trained_entries};
  return prior;
}

}  // namespace semblante
