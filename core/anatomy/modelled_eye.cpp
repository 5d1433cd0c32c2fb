#include "core/anatomy/modelled_eye.h"

#include <algorithm>
#include <cmath>

#include "core/anatomy/eye_skin.h"
#include "core/anatomy/joined_rims.h"
#include "core/anatomy/lid_edge.h"
#include "core/anatomy/part_roles.h"
#include "core/geometry/nearest_point.h"
#include "core/tables/openings.h"

namespace semblante {
namespace {

/// Beyond the lines through the points of the lids, as a share of the opening's height; the second where a point would
/// lie on the eye.
constexpr std::array<double, 2> beyond_points = {0.12, -0.05};
/// The greatest height of the eye that is seen, as a multiple of that at the point of the upper lid.
constexpr double greatest_beside_point = 1.1;
/// What is nearer to the edges of the lids is theirs, in widths of the eye, where the eye is welded to them.
constexpr double near_edge = 0.02;
/// Columns in which the edges of the lids are looked for.
constexpr int rim_columns = 19;

/// The heights at which the eye that is seen ends, above and below, as smooth lines from the one end to the other.
class Curves {
 public:
  explicit Curves(const EyeSkin& skin) {
    const auto [from, to] = skin.across();
    const double step = (to - from) / (rim_columns + 1);
    for (int k = 1; k <= rim_columns; ++k) {
      const auto seen = skin.seen_at(from + step * k);
      if (!seen) continue;
      columns_.push_back(from + step * k);
      upper_.push_back(seen->upper.y);
      lower_.push_back(seen->lower.y);
    }
    for (auto* const line : {&upper_, &lower_}) {
      for (int pass = 0; pass < passes; ++pass) {
        const std::vector<double> before = *line;
        for (std::size_t k = 1; k + 1 < line->size(); ++k)
          (*line)[k] = 0.25 * before[k - 1] + 0.5 * before[k] + 0.25 * before[k + 1];
      }
    }
  }
  [[nodiscard]] std::span<const double> columns() const { return columns_; }
  [[nodiscard]] double upper(double x) const { return at(upper_, x); }
  [[nodiscard]] double lower(double x) const { return at(lower_, x); }

 private:
  static constexpr int passes = 4;
  [[nodiscard]] double at(const std::vector<double>& line, double x) const {
    const auto next = std::upper_bound(columns_.begin(), columns_.end(), x);
    if (next == columns_.begin()) return line.front();
    if (next == columns_.end()) return line.back();
    const auto k = static_cast<std::size_t>(next - columns_.begin());
    const double share = (x - columns_[k - 1]) / (columns_[k] - columns_[k - 1]);
    return line[k - 1] + share * (line[k] - line[k - 1]);
  }
  std::vector<double> columns_, upper_, lower_;
};

/// The points of an eye's lids; `left` and `right` are the corners.
struct LidPoints {
  SurfacePoint upper, lower, left, right;

