#include "tests/support/closure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "core/anatomy/point_lookup.h"
#include "core/parametrize/point_distances.h"

namespace semblante::bench {
namespace {

constexpr std::size_t columns = 61;
constexpr std::size_t samples = 800;
/// Left out at either corner, as share of the width: there both are one skin.
constexpr double corner_share = 0.05;
constexpr double infinite = std::numeric_limits<double>::infinity();

struct Description {
  std::vector<const char*> upper, lower;
  const char* corners[2];
  FapuUnit unit;
  double reach;     ///< of the points along the surface, as share of the width
  bool at_corners;  ///< whether what is near to a corner alone counts too
};

Description describe(OpeningKind kind) {
  switch (kind) {
    case OpeningKind::left_eye:
      return {{"3.1", "3.13"}, {"3.3", "3.9"}, {"3.11", "3.7"}, FapuUnit::irisd, 0.55, false};
    case OpeningKind::right_eye:
      return {{"3.2", "3.14"}, {"3.4", "3.10"}, {"3.12", "3.8"}, FapuUnit::irisd, 0.55, false};
    case OpeningKind::mouth:
      break;
  }
  return {{"2.2", "2.6", "2.7", "8.1", "8.5", "8.6", "8.9", "8.10"},
          {"2.3", "2.8", "2.9", "8.2", "8.7", "8.8"},
          {"2.5", "2.4"},
          FapuUnit::mns,
          0.22,
          true};
}

/// Of every surface vertex to the nearest of the points.
std::vector<double> nearest(const Head& head, const std::vector<const char*>& names) {
  std::vector<SurfacePoint> points;
  for (const SurfacePoint& point : surface_points(head.surface, head.points)) {
    for (const char* const name : names) {
      if (point.id == parse_feature_point(name)) points.push_back(point);
    }
  }
  std::vector<double> result(head.surface.vertex_count(), infinite);
  std::vector<double> row;
  for (std::uint32_t p = 0; p < head.surface.part_count(); ++p) {
    const PointDistances distances = measure_distances(head.surface, PartId(p), points);
    for (std::size_t m = 0; m < distances.members.size(); ++m) {
      for (const double d : distances.of_member(m, row)) {
        double& least = result[distances.members[m].value()];
        least = std::min(least, d);
      }
    }
  }
  return result;
}

/// A triangle cut by a plane of equal x: from (y, z) to (y, z).
using Segment = std::array<glm::dvec2, 2>;

std::optional<Segment> cut(const Triangle& t, std::span<const glm::vec3> positions, double x) {
  Segment segment;
  std::size_t found = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const glm::dvec3 a(positions[t[c]]);
    const glm::dvec3 b(positions[t[(c + 1) % 3]]);
    if ((a.x < x) == (b.x < x)) continue;
    const glm::dvec3 at = glm::mix(a, b, (x - a.x) / (b.x - a.x));
    segment[found++] = {at.y, at.z};
  }
  if (found != 2) return std::nullopt;
  return segment;
}

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool cross(const Segment& a, const Segment& b) {
  return turn(a[0], a[1], b[0]) * turn(a[0], a[1], b[1]) < 0.0 && turn(b[0], b[1], a[0]) * turn(b[0], b[1], a[1]) < 0.0;
}

/// Lets `visit(k, other)` see every sample k of `axis` that the segment passes, with its other coordinate there.
template <class Visit>
void rasterize(const Segment& segment, int axis, double from, double step, Visit visit) {
  glm::dvec2 a = segment[0];
  glm::dvec2 b = segment[1];
  if (a[axis] > b[axis]) std::swap(a, b);
  constexpr double end = samples - 1;
  const double first = std::max((a[axis] - from) / step, 0.0);
  const double last = std::min((b[axis] - from) / step, end);
  if (!(first <= last)) return;
  const int other = 1 - axis;
  const double slope = b[axis] > a[axis] ? (b[other] - a[other]) / (b[axis] - a[axis]) : 0.0;
  const auto past = static_cast<std::size_t>(last) + 1;
  for (auto k = static_cast<std::size_t>(std::ceil(first)); k < past; ++k) {
    visit(k, a[other] + (from + static_cast<double>(k) * step - a[axis]) * slope);
  }
}

struct Section {
  std::vector<Segment> upper, lower, inside, skin;

  /// Along one axis, 0 y or 1 z: what upper and lower cover together.
  [[nodiscard]] std::array<double, 2> range(int axis) const {
    std::array<double, 2> range = {infinite, -infinite};
    for (const auto* side : {&upper, &lower}) {
      for (const Segment& s : *side) {
        range[0] = std::min({range[0], s[0][axis], s[1][axis]});
        range[1] = std::max({range[1], s[0][axis], s[1][axis]});
      }
    }
    return range;
  }

