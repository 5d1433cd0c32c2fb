#include "core/anatomy/jaw_share.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "core/anatomy/smooth_step.h"
#include "core/geometry/edge_path_search.h"
#include "core/geometry/nearest_point.h"

namespace semblante {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Box {
  glm::dvec3 low{infinite}, high{-infinite};

  void add(const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  [[nodiscard]] bool is_within(const glm::dvec3& p, double distance) const {
    return glm::all(glm::greaterThan(p, low - distance)) && glm::all(glm::lessThan(p, high + distance));
  }
  [[nodiscard]] bool is_within(const Box& other, double distance) const {
    return glm::all(glm::greaterThan(other.high, low - distance)) &&
           glm::all(glm::lessThan(other.low, high + distance));
  }
};

bool is_teeth(const Part& part) { return part.role == PartRole::upper_teeth || part.role == PartRole::lower_teeth; }

/// By part: the boxes of teeth and tongues.
std::vector<Box> boxes_in_mouth(const Surface& surface, std::span<const Part> parts) {
  std::vector<Box> boxes(parts.size());
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    if (!is_teeth(parts[p]) && parts[p].role != PartRole::tongue) continue;
    for (const SurfaceVertexId v : surface.members_of(PartId(p))) boxes[p].add(surface.positions[v.value()]);
  }
  return boxes;
}

/// The vertices of a part that hold a row of teeth; empty if the row is not in this part.
std::vector<SurfaceVertexId> sockets_of(const Surface& surface, std::span<const Part> parts, std::span<const Box> boxes,
                                        PartId part, PartRole row) {
  const std::span<const SurfaceVertexId> members = surface.members_of(part);
  std::vector<PartId> teeth;
  Box of_row;
  std::size_t count = 0;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    if (parts[p].role != row || PartId(p) == part) continue;
    teeth.emplace_back(p);
    of_row.add(boxes[p].low);
    of_row.add(boxes[p].high);
    count += surface.members_of(PartId(p)).size();
  }
  if (count == 0) return {};
  const Box& box = boxes[part.value()];
  // About two millimetres: a row of teeth is about 60 mm wide.
  const double touch = 0.04 * (of_row.high.x - of_row.low.x);
  // Most teeth are far from most parts: only those at the part's box are searched for.
  std::vector<glm::dvec3> near;
  for (const PartId tooth : teeth) {
    if (!box.is_within(boxes[tooth.value()], touch)) continue;
    for (const SurfaceVertexId v : surface.members_of(tooth)) {
      const glm::dvec3& t = surface.positions[v.value()];
      if (box.is_within(t, touch)) near.push_back(t);
    }
  }
  const std::size_t enough = (count + 9) / 10;
  if (near.size() < enough) return {};
  // Likewise only vertices at the box of these teeth: most of the skin of a face is far from them.
  Box of_teeth;
  for (const glm::dvec3& t : near) of_teeth.add(t);
  std::vector<SurfaceVertexId> around;
  std::vector<glm::dvec3> positions;
  for (const SurfaceVertexId v : members) {
    const glm::dvec3& p = surface.positions[v.value()];
    if (!of_teeth.is_within(p, touch)) continue;
    around.push_back(v);
    positions.push_back(p);
  }
  if (around.empty()) return {};
  NearestPoint near_part(positions);
  std::size_t touching = 0;
  for (const glm::dvec3& t : near) {
    touching += static_cast<std::size_t>(near_part.has_within(t, touch));
    if (touching == enough) break;
  }
  // Gums touch many vertices of the teeth (a quarter of them on the head used for tests); a tongue at rest touches them
  // only with its tip (one in fifty).
  if (touching < enough) return {};

  NearestPoint near_teeth(near);
  std::vector<SurfaceVertexId> sockets;
  for (std::size_t i = 0; i < around.size(); ++i) {
    // Half the distance, because the borders of the tongue are close to the teeth too.
    if (near_teeth.has_within(positions[i], 0.5 * touch)) sockets.push_back(around[i]);
  }
  return sockets;
}

/// The position between two places at the distances `a` and `b`: 0..1. One half if both distances are zero.
double part_of_way(double a, double b) { return a + b > 0.0 ? a / (a + b) : 0.5; }

