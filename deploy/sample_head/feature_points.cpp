#include "deploy/sample_head/feature_points.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

#include <glm/geometric.hpp>

#include "deploy/sample_head/hair.h"
#include "deploy/sample_head/sculpt.h"

namespace semblante::sample_head_detail {
namespace {

/// Left or middle FP, right FP. The rule of odd and even is not general: 8.10, 9.5, 9.7 and 11.3 are on the left.
constexpr std::pair<const char*, const char*> mirror_pairs[] = {
    {"2.4", "2.5"},    {"2.6", "2.7"},   {"2.8", "2.9"},   {"2.11", "2.12"}, {"2.13", "2.14"}, {"3.1", "3.2"},
    {"3.3", "3.4"},    {"3.5", "3.6"},   {"3.7", "3.12"},  {"3.9", "3.10"},  {"3.11", "3.8"},  {"3.13", "3.14"},
    {"4.1", "4.2"},    {"4.3", "4.4"},   {"4.5", "4.6"},   {"5.1", "5.2"},   {"5.3", "5.4"},   {"6.3", "6.4"},
    {"8.3", "8.4"},    {"8.5", "8.6"},   {"8.7", "8.8"},   {"8.10", "8.9"},  {"9.1", "9.2"},   {"9.5", "9.4"},
    {"9.7", "9.6"},    {"9.13", "9.14"}, {"10.1", "10.2"}, {"10.3", "10.4"}, {"10.5", "10.6"}, {"10.7", "10.8"},
    {"10.9", "10.10"}, {"11.3", "11.2"},
};

class Marker {
 public:
  explicit Marker(Skin& skin) : skin_(skin), open_(skin.mesh.positions.size(), false) {
    for (const auto& face : skin.mesh.faces) {
      for (const int v : face.corner) {
        if (v >= 0 && face.chart == Chart::outer) open_[static_cast<std::size_t>(v)] = true;
      }
    }
    for (const auto& [id, v] : skin.marks) open_[static_cast<std::size_t>(v)] = false;
  }

  /// Moves the nearest vertex of the open skin to `place` and marks it. For a place in the mirror plane, uses only
  /// vertices in that plane.
  void at(const std::string& id, const Vec3& place) {
    const auto& p = skin_.mesh.positions;
    int best = -1;
    for (std::size_t v = 0; v < p.size(); ++v) {
      if (!open_[v] || (p[v].x == 0.0) != (place.x == 0.0)) continue;
      if (best < 0 || glm::distance(p[v], place) < glm::distance(p[static_cast<std::size_t>(best)], place)) {
        best = static_cast<int>(v);
      }
    }
    assert(best >= 0);
    skin_.mesh.positions[static_cast<std::size_t>(best)] = place;
    take(id, best);
  }

  /// Marks the vertex of the middle line within `low`..`high` that is farthest along `direction`.
  void furthest_of_middle(const std::string& id, const Vec3& direction, double low, double high, double min_z) {
    const auto& p = skin_.mesh.positions;
    int best = -1;
    for (std::size_t v = 0; v < p.size(); ++v) {
      if (!open_[v] || p[v].x != 0.0 || p[v].y < low || p[v].y > high || p[v].z < min_z) continue;
      if (best < 0 || glm::dot(p[v], direction) > glm::dot(p[static_cast<std::size_t>(best)], direction)) {
        best = static_cast<int>(v);
      }
    }
    assert(best >= 0);
    take(id, best);
  }

  [[nodiscard]] Vec3 place_of(const std::string& id) const {
    return skin_.mesh.positions[static_cast<std::size_t>(skin_.marks.find(id)->second)];
  }

 private:
  void take(const std::string& id, int v) {
    skin_.marks[id] = v;
    open_[static_cast<std::size_t>(v)] = false;
  }

  Skin& skin_;
  std::vector<bool> open_;
};

Vec3 on_front(double x, double y) { return {x, y, front_z(x, y)}; }
Vec3 on_front(const Vec2& p) { return on_front(p.x, p.y); }

/// A place on the hair's border.
Vec3 on_hairline(double azimuth) {
  const double e = hairline(azimuth);
  return cast_from_inside(hair_centre, {azimuth == 0.0 ? 0.0 : std::cos(e) * std::sin(azimuth), std::sin(e),
                                        std::cos(e) * std::cos(azimuth)});
}

}  // namespace

std::string mirror_of(const std::string& id) {
  for (const auto& [left, right] : mirror_pairs) {
    if (id == left) return right;
  }
  return id;
}

void mark_skin_points(Skin& skin) {
  Marker mark(skin);
  const Vec3 forward(0.0, 0.0, 1.0);
  mark.furthest_of_middle("9.3", forward, -5.0, -2.0, 8.0);
  mark.furthest_of_middle("2.10", forward, -10.8, -9.2, 6.0);
  mark.furthest_of_middle("2.1", {0.0, -1.0, 0.0}, -12.5, -10.0, 7.0);
  mark.furthest_of_middle("11.6", -forward, -3.0, 8.0, -20.0);

  mark.at("2.11", on_front(1.9, -10.25));
  mark.at("2.13", project_to_head({5.4, -7.3, 1.4}));

  const double brow_start = 0.03;
  const double brow_end = 0.97;
  mark.at("4.1", on_front(brow_line(brow_start)));
  mark.at("4.5", on_front(brow_line(brow_end)));
  mark.at("4.3", on_front(brow_line(0.5 * (brow_start + brow_end))));

  mark.at("5.1", on_front(4.4, mark.place_of("8.3").y));
  mark.at("5.3", on_front(4.0, -2.75));

  mark.at("9.1", project_to_head({1.78, -3.95, 9.5}));
  mark.at("9.5", project_to_head({1.25, -4.75, 9.15}));
  const double bone_top = 0.2;
  const double bone_edge = 0.5 * (bone_top + mark.place_of("9.3").y);
  mark.at("9.7", on_front(0.78, bone_top));
  mark.at("9.12", on_front(0.0, bone_edge));
  mark.at("9.13", on_front(0.80, bone_edge));

  mark.at("11.1", on_hairline(0.0));
  mark.at("11.3", on_hairline(0.72));
  mark.at("11.4", cast_from_inside(hair_centre, {0.0, 1.0, 0.0}));
}

}  // namespace semblante::sample_head_detail