  struct Visible {
    double slit = 0.0;
    double pierced = 0.0;
  };
  [[nodiscard]] Visible visible() const {
    const auto [from, to] = range(0);
    const double step = (to - from) / static_cast<double>(samples - 1);
    enum class Seen : std::uint8_t { nothing, skin, inside, upper, lower };
    std::vector<Seen> seen(samples, Seen::nothing);
    std::vector<double> front(samples, -infinite);
    const auto draw = [&, first = from](const std::vector<Segment>& segments, Seen what) {
      for (const Segment& s : segments) {
        rasterize(s, 0, first, step, [&](std::size_t k, double z) {
          if (z <= front[k]) return;
          front[k] = z;
          seen[k] = what;
        });
      }
    };
    draw(skin, Seen::skin);
    draw(inside, Seen::inside);
    draw(upper, Seen::upper);
    draw(lower, Seen::lower);
    const auto last_lower = std::find(seen.rbegin(), seen.rend(), Seen::lower);
    const auto first_upper = std::find(last_lower.base(), seen.end(), Seen::upper);
    const auto is_lid = [](Seen what) { return what == Seen::upper || what == Seen::lower; };
    const auto is_enclosed = [&](auto at) {
      return std::any_of(seen.begin(), at, is_lid) && std::any_of(at, seen.end(), is_lid);
    };
    std::size_t run = 0;
    std::size_t longest = 0;
    std::size_t pierced = 0;
    std::size_t longest_pierced = 0;
    for (auto at = seen.begin(); at != seen.end(); ++at) {
      const bool between = at >= last_lower.base() && at < first_upper && first_upper != seen.end();
      run = *at == Seen::inside || *at == Seen::nothing || (*at == Seen::skin && between) ? run + 1 : 0;
      longest = std::max(longest, run);
      // Below the highest of the lower or above the lowest of the upper, but within both.
      pierced = *at == Seen::inside && !between && is_enclosed(at) ? pierced + 1 : 0;
      longest_pierced = std::max(longest_pierced, pierced);
    }
    // One sample may fall between the ends of two segments.
    const auto length = [step](std::size_t run) { return run > 1 ? static_cast<double>(run) * step : 0.0; };
    return {length(longest), length(longest_pierced)};
  }

  /// How far down upper reaches into lower at most, at one z.
  [[nodiscard]] double overlap() const {
    const auto [from, to] = range(1);
    const double step = (to - from) / static_cast<double>(samples - 1);
    std::vector<double> low(samples, infinite);
    std::vector<double> high(samples, -infinite);
    for (const Segment& s : upper) {
      rasterize(s, 1, from, step, [&](std::size_t k, double y) { low[k] = std::min(low[k], y); });
    }
    for (const Segment& s : lower) {
      rasterize(s, 1, from, step, [&](std::size_t k, double y) { high[k] = std::max(high[k], y); });
    }
    double deepest = 0.0;
    for (std::size_t k = 0; k < samples; ++k) deepest = std::max(deepest, high[k] - low[k]);
    return deepest;
  }

  [[nodiscard]] bool crosses() const {
    return std::any_of(upper.begin(), upper.end(), [&](const Segment& a) {
      return std::any_of(lower.begin(), lower.end(), [&](const Segment& b) { return cross(a, b); });
    });
  }
};

}  // namespace

std::optional<Opening> Opening::find(const PosedFace& face, OpeningKind kind) {
  const Description description = describe(kind);
  const Head& head = face.head();
  const FeaturePoint* const from = find_point(head.points, description.corners[0]);
  const FeaturePoint* const to = find_point(head.points, description.corners[1]);
  const auto unit = face.rig().fapu[description.unit];
  if (from == nullptr || to == nullptr || !unit) return std::nullopt;

  const std::vector<double> to_upper = nearest(head, description.upper);
  const std::vector<double> to_lower = nearest(head, description.lower);
  const std::vector<double> to_corner = nearest(head, {description.corners[0], description.corners[1]});
  const double width = glm::distance(glm::dvec3(from->position), glm::dvec3(to->position));
  Opening opening;
  opening.unit_ = 1024.0 * *unit;
  const double x0 = from->position.x;
  const double x1 = to->position.x;
  opening.from_x_ = x0 + corner_share * (x1 - x0);
  opening.to_x_ = x1 - corner_share * (x1 - x0);
  bool has_inside = false;
  for (const Triangle& t : head.model.triangles) {
    const PartRole role = face.role_of(t[0]);
    if (role == PartRole::attached || role == PartRole::rest) continue;
    Piece piece{t, Side::neither, role != PartRole::skin};
    double upper = infinite;
    double lower = infinite;
    double corner_way = infinite;
    for (const std::uint32_t corner : t) {
      const std::size_t s = head.surface.surface_of[corner].value();
      upper = std::min(upper, to_upper[s]);
      lower = std::min(lower, to_lower[s]);
      if (description.at_corners) corner_way = std::min(corner_way, to_corner[s]);
    }
    if (!piece.inside && std::min({upper, lower, corner_way}) <= description.reach * width) {
      piece.side = upper < lower ? Side::upper : Side::lower;
    }
    has_inside |= kind == OpeningKind::left_eye    ? role == PartRole::left_eye
                  : kind == OpeningKind::right_eye ? role == PartRole::right_eye
                                                   : true;
    opening.pieces_.push_back(piece);
  }
  if (!has_inside) return std::nullopt;
  return opening;
}

