#include "core/parametrize/influence.h"

#include <algorithm>

#include "core/anatomy/jaw_share.h"
#include "core/parametrize/attached_vertices.h"

namespace semblante {
namespace {

/// Builder of one row: ids are rising, weights of equal ids are added.
class InfluenceRow {
 public:
  explicit InfluenceRow(WeightMethod method) : method_(method) {}
  void add(FeaturePointId id, double weight) {
    if (!(weight > 0.0)) return;
    if (entries_.empty() || entries_.back().id < id) {  // as a rule: rows have rising ids
      entries_.push_back({id, weight});
      return;
    }
    const auto at = std::lower_bound(entries_.begin(), entries_.end(), id,
                                     [](const Entry& e, FeaturePointId wanted) { return e.id < wanted; });
    if (at != entries_.end() && at->id == id) {
      at->weight += weight;
    } else {
      entries_.insert(at, {id, weight});
    }
  }
  void add_row(const WeightTable<double>& weights, SurfaceVertexId vertex, double share) {
    const auto ids = weights.points_of(vertex.value());
    const auto values = weights.weights_of(vertex.value());
    double sum = 0.0;
    for (const double w : values) sum += w;
    if (are_shares(method_)) sum = sum > 0.0 ? 1.0 : 0.0;  // the rest belongs to the root
    if (!(sum > 0.0)) return;                              // no influencing point: the vertex does not move
    for (std::size_t k = 0; k < ids.size(); ++k) add(ids[k], share * (values[k] / sum));
  }
  void write_to(WeightTable<float>& table) {
    for (const Entry& e : entries_) table.push(e.id, static_cast<float>(e.weight));
    table.end_row();
    entries_.clear();
  }

 private:
  struct Entry {
    FeaturePointId id;
    double weight;
  };
  WeightMethod method_;
  std::vector<Entry> entries_;
};

}  // namespace

WeightTable<float> influence_with_roles(const Surface& surface, std::span<const Part> parts,
                                        std::span<const SurfacePoint> points, std::span<const MouthShare> mouth,
                                        const WeightTable<double>& weights, WeightMethod method) {
  const std::optional<FeaturePointId> jaw = parse_feature_point("2.1");
  const bool has_jaw = std::any_of(points.begin(), points.end(), [&](const SurfacePoint& p) { return p.id == *jaw; });
  const auto followed = followed_by_attached(surface, parts, points);

  WeightTable<float> table;
  InfluenceRow row(method);
  for (std::uint32_t s = 0; s < surface.vertex_count(); ++s) {
    const SurfaceVertexId vertex(s);
    switch (parts[surface.part_of[s].value()].role) {
      case PartRole::skin:
        row.add_row(weights, vertex, 1.0);
        break;
      case PartRole::attached:
        for (const auto& [skin, share] : followed[s]) row.add_row(weights, skin, share);
        break;
      case PartRole::tongue:
        row.add_row(weights, vertex, mouth[s].tongue);
        if (has_jaw) row.add(*jaw, mouth[s].jaw);
        break;
      case PartRole::lower_teeth:
      case PartRole::upper_teeth:
        if (has_jaw) row.add(*jaw, mouth[s].jaw);
        break;
      case PartRole::left_eye:
      case PartRole::right_eye:
      case PartRole::rest:
      case PartRole::body:
        break;
    }
    row.write_to(table);
  }
  return table;
}

}  // namespace semblante
