#include "core/anatomy/lip_gaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "core/anatomy/joined_rims.h"
#include "core/anatomy/point_lookup.h"
#include "core/tables/openings.h"

namespace semblante {
namespace {

constexpr std::size_t columns = 61;
/// Number of depths at which the lips of one column are compared.
constexpr std::size_t depths = 400;
/// Omitted at each corner, as a fraction of the width: there both lips are one skin.
constexpr double corner_share = 0.05;
/// A triangle belongs to a lip if the lip's points have at least this share in it, and more than those of the other
/// lip. Near the corners the points of the corners have the largest share.
constexpr double least_share = 0.05;
constexpr int rounds = 100;
constexpr double no_bound = std::numeric_limits<double>::infinity();

/// A place of a lip in one column; `moves` is its vertical displacement per unit of each facing point.
struct Place {
  double y = 0.0, z = 0.0;
  glm::dvec3 moves{0.0};
};

Place between(const Place& a, const Place& b, double t) {
  return {std::lerp(a.y, b.y, t), std::lerp(a.z, b.z, t), glm::mix(a.moves, b.moves, t)};
}

/// The first and the last k of 0..count-1 with `from` + k `step` in [low, high]; none if the first is greater.
std::pair<int, int> lines_within(double low, double high, double from, double step, std::size_t count) {
  const auto most = static_cast<double>(count);
  // In this order of arguments a NaN, from a step of 0, gives no line.
  const double first = std::min(most, std::max(0.0, std::ceil((low - from) / step)));
  const double last = std::max(-1.0, std::min(std::floor((high - from) / step), most - 1.0));
  return {static_cast<int>(first), static_cast<int>(last)};
}

/// A lip cut by a plane of equal x.
using Section = std::vector<std::array<Place, 2>>;

double share_of(const WeightTable<float>& rows, std::size_t vertex, FeaturePointId id) {
  const auto points = rows.points_of(vertex);
  const auto at = std::find(points.begin(), points.end(), id);
  return at != points.end() ? rows.weights_of(vertex)[static_cast<std::size_t>(at - points.begin())] : 0.0;
}

/// #V: the sum of the shares of some points.
std::vector<double> sums_of_shares(const WeightTable<float>& rows, std::span<const std::string_view> names) {
  std::array<bool, feature_point_count> counts{};
  for (const std::string_view name : names) counts[parse_feature_point(name)->value()] = true;
  std::vector<double> sums(rows.row_count(), 0.0);
  for (std::size_t vertex = 0; vertex < sums.size(); ++vertex) {
    const auto points = rows.points_of(vertex);
    const auto weights = rows.weights_of(vertex);
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (counts[points[k].value()]) sums[vertex] += weights[k];
    }
  }
  return sums;
}

/// Both lips of one head, column by column.
class Lips {
 public:
  Lips(const Model& model, const Rig& rig, double from_x, double to_x)
      : from_x_(from_x), step_((to_x - from_x) / static_cast<double>(columns - 1)) {
    const std::vector<double> of_upper = sums_of_shares(rig.influence, mpeg4::mouth.upper_flesh);
    const std::vector<double> of_lower = sums_of_shares(rig.influence, mpeg4::mouth.lower_flesh);
    for (std::size_t i = 0; i < facing_lips.size(); ++i) {
      facing_[i] = {*parse_feature_point(facing_lips[i].upper), *parse_feature_point(facing_lips[i].lower)};
    }
    for (const Triangle& t : model.triangles) {
      if (rig.parts[rig.part_of_vertex[t[0]].value()].role != PartRole::skin) continue;
      const auto [least, greatest] =
          std::minmax({model.positions[t[0]].x, model.positions[t[1]].x, model.positions[t[2]].x}, std::less<float>());
      if (least >= to_x || greatest <= from_x) continue;
      const double upper = (of_upper[t[0]] + of_upper[t[1]] + of_upper[t[2]]) / 3.0;
      const double lower = (of_lower[t[0]] + of_lower[t[1]] + of_lower[t[2]]) / 3.0;
      if (std::max(upper, lower) < least_share || upper == lower) continue;
      add(model, rig, t, upper > lower);
    }
  }