std::vector<Closure> Opening::columns_of(std::span<const glm::vec3> moved) const {
  const double step = (to_x_ - from_x_) / static_cast<double>(columns - 1);
  const auto [low, high] =
      std::minmax({from_x_ - 2.0 * step, from_x_ + 2.0 * step, to_x_ - 2.0 * step, to_x_ + 2.0 * step});
  std::array<Section, columns> sections;
  for (const Piece& piece : pieces_) {
    const float a = moved[piece.triangle[0]].x;
    const float b = moved[piece.triangle[1]].x;
    const float c = moved[piece.triangle[2]].x;
    const float least = std::min(a, std::min(b, c));
    const float most = std::max(a, std::max(b, c));
    if (most < low || least > high) continue;
    // The columns at the triangle, and one more on either side for what rounding loses; `cut` says which of them it
    // reaches.
    const auto [first, last] = std::minmax({(least - from_x_) / step, (most - from_x_) / step});
    const double end = std::min(std::floor(last) + 2.0, static_cast<double>(columns));
    for (double column = std::max(0.0, std::ceil(first) - 1.0); column < end; ++column) {
      const auto segment =
          cut(piece.triangle, moved, from_x_ + (to_x_ - from_x_) * column / static_cast<double>(columns - 1));
      if (!segment) continue;
      Section& section = sections[static_cast<std::size_t>(column)];
      (piece.inside                ? section.inside
       : piece.side == Side::upper ? section.upper
       : piece.side == Side::lower ? section.lower
                                   : section.skin)
          .push_back(*segment);
    }
  }
  std::vector<Closure> result;
  for (const Section& section : sections) {
    Closure column;
    if (!section.upper.empty() && !section.lower.empty()) {
      const Section::Visible visible = section.visible();
      column.slit = visible.slit / unit_;
      column.pierced = visible.pierced / unit_;
      column.crossing_columns = section.crosses() ? 1 : 0;
      if (column.crossing_columns == 1) column.crossing = section.overlap() / unit_;
    }
    result.push_back(column);
  }
  return result;
}

Closure Opening::measure(std::span<const glm::vec3> moved) const {
  Closure worst;
  for (const Closure& column : columns_of(moved)) {
    worst.slit = std::max(worst.slit, column.slit);
    worst.crossing = std::max(worst.crossing, column.crossing);
    worst.pierced = std::max(worst.pierced, column.pierced);
    worst.crossing_columns += column.crossing_columns;
  }
  return worst;
}

std::optional<double> leak_to_upper_lip(const PosedFace& face) {
  const auto eyes_apart = face.rig().fapu[FapuUnit::es];
  const auto nose_to_mouth = face.rig().fapu[FapuUnit::mns];
  if (!eyes_apart || !nose_to_mouth) return std::nullopt;
  constexpr float down = -100.0F;  // the FAPs of 2.3, 2.8, 2.9, 8.2, 8.7, 8.8 point up
  const auto moved = face.pose(frame_of({{5, down}, {10, down}, {11, down}, {52, down}, {57, down}, {58, down}}));
  const Head& head = face.head();
  const Description lips = describe(OpeningKind::mouth);
  const std::vector<double> to_upper = nearest(head, lips.upper);
  const std::vector<double> to_lower = nearest(head, lips.lower);
  const double near = 0.14 * 1024.0 * *eyes_apart;
  const double travel = std::abs(down) * *nose_to_mouth;
  double worst = 0.0;
  for (std::size_t v = 0; v < moved.size(); ++v) {
    const std::size_t s = head.surface.surface_of[v].value();
    if (to_upper[s] > near || to_upper[s] > 0.5 * to_lower[s]) continue;
    worst = std::max(worst, static_cast<double>(glm::distance(moved[v], head.model.positions[v])) / travel);
  }
  return worst;
}

}  // namespace semblante::bench
