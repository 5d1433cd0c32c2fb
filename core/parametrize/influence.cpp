#include "core/parametrize/influence.h"

#include <algorithm>
#include <limits>
#include <queue>

#include "core/anatomy/jaw_share.h"
#include "core/geometry/nearest_point.h"

namespace semblante {
namespace {

/// Builder of one row: ids are rising, weights of equal ids are added.
class InfluenceRow {
 public:
  explicit InfluenceRow(WeightMethod method) : method_(method) {}
  void add(FeaturePointId id, double weight) {
    if (!(weight > 0.0)) return;
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

/// For every vertex of attached parts the skin vertex it follows.
///
/// A lash is attached to the lid by its root: its tip must not follow the brow, which may be nearer. So a vertex
/// follows the skin vertex with the shortest path to it, where lengths through the air count several times those along
/// the part.
class AttachedVertices {
 public:
  AttachedVertices(const Surface& surface, std::span<const Part> parts)
      : surface_(surface), anchor_(surface.vertex_count()), cost_(surface.vertex_count(), infinite) {
    std::vector<glm::dvec3> skin;
    std::vector<SurfaceVertexId> skin_vertices;
    for (std::uint32_t p = 0; p < parts.size(); ++p) {
      if (parts[p].role != PartRole::skin) continue;
      for (const SurfaceVertexId v : surface.members_of(PartId(p))) {
        skin.push_back(surface.positions[v.value()]);
        skin_vertices.push_back(v);
      }
    }
    if (skin.empty()) return;
    const NearestPoint near_skin(skin);
    for (std::uint32_t p = 0; p < parts.size(); ++p) {
      if (parts[p].role != PartRole::attached) continue;
      for (const SurfaceVertexId v : surface.members_of(PartId(p))) {
        const NearestPoint::Hit hit = near_skin.nearest(surface.positions[v.value()]);
        anchor_[v.value()] = skin_vertices[hit.index];
        lower(v, air * hit.distance, skin_vertices[hit.index]);
      }
    }
    spread();
  }

  [[nodiscard]] std::optional<SurfaceVertexId> followed_by(SurfaceVertexId vertex) const {
    if (cost_[vertex.value()] == infinite) return std::nullopt;
    return anchor_[vertex.value()];
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  static constexpr double air = 4.0;

  void lower(SurfaceVertexId vertex, double cost, SurfaceVertexId anchor) {
    if (cost >= cost_[vertex.value()]) return;
    cost_[vertex.value()] = cost;
    anchor_[vertex.value()] = anchor;
    queue_.emplace(cost, vertex);
  }
  void spread() {
    while (!queue_.empty()) {
      const auto [cost, vertex] = queue_.top();
      queue_.pop();
      if (cost > cost_[vertex.value()]) continue;
      for (const Surface::Step& step : surface_.steps_from(vertex)) {
        lower(step.to, cost + step.length, anchor_[vertex.value()]);
      }
    }
  }

  const Surface& surface_;
  std::vector<SurfaceVertexId> anchor_;
  std::vector<double> cost_;
  std::priority_queue<std::pair<double, SurfaceVertexId>, std::vector<std::pair<double, SurfaceVertexId>>,
                      std::greater<>>
      queue_;
};

}  // namespace

WeightTable<float> influence_with_roles(const Surface& surface, std::span<const Part> parts,
                                        std::span<const SurfacePoint> points, std::span<const MouthShare> mouth,
                                        const WeightTable<double>& weights, WeightMethod method) {
  const std::optional<FeaturePointId> jaw = parse_feature_point("2.1");
  const bool has_jaw = std::any_of(points.begin(), points.end(), [&](const SurfacePoint& p) { return p.id == *jaw; });
  const AttachedVertices attached(surface, parts);

  WeightTable<float> table;
  InfluenceRow row(method);
  for (std::uint32_t s = 0; s < surface.vertex_count(); ++s) {
    const SurfaceVertexId vertex(s);
    switch (parts[surface.part_of[s].value()].role) {
      case PartRole::skin:
        row.add_row(weights, vertex, 1.0);
        break;
      case PartRole::attached:
        if (const auto followed = attached.followed_by(vertex)) row.add_row(weights, *followed, 1.0);
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
