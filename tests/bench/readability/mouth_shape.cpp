#include "tests/bench/readability/mouth_shape.h"

#include <algorithm>
#include <array>
#include <limits>

#include <glm/geometric.hpp>

#include "core/anatomy/point_lookup.h"

namespace semblante::bench {
namespace {

constexpr std::array inner_lip_names = {"2.2", "2.3", "2.6", "2.7", "2.8", "2.9"};
constexpr std::array lower_lip_names = {"2.3", "2.8", "2.9", "8.2", "8.7", "8.8"};
/// Places where the edge of the teeth is sought, over the middle eighth of the mouth.
constexpr std::size_t places = 5;
constexpr double middle_share = 0.12;
/// How far behind the marked edge a tooth still is one of the front, of MNS0.
constexpr double depth_of_edge = 0.1;
/// A triangle is of the lower lip whose corners follow its points by this share.
constexpr double least_share = 0.5;

/// The point of the triangle nearest to p. By the regions of its plane (Ericson, Real-Time Collision Detection, 5.1.5).
glm::dvec3 nearest_on(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a;
  const glm::dvec3 ac = c - a;
  const double d1 = glm::dot(ab, p - a);
  const double d2 = glm::dot(ac, p - a);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const double d3 = glm::dot(ab, p - b);
  const double d4 = glm::dot(ac, p - b);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + ab * (d1 / (d1 - d3));
  const double d5 = glm::dot(ab, p - c);
  const double d6 = glm::dot(ac, p - c);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double sum = va + vb + vc;
  return a + ab * (vb / sum) + ac * (vc / sum);
}

double share_of_named(const WeightTable<float>& rows, std::size_t vertex, std::span<const char* const> names) {
  double sum = 0.0;
  const auto points = rows.points_of(vertex);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool named =
        std::any_of(names.begin(), names.end(), [&](const char* n) { return parse_feature_point(n) == points[i]; });
    if (named) sum += rows.weights_of(vertex)[i];
  }
  return sum;
}

/// Whether a point lies within the flesh of the face: a ray to the front leaves it once.
bool is_inside(glm::dvec3 p, std::span<const Triangle> skin, std::span<const glm::vec3> moved) {
  // Aside from the middle plane, where the edges of a symmetric mesh are and rounding decides which triangle is met.
  p.x += 1e-5 * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
  bool inside = false;
  for (const Triangle& t : skin) {
    const glm::dvec3 a(moved[t[0]]);
    const glm::dvec3 b(moved[t[1]]);
    const glm::dvec3 c(moved[t[2]]);
    const auto side = [&](const glm::dvec3& u, const glm::dvec3& v) {
      return (v.x - u.x) * (p.y - u.y) - (v.y - u.y) * (p.x - u.x);
    };
    const double ab = side(a, b);
    const double bc = side(b, c);
    const double ca = side(c, a);
    const bool in_front_view = (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab < 0.0 && bc < 0.0 && ca < 0.0);
    const double sum = ab + bc + ca;
    if (in_front_view && sum != 0.0 && (bc * a.z + ca * b.z + ab * c.z) / sum > p.z) inside = !inside;
  }
  return inside;
}

/// The lowest vertex of the front of the upper teeth in each of the places along x. What is behind `behind` is not of
/// the front.
std::vector<std::uint32_t> find_teeth_edge(const PosedFace& face, double middle, double half_width, double behind) {
  const auto& positions = face.head().model.positions;
  std::vector<std::uint32_t> edge;
  for (std::size_t k = 0; k < places; ++k) {
    const double width = 2.0 * half_width / static_cast<double>(places);
    const double from = middle - half_width + static_cast<double>(k) * width;
    std::optional<std::uint32_t> lowest;
    for (std::uint32_t v = 0; v < positions.size(); ++v) {
      if (face.role_of(v) != PartRole::upper_teeth || positions[v].x < from || positions[v].x > from + width) continue;
      if (positions[v].z < behind) continue;
      if (!lowest || positions[v].y < positions[*lowest].y) lowest = v;
    }
    if (lowest) edge.push_back(*lowest);
  }
  return edge;
}

}  // namespace

std::optional<Mouth> Mouth::find(const PosedFace& face) {
  const Head& head = face.head();
  const auto mns = face.rig().fapu[FapuUnit::mns];
  auto opening = Opening::find(face, OpeningKind::mouth);
  if (!opening || !mns || !face.rig().lip_gaps || face.rig().lip_gaps->joined) return std::nullopt;
  Mouth mouth(*std::move(opening));
  mouth.rest_ = head.model.positions;
  mouth.mouth_nose_ = 1024.0 * *mns;
  const auto vertex = [&](const char* name) -> std::optional<std::uint32_t> {
    const FeaturePoint* const point = find_point(head.points, name);
    if (point == nullptr || !point->vertex) return std::nullopt;
    return point->vertex->value();
  };
  for (const char* const name : inner_lip_names) {
    const auto v = vertex(name);
    if (!v) return std::nullopt;
    mouth.inner_lips_.push_back(*v);
  }
  const auto left = vertex("2.4");
  const auto right = vertex("2.5");
  if (!left || !right) return std::nullopt;
  mouth.corners_ = {*left, *right};
  const double x0 = head.model.positions[*right].x;
  const double x1 = head.model.positions[*left].x;
  if (const FeaturePoint* const edge = find_point(head.points, "9.10")) {
    mouth.teeth_edge_ = find_teeth_edge(face, (x0 + x1) / 2.0, middle_share * (x1 - x0) / 2.0,
                                        edge->position.z - depth_of_edge * mouth.mouth_nose_);
  }
  for (const Triangle& t : head.model.triangles) {
    if (face.role_of(t[0]) != PartRole::skin) continue;
    mouth.skin_.push_back(t);
    const bool lip = std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
      return share_of_named(face.rig().influence, v, lower_lip_names) >= least_share;
    });
    if (lip) mouth.lower_lip_.push_back(t);
  }
  return mouth;
}

MouthShape Mouth::measure(std::span<const glm::vec3> moved) const {
  MouthShape shape;
  shape.opening = opening_.measure(moved).slit;
  const auto width = [&](std::span<const glm::vec3> p) {
    return static_cast<double>(p[corners_[0]].x) - p[corners_[1]].x;
  };
  shape.width = width(moved) / width(rest_);
  for (const std::uint32_t v : inner_lips_) {
    shape.protrusion += (static_cast<double>(moved[v].z) - rest_[v].z) / static_cast<double>(inner_lips_.size());
  }
  shape.protrusion /= mouth_nose_;
  return shape;
}

std::optional<double> Mouth::teeth_to_lower_lip(std::span<const glm::vec3> moved) const {
  if (teeth_edge_.empty()) return std::nullopt;
  double sum = 0.0;
  for (const std::uint32_t v : teeth_edge_) {
    const glm::dvec3 tooth(moved[v]);
    if (is_inside(tooth, skin_, moved)) continue;
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& t : lower_lip_) {
      const glm::dvec3 at = nearest_on(tooth, moved[t[0]], moved[t[1]], moved[t[2]]);
      least = std::min(least, glm::distance(tooth, at));
    }
    sum += least;
  }
  return sum / static_cast<double>(teeth_edge_.size()) / mouth_nose_;
}

}  // namespace semblante::bench
