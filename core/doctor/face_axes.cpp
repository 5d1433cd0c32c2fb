#include "core/doctor/face_axes.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <glm/geometric.hpp>

#include "core/tables/mpeg4.h"
#include "core/types/places.h"

namespace semblante {
namespace {

/// cos 60 degrees: pairs of one face are roughly parallel; a pair that is not is excluded from the axis.
constexpr double same_way = 0.5;

std::size_t index_of(std::string_view name) { return parse_feature_point(name)->value(); }

double middle(std::vector<double> values) {
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), half, values.end());
  return *half;
}

/// The median of each coordinate of the marked points, which is robust against a misplaced point.
std::optional<glm::dvec3> middle_of(const Places& points, std::span<const std::string_view> names) {
  std::array<std::vector<double>, 3> values;
  for (const std::string_view name : names) {
    const auto& place = points[index_of(name)];
    if (!place) continue;
    for (int axis = 0; axis < 3; ++axis) values[static_cast<std::size_t>(axis)].push_back((*place)[axis]);
  }
  if (values[0].empty()) return std::nullopt;
  return glm::dvec3(middle(values[0]), middle(values[1]), middle(values[2]));
}

struct Pair {
  FeaturePointId left;
  glm::dvec3 across;  ///< from the right point to the left one
};

std::vector<Pair> marked_pairs(const Places& points) {
  std::vector<Pair> pairs;
  for (std::uint8_t id = 0; id < feature_point_count; ++id) {
    const auto& info = mpeg4::feature_points[id];
    if (info.side != mpeg4::Side::left || !points[id] || !points[info.mirror]) continue;
    pairs.push_back({FeaturePointId(id), *points[id] - *points[info.mirror]});
  }
  return pairs;
}

/// The direction of the largest number of parallel pairs, as their sum, so that long pairs have more weight.
std::optional<glm::dvec3> common_way(const std::vector<Pair>& pairs) {
  glm::dvec3 best(0.0);
  std::size_t most = 0;
  for (const Pair& candidate : pairs) {
    glm::dvec3 sum(0.0);
    std::size_t count = 0;
    for (const Pair& pair : pairs) {
      if (glm::dot(candidate.across, pair.across) <=
          same_way * glm::length(candidate.across) * glm::length(pair.across))
        continue;
      sum += pair.across;
      ++count;
    }
    if (count <= most) continue;
    most = count;
    best = sum;
  }
  if (most == 0) return std::nullopt;
  return glm::normalize(best);
}

/// The direction of `way` without its components along unit vectors `a` and `b`; empty if not longer than `least`.
std::optional<glm::dvec3> across(std::optional<glm::dvec3> way, const glm::dvec3& a, const glm::dvec3& b,
                                 double least) {
  if (!way) return way;
  glm::dvec3 rest = *way - glm::dot(*way, a) * a;
  rest -= glm::dot(rest, b) * b;
  if (glm::length(rest) <= least) return std::nullopt;
  return glm::normalize(rest);
}

std::optional<glm::dvec3> way_between(const Places& points, std::span<const std::string_view> from,
                                      std::span<const std::string_view> to) {
  const auto a = middle_of(points, from);
  const auto b = middle_of(points, to);
  if (!a || !b) return std::nullopt;
  return *b - *a;
}

constexpr auto of_eyes = std::to_array<std::string_view>(
    {"3.1", "3.2", "3.3", "3.4", "3.5", "3.6", "3.7", "3.8", "3.11", "3.12", "4.1", "4.2", "4.3", "4.4"});
constexpr auto of_mouth =
    std::to_array<std::string_view>({"2.1", "2.2", "2.3", "2.4", "2.5", "2.10", "8.1", "8.2", "8.3", "8.4"});
constexpr auto in_front = std::to_array<std::string_view>({"2.2", "2.3", "2.10", "8.1", "8.2", "9.3", "9.12", "9.15"});
constexpr auto behind = std::to_array<std::string_view>(
    {"2.13", "2.14", "3.7", "3.12", "4.5", "4.6", "7.1", "10.1", "10.2", "10.5", "10.6", "10.9", "10.10", "11.6"});

/// The model axis nearest to a direction.
glm::dvec3 snapped(const glm::dvec3& way) {
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (std::abs(way[other]) > std::abs(way[axis])) axis = other;
  glm::dvec3 unit(0.0);
  unit[axis] = way[axis] < 0.0 ? -1.0 : 1.0;
  return unit;
}

std::optional<double> separation_of_eyes(const Places& points, const glm::dvec3& left) {
  // A point of the left eye, or the middle of two, compared with the same of the right eye.
  constexpr std::array<std::array<std::string_view, 2>, 4> ways = {
      {{"3.5", "3.5"}, {"3.7", "3.11"}, {"3.1", "3.3"}, {"4.1", "4.5"}}};
  std::vector<double> values;
  for (const auto& [first, second] : ways) {
    const auto side = [&](std::size_t a, std::size_t b) -> std::optional<double> {
      if (!points[a] || !points[b]) return std::nullopt;
      return 0.5 * glm::dot(*points[a] + *points[b], left);
    };
    const std::size_t a = index_of(first);
    const std::size_t b = index_of(second);
    const auto here = side(a, b);
    const auto there = side(mpeg4::feature_points[a].mirror, mpeg4::feature_points[b].mirror);
    if (here && there && *here - *there > 0.0) values.push_back(*here - *there);
  }
  if (values.empty()) return std::nullopt;
  return middle(values);
}

}  // namespace

const std::optional<glm::dvec3>& FaceAxes::place(std::string_view name) const { return places[index_of(name)]; }

FaceAxes fit_face_axes(const FeaturePointSet& points) {
  Places marked;
  for (const FeaturePoint& point : points) marked[point.id.value()] = glm::dvec3(point.position);
  const std::vector<Pair> pairs = marked_pairs(marked);

  FaceAxes frame;
  if (const auto left = common_way(pairs)) frame.left = *left;
  const double spread = pairs.empty() ? 0.0 : glm::length(pairs.front().across);
  const double least = 1e-3 * spread;
  if (const auto up = across(way_between(marked, of_mouth, of_eyes), frame.left, frame.left, least)) frame.up = *up;
  // The third axis has its own points instead of the cross product of the other two: this distinguishes exchanged
  // sides from a rotated face.
  const auto forward = across(way_between(marked, behind, in_front), frame.left, frame.up, least);
  frame.forward = glm::cross(frame.left, frame.up);
  if (forward && glm::dot(*forward, frame.forward) < 0.0) {
    frame.left = -frame.left;
    frame.forward = -frame.forward;
  }
  for (const Pair& pair : pairs) {
    if (glm::dot(pair.across, frame.left) > -same_way * glm::length(pair.across)) continue;
    frame.swapped.push_back(pair.left);
    std::swap(marked[pair.left.value()], marked[mpeg4::feature_points[pair.left.value()].mirror]);
  }
  frame.eye_separation = separation_of_eyes(marked, frame.left);

  const glm::dvec3 x = snapped(frame.left);
  const glm::dvec3 y = snapped(frame.up);
  const glm::dvec3 z = snapped(frame.forward);
  for (std::size_t id = 0; id < feature_point_count; ++id) {
    if (!marked[id]) continue;
    frame.places[id] = glm::dvec3(glm::dot(*marked[id], x), glm::dot(*marked[id], y), glm::dot(*marked[id], z));
  }
  frame.symmetry = symmetry_of_points(frame.places);
  return frame;
}

}  // namespace semblante