  [[nodiscard]] const Section& upper(std::size_t column) const { return upper_[column]; }
  [[nodiscard]] const Section& lower(std::size_t column) const { return lower_[column]; }

 private:
  void add(const Model& model, const Rig& rig, const Triangle& t, bool is_upper) {
    std::array<double, 3> x{};
    std::array<Place, 3> corners;
    for (int c = 0; c < 3; ++c) {
      const glm::dvec3 p(model.positions[t[c]]);
      x[c] = p.x;
      corners[c] = {p.y, p.z, {}};
      for (int i = 0; i < 3; ++i) {
        // With the weights of Eq. 4 a lip also follows the points of the other lip.
        const double by_upper = share_of(rig.influence, t[c], facing_[i].upper);
        const double by_lower = share_of(rig.influence, t[c], facing_[i].lower);
        corners[c].moves[i] = is_upper ? by_upper - by_lower : by_lower - by_upper;
      }
    }
    const auto [least, greatest] = std::minmax_element(x.begin(), x.end());
    const auto [first, last] = lines_within(*least, *greatest, from_x_, step_, columns);
    for (int k = first; k <= last; ++k) {
      const double at = from_x_ + k * step_;
      std::array<Place, 2> segment;
      std::size_t found = 0;
      for (int c = 0; c < 3; ++c) {
        const int next = (c + 1) % 3;
        if ((x[c] < at) == (x[next] < at)) continue;
        segment[found++] = between(corners[c], corners[next], (at - x[c]) / (x[next] - x[c]));
      }
      if (found == 2) (is_upper ? upper_ : lower_)[static_cast<std::size_t>(k)].push_back(segment);
    }
  }

  struct Facing {
    FeaturePointId upper, lower;
  };