void share_joined_part(const Surface& surface, PartId part, const std::vector<SurfaceVertexId>& upper,
                       const std::vector<SurfaceVertexId>& lower, const std::vector<SurfaceVertexId>& tongue,
                       std::vector<MouthShare>& shares) {
  EdgePathSearch search(surface);
  const auto distances = [&](const std::vector<SurfaceVertexId>& sources) {
    const std::span<const double> found = search.from(sources);
    return std::vector<double>(found.begin(), found.end());
  };
  const std::vector<double> to_upper = distances(upper);
  const std::vector<double> to_lower = distances(lower);
  const std::vector<double> to_tongue =
      tongue.empty() ? std::vector<double>(to_lower.size(), infinite) : distances(tongue);
  for (const SurfaceVertexId vertex : surface.members_of(part)) {
    const std::size_t s = vertex.value();
    const double jaw_side = std::min(to_lower[s], to_tongue[s]);
    const double gum_side = std::min(to_upper[s], to_lower[s]);
    MouthShare& share = shares[s];
    if (to_tongue[s] == 0.0) {
      share = {1.0, 1.0};  // a point's own vertex follows it exactly
      continue;
    }
    share.jaw = smooth_step(0.35, 0.65, part_of_way(to_upper[s], jaw_side));
    share.tongue = tongue.empty() ? 0.0 : smooth_step(0.2, 0.6, part_of_way(gum_side, to_tongue[s]));
  }
}

/// The mean position of those points that are marked.
std::optional<glm::dvec3> middle_of(std::span<const SurfacePoint> points,
                                    std::initializer_list<std::string_view> names) {
  glm::dvec3 sum(0.0);
  double count = 0.0;
  for (const std::string_view name : names) {
    const auto id = parse_feature_point(name);
    for (const SurfacePoint& point : points) {
      if (point.id != id) continue;
      sum += point.position;
      count += 1.0;
    }
  }
  return count > 0.0 ? std::optional(sum / count) : std::nullopt;
}

struct Rows {
  std::vector<SurfaceVertexId> upper, lower;
};

/// The roots of both rows in the only part with teeth: its highest and its lowest vertices, if it is as high as two
/// rows and the lips meet at about its middle. Empty for a part with one row.
Rows rows_of_only_part(const Surface& surface, PartId part, std::span<const SurfacePoint> points) {
  constexpr double two_rows = 0.35;  // of ES0; a row with its gums is at most 18 mm high
  constexpr double middle = 0.25;    // of the height, from the ends to the line of the lips
  constexpr double roots = 0.15;     // of the height
  Rows rows;
  const auto left = middle_of(points, {"3.7", "3.11"});
  const auto right = middle_of(points, {"3.8", "3.12"});
  const auto lips = middle_of(points, {"2.2", "2.3"});
  if (!left || !right || !lips) return rows;
  double low = infinite;
  double high = -infinite;
  for (const SurfaceVertexId v : surface.members_of(part)) {
    low = std::min(low, surface.positions[v.value()].y);
    high = std::max(high, surface.positions[v.value()].y);
  }
  const double height = high - low;
  if (height < two_rows * std::abs(left->x - right->x)) return rows;
  if (lips->y < low + middle * height || lips->y > high - middle * height) return rows;
  for (const SurfaceVertexId v : surface.members_of(part)) {
    const double y = surface.positions[v.value()].y;
    if (y > high - roots * height) rows.upper.push_back(v);
    if (y < low + roots * height) rows.lower.push_back(v);
  }
  return rows;
}

}  // namespace

std::vector<MouthShare> share_of_jaw(const Surface& surface, std::span<const Part> parts,
                                     std::span<const SurfacePoint> points) {
  std::vector<MouthShare> shares(surface.vertex_count());
  const std::vector<Box> boxes = boxes_in_mouth(surface, parts);
  const bool has_one_part_of_teeth = std::count_if(parts.begin(), parts.end(), is_teeth) == 1;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    const PartId part(p);
    const PartRole role = parts[p].role;
    if (role != PartRole::tongue && role != PartRole::lower_teeth && role != PartRole::upper_teeth) continue;
    std::vector<SurfaceVertexId> upper = sockets_of(surface, parts, boxes, part, PartRole::upper_teeth);
    std::vector<SurfaceVertexId> lower = sockets_of(surface, parts, boxes, part, PartRole::lower_teeth);
    if (has_one_part_of_teeth && is_teeth(parts[p])) {
      Rows rows = rows_of_only_part(surface, part, points);
      upper = std::move(rows.upper);
      lower = std::move(rows.lower);
    }
    if (!upper.empty() && !lower.empty()) {
      std::vector<SurfaceVertexId> tongue;
      for (const SurfacePoint& point : points) {
        if (group_of(point.id) == 6 && surface.part_of[point.vertex.value()] == part) tongue.push_back(point.vertex);
      }
      share_joined_part(surface, part, upper, lower, tongue, shares);
      continue;
    }
    const MouthShare whole{role == PartRole::upper_teeth ? 0.0 : 1.0, role == PartRole::tongue ? 1.0 : 0.0};
    for (const SurfaceVertexId vertex : surface.members_of(part)) shares[vertex.value()] = whole;
  }
  return shares;
}

}  // namespace semblante
