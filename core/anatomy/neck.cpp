#include "core/anatomy/neck.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "core/anatomy/head_landmarks.h"
#include "core/anatomy/neck_shape.h"
#include "core/anatomy/point_lookup.h"
#include "core/anatomy/smooth_step.h"
#include "core/geometry/edge_path_search.h"
#include "core/geometry/nearest_vertex.h"

namespace semblante {
namespace {

constexpr double beyond_neck = 1.5;  ///< radii of the neck from its axis: not neck, whatever its height
constexpr double near_skull = 0.5;   ///< of the height from the chin to the eyes: what is worn on the head is so near
                                     ///< to the skin above the eyes,
constexpr double least_on_head = 0.05;  ///< with at least this part of its vertices
constexpr double full_from = 0.98;      ///< of the way from the shoulders (0) to the head (1): from there vertices turn
                                        ///< fully

/// The vertices of the head: those above the jaw that are joined to the face above it, so that raised hands are none.
std::vector<SurfaceVertexId> head_vertices(const Surface& surface, std::span<const SurfaceVertexId> seeds,
                                           const HeadLandmarks& marks) {
  std::vector<bool> seen(surface.vertex_count(), false);
  std::vector<SurfaceVertexId> head;
  const auto visit = [&](SurfaceVertexId v) {
    if (seen[v.value()] || !above_jaw(marks, surface.positions[v.value()])) return;
    seen[v.value()] = true;
    head.push_back(v);
  };
  for (const SurfaceVertexId seed : seeds) visit(seed);
  for (std::size_t next = 0; next < head.size(); ++next) {
    for (const Surface::Step& step : surface.steps_from(head[next])) visit(step.to);
  }
  return head;
}

bool is_still(const NeckShape& neck, const HeadLandmarks& marks, const glm::dvec3& p) {
  if (p.y <= neck.shoulders) return true;
  if (neck.is_cut || p.y >= marks.chin.y) return false;
  return std::hypot(p.x - neck.axis.x, p.z - neck.axis.z) > beyond_neck * neck.radius &&
         p.y < marks.chin.y - first_section * marks.height;
}

/// The share of the head's turn at `way` from the shoulders (0) to the head (1). In front most of the turn is near the
/// shoulders: if the chin goes down, the skin under it makes a pocket before the throat instead of being pushed through
/// it. At the back most of it is near the head, so that the nape does not slide out of the collar.
double share_of_turn(double way, const NeckShape& neck, const glm::dvec3& p) {
  const double x = p.x - neck.axis.x;
  const double z = p.z - neck.axis.z;
  const double from_axis = std::hypot(x, z);
  const double to_front = from_axis > 0.0 ? z * std::abs(z) / (from_axis * from_axis) : 0.0;  // -1 back .. 1 front
  constexpr double steepness = 1.5;
  return std::pow(rounded_ramp(0.0, full_from, way), std::pow(steepness, -to_front));
}

std::uint8_t in_255ths(double share) { return static_cast<std::uint8_t>(std::lround(255.0 * share)); }

bool reaches_below(const Surface& surface, PartId part, double height) {
  const auto members = surface.members_of(part);
  return std::any_of(members.begin(), members.end(),
                     [&](SurfaceVertexId v) { return surface.positions[v.value()].y < height; });
}

/// The share of the head's turn of hair that lies on the shoulders: all of it above the jaw, nothing below the neck.
double turn_by_height(const HeadLandmarks& marks, const NeckShape& neck, const glm::dvec3& p) {
  const double way = (p.y - neck.shoulders) / (jaw_line(marks, p.z) - neck.shoulders);
  return share_of_turn(std::clamp(way, 0.0, 1.0), neck, p);
}

/// The parts that are skin of the face: those with the role, so that a face of several surfaces turns alike.
std::vector<bool> skin_of(const Surface& surface, std::span<const Part> parts) {
  std::vector<bool> is_skin(surface.vertex_count());
  for (std::size_t s = 0; s < is_skin.size(); ++s) {
    is_skin[s] = parts[surface.part_of[s].value()].role == PartRole::skin;
  }
  return is_skin;
}

/// Whether most of a part is below the chin.
bool is_below_chin(const Surface& surface, PartId part, const HeadLandmarks& marks) {
  const auto members = surface.members_of(part);
  const auto below = std::count_if(members.begin(), members.end(),
                                   [&](SurfaceVertexId v) { return surface.positions[v.value()].y < marks.chin.y; });
  return 2 * static_cast<std::size_t>(below) > members.size();
}

std::vector<SurfaceVertexId> vertices_of(const std::vector<bool>& is_skin) {
  std::vector<SurfaceVertexId> vertices;
  for (std::uint32_t s = 0; s < is_skin.size(); ++s) {
    if (is_skin[s]) vertices.emplace_back(s);
  }
  return vertices;
}

/// Whether a part below the chin hangs on the body: most of the skin beneath it does not turn.
bool hangs_on_body(const Surface& surface, PartId part, NearestVertex& skin, std::span<const std::uint8_t> turn) {
  double sum = 0.0;
  const auto members = surface.members_of(part);
  for (const SurfaceVertexId v : members) sum += turn[skin.nearest(surface.positions[v.value()]).vertex.value()];
  const auto count = static_cast<double>(members.size());
  return sum < 0.5 * 255.0 * count;
}

bool may_be_body(const Part& part) {
  return !part.role_by_user && (part.role == PartRole::attached || part.role == PartRole::rest);
}

/// By part: whether it is worn on the head, as hair is that reaches down to the waist: enough of its vertices lie on
/// the skull. Parts of one name count together, because hair consists of strands; those without a name or with the
/// skin's count alone.
std::vector<bool> worn_on_head(const Surface& surface, std::span<const Part> parts, NearestVertex& skin,
                               std::span<const std::uint8_t> turn, const HeadLandmarks& marks) {
  std::set<std::string_view> names_of_skin = {""};
  for (const Part& part : parts) {
    if (part.role == PartRole::skin) names_of_skin.insert(part.name);
  }
  const auto group_of = [&](std::uint32_t p) {
    const std::string_view name = parts[p].name;
    return std::pair(name, names_of_skin.count(name) > 0 ? p : 0U);
  };
  const auto lies_on_skull = [&](SurfaceVertexId v) {
    const glm::dvec3& place = surface.positions[v.value()];
    if (place.y < marks.chin.y + marks.height) return false;
    const NearestVertex::Hit below = skin.nearest(place);
    return below.distance < near_skull * marks.height && turn[below.vertex.value()] == 255;
  };
  struct Count {
    std::size_t vertices = 0, on_skull = 0;
  };
  std::map<std::pair<std::string_view, std::uint32_t>, Count> counts;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    if (!may_be_body(parts[p])) continue;
    const auto members = surface.members_of(PartId(p));
    Count& count = counts[group_of(p)];
    count.vertices += members.size();
    count.on_skull += static_cast<std::size_t>(std::count_if(members.begin(), members.end(), lies_on_skull));
  }
  std::vector<bool> worn(parts.size());
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    const Count& count = counts[group_of(p)];
    worn[p] = static_cast<double>(count.on_skull) > least_on_head * static_cast<double>(count.vertices);
  }
  return worn;
}