  double from_x_, step_;
  std::array<Facing, facing_lips.size()> facing_;
  std::array<Section, columns> upper_, lower_;
};

/// One column: when the lips close by c, the gap is no longer visible from c = `seen` on, and surfaces touch from c =
/// `touch` on.
struct Column {
  glm::dvec3 moves{0.0};  ///< per unit of closing of each facing pair, half of it by each point
  double seen = 0.0;
  double touch = 0.0;
};

/// The edge of a section towards the other lip at each depth: the lowest (sign 1) or highest (sign -1) place.
std::vector<std::optional<Place>> edge_by_depth(const Section& section, double sign, double from, double step) {
  std::vector<std::optional<Place>> edge(depths);
  for (auto [a, b] : section) {
    if (a.z > b.z) std::swap(a, b);
    const auto [first, last] = lines_within(a.z, b.z, from, step, depths);
    for (int k = first; k <= last; ++k) {
      const Place place = between(a, b, b.z > a.z ? (from + k * step - a.z) / (b.z - a.z) : 0.0);
      auto& known = edge[static_cast<std::size_t>(k)];
      if (!known || sign * place.y < sign * known->y) known = place;
    }
  }
  return edge;
}

std::optional<Column> measure(const Section& upper, const Section& lower) {
  if (upper.empty() || lower.empty()) return std::nullopt;
  Place low{no_bound, 0.0, {}};
  Place high{-no_bound, 0.0, {}};
  double near = no_bound;
  double far = -no_bound;
  for (const auto& segment : upper) {
    for (const Place& p : segment) {
      if (p.y < low.y) low = p;
      near = std::min(near, p.z);
      far = std::max(far, p.z);
    }
  }
  for (const auto& segment : lower) {
    for (const Place& p : segment) {
      if (p.y > high.y) high = p;
      near = std::min(near, p.z);
      far = std::max(far, p.z);
    }
  }
  Column column;
  column.seen = low.y - high.y;
  column.touch = no_bound;
  column.moves = (low.moves + high.moves) / 2.0;
  const double step = (far - near) / static_cast<double>(depths - 1);
  if (!(step > 0.0)) return std::nullopt;
  const auto above = edge_by_depth(upper, 1.0, near, step);
  const auto below = edge_by_depth(lower, -1.0, near, step);
  for (std::size_t k = 0; k < depths; ++k) {
    if (!above[k] || !below[k] || above[k]->y - below[k]->y >= column.touch) continue;
    column.touch = above[k]->y - below[k]->y;
    column.moves = (above[k]->moves + below[k]->moves) / 2.0;
  }
  // Lips at different depths pass without touching: they stop where the gap is no longer visible.
  if (column.touch == no_bound) column.touch = column.seen;
  return column;
}

double reach_of(const Column& column) { return glm::dot(column.moves, column.moves); }

/// Least squares of the columns' distances from their ranges between `seen` and `touch`: a convex problem, solved
/// alternately for the targets in the ranges and for the gaps. Columns are weighted by how far the points move them:
/// closing columns that hardly move, near the corners, would make the lips pass through each other elsewhere.
LipGaps fit(const std::vector<Column>& columns_of_head) {
  glm::dmat3 normal(0.0);
  for (const Column& c : columns_of_head) normal += reach_of(c) * glm::outerProduct(c.moves, c.moves);
  // A head without weight between points that face each other keeps those gaps at zero.
  for (int i = 0; i < 3; ++i) normal[i][i] += 1e-6;
  const glm::dmat3 inverse = glm::inverse(normal);
  glm::dvec3 gaps(0.0);
  for (int round = 0; round < rounds; ++round) {
    glm::dvec3 right(0.0);
    for (const Column& c : columns_of_head) {
      right += reach_of(c) * c.moves * std::clamp(glm::dot(c.moves, gaps), c.seen, std::max(c.seen, c.touch));
    }
    gaps = glm::max(inverse * right, glm::dvec3(0.0));
  }
  return {{gaps[0], gaps[1], gaps[2]}};
}

/// One skin from lip to lip: the points come together as far as it does not fold over.
LipGaps gaps_of_joined(const Model& model, const Rig& rig) {
  LipGaps gaps{{}, true};
  Heights heights{};
  for (std::size_t i = 0; i < facing_lips.size(); ++i) {
    const FeaturePoint& upper = *find_point(rig.points, facing_lips[i].upper);
    const FeaturePoint& lower = *find_point(rig.points, facing_lips[i].lower);
    gaps.closing[i] = std::max(0.0, static_cast<double>(upper.position.y) - static_cast<double>(lower.position.y));
    heights[upper.id.value()] = -0.5 * gaps.closing[i];
    heights[lower.id.value()] = 0.5 * gaps.closing[i];
  }
  const double share = share_before_fold(model, rig, heights);
  for (double& closing : gaps.closing) closing *= share;
  return gaps;
}

}  // namespace

std::optional<LipGaps> measure_lip_gaps(const Model& model, const Surface& surface, const Rig& rig) {
  const FeaturePoint* const left = find_point(rig.points, "2.4");
  const FeaturePoint* const right = find_point(rig.points, "2.5");
  if (left == nullptr || right == nullptr) return std::nullopt;
  for (const FacingLips& lips : facing_lips) {
    if (find_point(rig.points, lips.upper) == nullptr || find_point(rig.points, lips.lower) == nullptr) {
      return std::nullopt;
    }
  }
  const double from = right->position.x;
  const double width = static_cast<double>(left->position.x) - from;
  if (!(width > 0.0)) return std::nullopt;
  if (are_joined(surface, mpeg4::mouth, surface_points(surface, rig.points))) return gaps_of_joined(model, rig);
  const Lips lips(model, rig, from + corner_share * width, from + (1.0 - corner_share) * width);
  std::vector<Column> measured;
  for (std::size_t c = 0; c < columns; ++c) {
    if (const auto column = measure(lips.upper(c), lips.lower(c))) measured.push_back(*column);
  }
  if (measured.empty()) return std::nullopt;
  return fit(measured);
}

}  // namespace semblante
