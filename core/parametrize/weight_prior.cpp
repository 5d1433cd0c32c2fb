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

bool on_any_edge(std::size_t id) {
  return std::any_of(mpeg4::openings.begin(), mpeg4::openings.end(),
                     [&](const mpeg4::Opening& o) { return on_edge(o, id); });
}

/// By id: whether the point lies on the edge of a lip or lid.
const std::array<bool, feature_point_count>& are_on_edges() {
  static const std::array<bool, feature_point_count> on_edges = [] {
    std::array<bool, feature_point_count> result{};
    for (std::size_t id = 0; id < result.size(); ++id) result[id] = on_any_edge(id);
    return result;
  }();
  return on_edges;
}

bool is_of_eyes_or_brows(std::size_t id) {
  const std::string_view name = mpeg4::feature_points[id].id;
  return name.starts_with("3.") || name.starts_with("4.");
}

}  // namespace

bool WeightPrior::allows(std::size_t i, std::size_t j) {
  if (j >= first_product && is_of_eyes_or_brows(i)) return false;
  if (j >= first_axis) return !on_any_edge(i);
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
  double on_edges = 0.0;
  row.for_each([&, &is_on_edge = are_on_edges()](std::size_t id, double w) { on_edges += is_on_edge[id] ? w : 0.0; });
  return 1.0 - on_edges;
}

WeightPrior::WeightPrior(std::span<const Entry> entries) {
  struct Placed {
    std::size_t cell;
    Correction correction;
  };
  std::vector<Placed> placed;
  const auto place = [&](std::size_t i, std::size_t j, std::size_t k, double factor) {
    const auto [low, high] = std::minmax(i, j);
    placed.push_back({cell(low, high), {static_cast<std::uint8_t>(high), static_cast<std::uint8_t>(k), factor}});
  };
  for (const Entry& e : entries) {
    const double factor = e.hundredths / 100.0;
    const std::size_t i = mirrored(e.i);
    const std::size_t j = mirrored(e.j);
    const std::size_t k = mirrored(e.k);
    place(e.i, e.j, e.k, factor);
    const bool is_own_image = std::minmax(i, j) == std::minmax<std::size_t>(e.i, e.j) && k == e.k;
    if (!is_own_image) place(i, j, k, sign_of_image(e.j) * factor);
  }
  std::stable_sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) { return a.cell < b.cell; });
  offsets_.assign(column_count * column_count + 1, 0);
  for (const Placed& p : placed) {
    ++offsets_[p.cell + 1];
    corrected_[p.cell / column_count].insert(p.correction.point);
    corrections_.push_back(p.correction);
  }
  std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
}

void WeightPrior::correct(WeightRow& row, const glm::dvec3& position, const Places& places) const {
  if (offsets_.empty()) return;
  std::array<std::uint8_t, feature_point_count> ids;
  std::array<double, feature_point_count> shares;
  std::size_t count = 0;
  double sum = 0.0;
  row.for_each([&](std::size_t id, double w) {
    if (!(w > 0.0)) return;
    sum += w;
    shares[count] = w;
    ids[count++] = static_cast<std::uint8_t>(id);
  });
  if (count == 0) return;
  std::array<double, feature_point_count> change{};
  SlotSet changed;
  const double off_edges = share_off_edges(row);
  for (std::size_t a = 0; a < count; ++a) {
    const std::size_t i = ids[a];
    changed.unite(corrected_[i]);
    for (std::size_t b = a + 1; b < count; ++b) {
      const auto of_pair = between(cell(i, ids[b]), cell(i, ids[b]) + 1);
      if (of_pair.empty() || places[i].vertex == places[ids[b]].vertex) continue;
      const double amount = shares[a] * shares[b];
      for (const Correction& c : of_pair) change[c.point] += amount * c.factor;
    }
    if (sum < 1.0) {
      const double amount = shares[a] * (1.0 - sum) * sum;
      for (const Correction& c : between(cell(i, root), cell(i, first_axis))) change[c.point] += amount * c.factor;
    }
    const auto of_offsets = between(cell(i, first_axis), cell(i, column_count));
    if (of_offsets.empty()) continue;
    OffsetTerms amounts = offset_terms(position - places[i].position);
    for (double& amount : amounts) amount = shares[a] * amount * off_edges;
    for (const Correction& c : of_offsets) change[c.point] += amounts[c.column - first_axis] * c.factor;
  }
  changed.for_each([&](std::size_t id) {
    const double more = change[id];
    if (more == 0.0 || places[id].vertex == nowhere || (more < 0.0 && row[id] == 0.0)) return;
    double& w = row.at(id);
    if (more > 0.0) {
      w += more;
    } else {
      w *= w / (w - more);
    }
  });
  const double corrected = sum_of(row);
  if (corrected > 1.0) row.for_each([&](std::size_t, double& w) { w /= corrected; });
}

const WeightPrior& trained_weight_prior() {
  static const WeightPrior prior{trained_entries};
  return prior;
}

}  // namespace semblante
