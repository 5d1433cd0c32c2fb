#include "core/parametrize/weight_prior.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "core/tables/mpeg4.h"
#include "core/tables/openings.h"

namespace semblante {
namespace {

constexpr WeightPrior::Entry trained_entries[] = {
#include "core/parametrize/weight_prior_table.inc"
};

bool on_edge(const mpeg4::Opening& opening, std::size_t id) {
  if (id >= WeightPrior::root) return false;
  for (const auto& names : {opening.upper, opening.lower, opening.corners}) {
    for (const std::string_view name : names) {
      if (parse_feature_point(name)->value() == id) return true;
    }
  }
  return false;
}

/// 1 for points on the edge of a lip or lid, 0 for others.
const WeightRow& edge_points() {
  static const WeightRow marked = [] {
    WeightRow on_edges{};
    for (std::size_t id = 0; id < on_edges.size(); ++id) {
      const bool is_on_one = std::any_of(mpeg4::openings.begin(), mpeg4::openings.end(),
                                         [&](const mpeg4::Opening& o) { return on_edge(o, id); });
      on_edges[id] = is_on_one ? 1.0 : 0.0;
    }
    return on_edges;
  }();
  return marked;
}

bool is_of_eyes_or_brows(std::size_t id) {
  const std::string_view name = mpeg4::feature_points[id].id;
  return name.starts_with("3.") || name.starts_with("4.");
}

}  // namespace

bool WeightPrior::allows(std::size_t i, std::size_t j) {
  if (j >= first_product && is_of_eyes_or_brows(i)) return false;
  if (j >= first_axis) return edge_points()[i] == 0.0;
  return std::none_of(mpeg4::openings.begin(), mpeg4::openings.end(),
                      [&](const mpeg4::Opening& o) { return on_edge(o, i) && on_edge(o, j); });
}

std::size_t WeightPrior::mirrored(std::size_t id) { return id >= root ? id : mpeg4::feature_points[id].mirror; }

double WeightPrior::sign_of_image(std::size_t j) {
  constexpr std::array<std::size_t, 3> odd = {first_axis, first_product + 3, first_product + 4};
  return std::find(odd.begin(), odd.end(), j) != odd.end() ? -1.0 : 1.0;
}

WeightPrior::OffsetTerms WeightPrior::offset_terms(const glm::dvec3& offset) {
  const glm::dvec3 u = offset / offset_unit;
  return {u.x, u.y, u.z, u.x * u.x, u.y * u.y, u.z * u.z, u.x * u.y, u.x * u.z, u.y * u.z};
}

double WeightPrior::share_off_edges(const WeightRow& row) {
  const double on_edges = std::inner_product(row.begin(), row.end(), edge_points().begin(), 0.0);
  return 1.0 - on_edges;
}

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
    placed.push_back({cell(i, j), {static_cast<std::uint8_t>(k), sign_of_image(e.j) * factor}});
  }
  std::stable_sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) { return a.cell < b.cell; });
  offsets_.assign(column_count * column_count + 1, 0);
  for (const Placed& p : placed) {
    ++offsets_[p.cell + 1];
    corrections_.push_back(p.correction);
  }
  std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
}

void WeightPrior::correct(WeightRow& row, const glm::dvec3& position, const Places& places) const {
  if (offsets_.empty()) return;
  std::array<std::uint8_t, feature_point_count> ids{};
  std::array<double, feature_point_count> shares{};
  std::size_t count = 0;
  double sum = 0.0;
  for (std::size_t id = 0; id < row.size(); ++id) {
    if (!(row[id] > 0.0)) continue;
    sum += row[id];
    shares[count] = row[id];
    ids[count++] = static_cast<std::uint8_t>(id);
  }
  if (count == 0) return;
  WeightRow change{};
  const auto add = [&](std::size_t i, std::size_t j, double amount) {
    const std::size_t at = cell(i, j);
    for (std::uint32_t c = offsets_[at]; c < offsets_[at + 1]; ++c) {
      const Correction& correction = corrections_[c];
      if (places[correction.point].vertex != nowhere) change[correction.point] += amount * correction.factor;
    }
  };
  const double off_edges = share_off_edges(row);
  for (std::size_t a = 0; a < count; ++a) {
    const std::size_t i = ids[a];
    for (std::size_t b = a + 1; b < count; ++b) {
      if (places[i].vertex != places[ids[b]].vertex) add(i, ids[b], shares[a] * shares[b]);
    }
    if (sum < 1.0) add(i, root, shares[a] * (1.0 - sum) * sum);
    const OffsetTerms terms = offset_terms(position - places[i].position);
    for (std::size_t t = 0; t < terms.size(); ++t) add(i, first_axis + t, shares[a] * terms[t] * off_edges);
  }
  double corrected = 0.0;
  for (std::size_t id = 0; id < row.size(); ++id) {
    double& w = row[id];
    if (w == 0.0 && change[id] == 0.0) continue;  // most
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