/// Gives the role `body` to the parts below the chin that hang on the body.
void find_parts_of_body(const Surface& surface, std::span<Part> parts, const std::vector<bool>& is_skin,
                        std::span<const std::uint8_t> turn, const HeadLandmarks& marks) {
  // Made for the first part that needs them: most heads have none.
  std::optional<NearestVertex> skin;
  std::vector<bool> worn;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    if (!may_be_body(parts[p]) || !is_below_chin(surface, PartId(p), marks)) continue;
    if (!skin) {
      skin.emplace(surface, vertices_of(is_skin));
      worn = worn_on_head(surface, parts, *skin, turn, marks);
    }
    if (!worn[p] && hangs_on_body(surface, PartId(p), *skin, turn)) parts[p].role = PartRole::body;
  }
}

/// The skin that stays where it is: that of the shoulders and of borders across the neck.
std::vector<SurfaceVertexId> still_skin(const Surface& surface, const std::vector<bool>& is_skin,
                                        std::span<const SkinBorder> borders, const NeckShape& neck,
                                        const HeadLandmarks& marks) {
  std::vector<SurfaceVertexId> still;
  for (std::uint32_t s = 0; s < surface.vertex_count(); ++s) {
    if (is_skin[s] && is_still(neck, marks, surface.positions[s])) still.emplace_back(s);
  }
  for (const SkinBorder& border : borders) {
    if (border.high - border.low >= spanning * 2.0 * neck.radius)
      still.insert(still.end(), border.vertices.begin(), border.vertices.end());
  }
  return still;
}