  [[nodiscard]] LidPlaces places() const { return {upper.position, lower.position, left.position, right.position}; }
};

std::optional<LidPoints> lid_points(std::span<const SurfacePoint> points, const mpeg4::Opening& lids) {
  const SurfacePoint* const upper = point_named(points, lids.upper.front());
  const SurfacePoint* const lower = point_named(points, lids.lower.front());
  const SurfacePoint* const left = point_named(points, lids.corners[0]);
  const SurfacePoint* const right = point_named(points, lids.corners[1]);
  if (upper == nullptr || lower == nullptr || left == nullptr || right == nullptr) return std::nullopt;
  return LidPoints{*upper, *lower, *left, *right};
}

/// Leaves what a welded eye shares with the lids to the lids: what is near their edges.
void leave_edges(const Surface& surface, std::span<const SurfacePoint> points, const LidPoints& lids, double width,
                 std::vector<SurfaceVertexId>& held) {
  std::vector<glm::dvec3> edges;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const auto found = find_eye_edges(surface, points, eye);
    if (!found || found->upper.middle.id != lids.upper.id) continue;
    for (const LidEdge* const edge : {&found->upper, &found->lower}) {
      for (const auto& way : edge->to_corner)
        for (const SurfaceVertexId v : way) edges.push_back(surface.positions[v.value()]);
    }
  }
  if (edges.empty()) return;
  NearestPoint nearest(edges);
  std::erase_if(held,
                [&](SurfaceVertexId v) { return nearest.has_within(surface.positions[v.value()], near_edge * width); });
}

std::optional<ModelledEye> eye_between(const Surface& surface, std::span<const Triangle> triangles,
                                       std::span<const SurfacePoint> points, const LidPoints& lids,
                                       const EyeOpening& opening, bool is_welded) {
  if (!opening.is_sane()) return std::nullopt;
  EyeSkin skin(surface, surface.positions, triangles, surface.part_of[lids.upper.vertex.value()], opening,
               opening.width());
  if (!(is_welded ? skin.find_welded_eye() : skin.find_eye())) return std::nullopt;
  // Lids that a ball goes on behind may lie as close to it as the eye of a sculpture to its ball.
  if (!is_welded && (skin.is_on_ball(lids.left.vertex) || skin.is_on_ball(lids.right.vertex))) return std::nullopt;
  ModelledEye found;
  found.is_welded = is_welded;
  found.held = skin.inner_vertices();
  if (is_welded) leave_edges(surface, points, lids, opening.width(), found.held);
  const bool is_point_held = std::any_of(points.begin(), points.end(), [&](const SurfacePoint& p) {
    return std::binary_search(found.held.begin(), found.held.end(), p.vertex);
  });
  auto middle = skin.seen_at(lids.upper.position.x);
  if (found.held.empty() || is_point_held || !middle || middle->height() < closed_height * opening.width())
    return std::nullopt;
  const Curves curves(skin);
  // Beside its point a lid may have a little farther to go, and would leave a slit there.
  const double own = middle->height();
  for (const double column : curves.columns()) {
    const auto seen = skin.seen_at(column);
    if (seen && seen->height() > middle->height() && seen->height() < greatest_beside_point * own) middle = seen;
  }
  found.upper = middle->upper;
  found.lower = middle->lower;
  found.ball = skin.ball();
  for (const double column : curves.columns()) {
    const auto seen = skin.seen_at(column);
    if (!seen) continue;
    for (const bool is_upper : {true, false}) {
      const auto vertex = skin.nearest_but(found.held, is_upper ? seen->upper : seen->lower);
      if (!vertex) continue;
      // By the place between the corners alone: what lies beside the edge goes along with it.
      const double x = surface.positions[vertex->value()].x;
      const double way = curves.upper(x) - curves.lower(x);
      found.rim.push_back({*vertex, is_upper, std::clamp(way / middle->height(), 0.0, 1.0)});
    }
  }
  return found;
}

std::optional<ModelledEye> find_modelled_eye(const Surface& surface, std::span<const Triangle> triangles,
                                             std::span<const SurfacePoint> points, const mpeg4::Opening& opening) {
  const std::optional<LidPoints> lids = lid_points(points, opening);
  if (!lids) return std::nullopt;
  const bool is_welded = !are_joined(surface, opening, points);
  for (const double beyond : beyond_points) {
    auto found = eye_between(surface, triangles, points, *lids, EyeOpening(lids->places(), beyond), is_welded);
    if (found) return found;
  }
  return std::nullopt;
}

}  // namespace

bool is_held(const ModelledEyes& eyes, SurfaceVertexId vertex) {
  return std::any_of(eyes.begin(), eyes.end(), [vertex](const std::optional<ModelledEye>& eye) {
    return eye && std::binary_search(eye->held.begin(), eye->held.end(), vertex);
  });
}

ModelledEyes find_modelled_eyes(const Surface& surface, std::span<const Triangle> triangles,
                                std::span<const Part> parts, std::span<const SurfacePoint> points) {
  ModelledEyes eyes;
  for (std::size_t eye = 0; eye < eyes.size(); ++eye) {
    if (has_part(parts, eyeball_role(eye))) continue;
    eyes[eye] = find_modelled_eye(surface, triangles, points, mpeg4::lids_of(eye));
  }
  return eyes;
}

}  // namespace semblante