/// By vertex of the surface: the turn of the skin, by its place on the way from `still` to `head`; 255 for all else.
std::vector<std::uint8_t> turn_of_skin(const Surface& surface, const std::vector<bool>& is_skin,
                                       std::span<const SurfaceVertexId> head, std::span<const SurfaceVertexId> still,
                                       const NeckShape& neck, const HeadLandmarks& marks) {
  const double margin = border_height * marks.height;
  EdgePathSearch search(surface);
  const auto from_head_view = search.from(head);
  const std::vector<double> from_head(from_head_view.begin(), from_head_view.end());
  const auto from_still = search.from(still);
  std::vector<std::uint8_t> turn(surface.vertex_count(), 255);
  for (std::uint32_t s = 0; s < surface.vertex_count(); ++s) {
    if (!is_skin[s]) continue;
    const double down = from_head[s];
    const double up = std::max(0.0, from_still[s] - margin);
    if (std::isinf(down)) {
      turn[s] = std::isinf(up) ? 255 : 0;
    } else if (!std::isinf(up) && down > 0.0) {  // the head itself turns fully
      turn[s] = in_255ths(share_of_turn(up / (down + up), neck, surface.positions[s]));
    }
  }
  return turn;
}

}  // namespace

std::vector<std::uint8_t> turn_with_head(const Surface& surface, std::span<Part> parts, const FeaturePointSet& points,
                                         const glm::vec3& head_pivot, const NeckJoints& joints) {
  const std::optional<HeadLandmarks> marks = find_head_landmarks(points, parts, head_pivot);
  if (!marks) return {};
  const std::vector<bool> is_skin = skin_of(surface, parts);
  const std::vector<SkinBorder> borders = borders_below_jaw(surface, is_skin, *marks);
  std::optional<NeckShape> neck = find_neck_shape(surface, is_skin, *marks, borders);
  if (!neck) return {};
  if (joints.neck) start_shoulders_at(*joints.neck, *marks, *neck);

  std::vector<SurfaceVertexId> seeds;
  for (const SurfacePoint& point : surface_points(surface, points)) {
    if (is_skin[point.vertex.value()]) seeds.push_back(point.vertex);
  }
  const std::vector<SurfaceVertexId> head = head_vertices(surface, seeds, *marks);
  const std::vector<SurfaceVertexId> still = still_skin(surface, is_skin, borders, *neck, *marks);
  std::vector<std::uint8_t> turn = turn_of_skin(surface, is_skin, head, still, *neck, *marks);

  find_parts_of_body(surface, parts, is_skin, turn, *marks);
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    if (parts[p].role == PartRole::skin) continue;
    const bool lies_on_shoulders = !neck->is_cut && reaches_below(surface, PartId(p), neck->shoulders);
    for (const SurfaceVertexId v : surface.members_of(PartId(p))) {
      if (parts[p].role == PartRole::body) {
        turn[v.value()] = 0;
      } else if (lies_on_shoulders) {
        turn[v.value()] = in_255ths(turn_by_height(*marks, *neck, surface.positions[v.value()]));
      }
    }
  }
  return turn;
}

}  // namespace semblante
