#include "core/anatomy/neck.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>

#include "core/anatomy/point_lookup.h"
#include "core/anatomy/smooth_step.h"
#include "core/geometry/edge_path_search.h"
#include "core/geometry/nearest_point.h"

namespace semblante {
namespace {

// Lengths in units of the height from the chin to the eyes. Human proportions; the shoulders are measured.
constexpr double step_down = 0.05;         ///< between the sections of the neck
constexpr double above_line = 0.01;        ///< how far below the line of the jaw the head still reaches
constexpr double first_section = 0.15;     ///< below the chin: above it a section cuts the jaw
constexpr double longest_neck = 1.6;       ///< the narrowest section is no farther below the chin
constexpr double shoulders_within = 3.0;   ///< and the shoulders begin no farther below it
constexpr double shortest_neck = 0.3;      ///< a cut nearer to the chin: the head turns as a whole
constexpr double nape_below_eyes = 0.6;    ///< the head ends there at the back
constexpr double shoulder_widening = 1.6;  ///< shoulders begin where the neck is wider than its least by this
constexpr double beyond_neck = 1.5;        ///< radii of the neck from its axis: not neck, whatever its height
constexpr double chin_below_mouth = 0.6;   ///< in heights of the eyes above the mouth, without a point of the chin
constexpr double border_height = 0.04;     ///< from the border of the skin: still
constexpr double spanning = 0.5;     ///< of the width of the neck: a border that is less wide is a hole, not its end
constexpr double joint_aside = 0.4;  ///< of a joint from the middle
constexpr double joint_behind_chin = 0.2;      ///< at least
constexpr double joint_far_behind_chin = 2.5;  ///< at most
constexpr double head_joint_below_chin = 0.5;  ///< the head's joint is at most this far below the chin
constexpr double joint_from_shoulders = 0.75;  ///< farther from the neck's joint no shoulders begin
constexpr double near_skull = 0.5;             ///< what is worn on the head is so near to the skin above the eyes,
constexpr double least_on_head = 0.05;         ///< with at least this part of its vertices
constexpr double full_from =
    0.98;  ///< of the way from the shoulders (0) to the head (1): from there vertices turn fully

constexpr std::array<std::string_view, 2> pupil_points = {"3.5", "3.6"};
constexpr std::array<std::string_view, 8> lid_points = {"3.1", "3.2", "3.3", "3.4", "3.7", "3.8", "3.11", "3.12"};

struct Landmarks {
  glm::dvec3 chin{0.0};
  double height = 0.0;  ///< from the chin to the eyes
  glm::dvec3 nape{0.0};
};

/// y of the eyes: of the pupils, else of the corners and edges of the lids, else of the eyeballs.
std::optional<double> eye_height(const FeaturePointSet& points, std::span<const Part> parts) {
  for (const auto& names :
       {std::span<const std::string_view>(pupil_points), std::span<const std::string_view>(lid_points)}) {
    double sum = 0.0;
    int count = 0;
    for (const std::string_view name : names) {
      if (const FeaturePoint* const point = find_point(points, name)) sum += point->position.y, ++count;
    }
    if (count > 0) return sum / count;
  }
  for (const Part& part : parts) {
    if (part.role == PartRole::left_eye || part.role == PartRole::right_eye)
      return 0.5 * (static_cast<double>(part.box_min.y) + part.box_max.y);
  }
  return std::nullopt;
}

std::optional<glm::dvec3> chin_place(const FeaturePointSet& points, double eyes) {
  for (const std::string_view name : {"2.1", "2.10"}) {
    if (const FeaturePoint* const point = find_point(points, name)) return glm::dvec3(point->position);
  }
  for (const std::string_view name : {"8.2", "2.3", "2.2"}) {
    const FeaturePoint* const lip = find_point(points, name);
    if (lip == nullptr) continue;
    return glm::dvec3(lip->position) - glm::dvec3(0.0, chin_below_mouth * (eyes - lip->position.y), 0.0);
  }
  return std::nullopt;
}

std::optional<Landmarks> landmarks_of(const FeaturePointSet& points, std::span<const Part> parts,
                                      const glm::vec3& head_pivot) {
  const std::optional<double> eyes = eye_height(points, parts);
  if (!eyes) return std::nullopt;
  const std::optional<glm::dvec3> chin = chin_place(points, *eyes);
  if (!chin) return std::nullopt;
  Landmarks marks;
  marks.chin = *chin;
  marks.height = *eyes - marks.chin.y;
  if (!(marks.height > 0.0)) return std::nullopt;
  marks.nape = {head_pivot.x, *eyes - nape_below_eyes * marks.height,
                std::min<double>(head_pivot.z, marks.chin.z - 0.5 * marks.height)};
  return marks;
}

/// y of the line from the chin to the nape, seen from the side, at this z.
double jaw_line(const Landmarks& marks, double z) {
  const double t = (z - marks.chin.z) / (marks.nape.z - marks.chin.z);
  return marks.chin.y + std::clamp(t, 0.0, 1.0) * (marks.nape.y - marks.chin.y);
}

bool above_jaw(const Landmarks& marks, const glm::dvec3& p) {
  return p.y >= jaw_line(marks, p.z) - above_line * marks.height;
}

/// The vertices of the head: those above the jaw that are joined to the face above it, so that raised hands are none.
std::vector<SurfaceVertexId> head_vertices(const Surface& surface, std::span<const SurfaceVertexId> seeds,
                                           const Landmarks& marks) {
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

/// A line where the skin ends below the jaw: of a cut neck, of a bust, at a collar.
struct Border {
  std::vector<SurfaceVertexId> vertices;
  double low = std::numeric_limits<double>::infinity(), high = -low;  ///< x
  double top = -std::numeric_limits<double>::infinity();              ///< y
};

/// Whether fewer than two triangles have the edge: both ends of it are joined to their third vertices.
bool is_open_edge(const Surface& surface, SurfaceVertexId a, SurfaceVertexId b) {
  const auto at_a = surface.steps_from(a);
  const auto at_b = surface.steps_from(b);
  const auto common = std::count_if(at_a.begin(), at_a.end(), [&](const Surface::Step& from_a) {
    return std::any_of(at_b.begin(), at_b.end(), [&](const Surface::Step& from_b) { return from_a.to == from_b.to; });
  });
  return common < 2;
}

std::vector<Border> borders_below_jaw(const Surface& surface, const std::vector<bool>& is_skin,
                                      const Landmarks& marks) {
  std::vector<Border> borders;
  std::vector<bool> seen(surface.vertex_count(), false);
  const auto is_below = [&](SurfaceVertexId v) {
    return is_skin[v.value()] && !above_jaw(marks, surface.positions[v.value()]);
  };
  for (std::uint32_t s = 0; s < surface.vertex_count(); ++s) {
    if (seen[s] || !is_below(SurfaceVertexId(s))) continue;
    Border border;
    std::vector<SurfaceVertexId> pending = {SurfaceVertexId(s)};
    while (!pending.empty()) {
      const SurfaceVertexId v = pending.back();
      pending.pop_back();
      bool is_open = false;
      for (const Surface::Step& step : surface.steps_from(v)) {
        if (!is_below(step.to) || !is_open_edge(surface, v, step.to)) continue;
        is_open = true;
        if (!seen[step.to.value()]) pending.push_back(step.to);
        seen[step.to.value()] = true;
      }
      if (!is_open) continue;
      seen[v.value()] = true;
      const glm::dvec3& p = surface.positions[v.value()];
      border.vertices.push_back(v);
      border.low = std::min(border.low, p.x);
      border.high = std::max(border.high, p.x);
      border.top = std::max(border.top, p.y);
    }
    if (!border.vertices.empty()) borders.push_back(std::move(border));
  }
  return borders;
}

/// A horizontal section of the skin near the neck's axis.
struct NeckSection {
  double low = std::numeric_limits<double>::infinity(), high = -low;       ///< x
  double front = -std::numeric_limits<double>::infinity(), back = -front;  ///< z
  [[nodiscard]] double width() const { return high - low; }
};

struct Neck {
  glm::dvec3 axis{0.0};  ///< its middle at the narrowest section
  double radius = 0.0;
  double shoulders = 0.0;  ///< y where they begin, or of the border of a cut neck
  bool is_cut = false;
};

/// The sections from the chin down, `step_down` apart.
std::vector<NeckSection> neck_sections(const Surface& surface, const std::vector<bool>& is_skin,
                                       const Landmarks& marks) {
  const double step = step_down * marks.height;
  std::vector<NeckSection> sections(static_cast<std::size_t>(shoulders_within / step_down) + 1);
  const auto last = static_cast<double>(sections.size() - 1);
  for (std::uint32_t s = 0; s < surface.vertex_count(); ++s) {
    if (!is_skin[s]) continue;
    const glm::dvec3& a = surface.positions[s];
    for (const Surface::Step& edge : surface.steps_from(SurfaceVertexId(s))) {
      const glm::dvec3& b = surface.positions[edge.to.value()];
      if (b.y >= a.y) continue;  // each edge once, downwards
      const auto from = static_cast<std::size_t>(std::clamp(std::ceil((marks.chin.y - a.y) / step), 0.0, last + 1.0));
      const auto end = static_cast<std::size_t>(std::clamp(std::floor((marks.chin.y - b.y) / step), -1.0, last) + 1.0);
      for (std::size_t k = from; k < end; ++k) {
        const double height = marks.chin.y - static_cast<double>(k) * step;
        const glm::dvec3 p = a + (b - a) * ((a.y - height) / (a.y - b.y));
        NeckSection& section = sections[k];
        section.low = std::min(section.low, p.x);
        section.high = std::max(section.high, p.x);
        section.front = std::max(section.front, p.z);
        section.back = std::min(section.back, p.z);
      }
    }
  }
  return sections;
}

/// y of the highest border that is no small hole: sections below it are not whole. Minus infinity without one.
double end_of_whole_sections(std::span<const Border> borders, const std::vector<NeckSection>& sections,
                             std::size_t first) {
  double top = -std::numeric_limits<double>::infinity();
  for (const Border& border : borders) {
    if (border.high - border.low >= spanning * sections[first].width()) top = std::max(top, border.top);
  }
  return top;
}

std::optional<Neck> find_neck(const Surface& surface, const std::vector<bool>& is_skin, const Landmarks& marks,
                              std::span<const Border> borders) {
  const std::vector<NeckSection> sections = neck_sections(surface, is_skin, marks);
  const double step = step_down * marks.height;
  const auto first = static_cast<std::size_t>(first_section / step_down);
  const auto lowest = static_cast<std::size_t>(longest_neck / step_down);
  const double whole = end_of_whole_sections(borders, sections, first);
  std::optional<std::size_t> narrowest;
  std::size_t end = first;
  for (; end < sections.size() && sections[end].width() > 0.0; ++end) {
    if (end > lowest || (narrowest && marks.chin.y - static_cast<double>(end) * step <= whole)) continue;
    if (!narrowest || sections[end].width() < sections[*narrowest].width()) narrowest = end;
  }
  if (!narrowest) return std::nullopt;
  const NeckSection& waist = sections[*narrowest];
  Neck neck;
  neck.axis = {0.5 * (waist.low + waist.high), marks.chin.y - static_cast<double>(*narrowest) * step,
               0.5 * (waist.front + waist.back)};
  neck.radius = 0.5 * waist.width();
  for (std::size_t k = *narrowest; k < end; ++k) {
    if (sections[k].width() <= shoulder_widening * waist.width()) continue;
    neck.shoulders = marks.chin.y - static_cast<double>(k) * step;
    return neck;
  }
  neck.is_cut = true;
  double lowest_skin = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < is_skin.size(); ++s) {
    if (is_skin[s]) lowest_skin = std::min(lowest_skin, surface.positions[s].y);
  }
  neck.shoulders = lowest_skin + border_height * marks.height;
  if (marks.chin.y - neck.shoulders < shortest_neck * marks.height) return std::nullopt;
  return neck;
}

/// Lets the shoulders begin at the neck's joint if they were measured somewhere else: on a body without a waist below
/// its chin (narrow shoulders, hair in one piece with the skin), or where something else is narrow. A measured line
/// near the joint is kept, because skeletons place it anywhere between the nape and the collar bones.
void start_shoulders_at(const SkinJoint& joint, const Landmarks& marks, Neck& neck) {
  if (std::abs(neck.shoulders - static_cast<double>(joint.position.y)) > joint_from_shoulders * marks.height)
    neck.shoulders = joint.position.y;
}

bool is_still(const Neck& neck, const Landmarks& marks, const glm::dvec3& p) {
  if (p.y <= neck.shoulders) return true;
  if (neck.is_cut || p.y >= marks.chin.y) return false;
  return std::hypot(p.x - neck.axis.x, p.z - neck.axis.z) > beyond_neck * neck.radius &&
         p.y < marks.chin.y - first_section * marks.height;
}

/// The share of the head's turn at `way` from the shoulders (0) to the head (1). In front most of the turn is near the
/// shoulders: if the chin goes down, the skin under it makes a pocket before the throat instead of being pushed through
/// it. At the back most of it is near the head, so that the nape does not slide out of the collar.
double share_of_turn(double way, const Neck& neck, const glm::dvec3& p) {
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
double turn_by_height(const Landmarks& marks, const Neck& neck, const glm::dvec3& p) {
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
bool is_below_chin(const Surface& surface, PartId part, const Landmarks& marks) {
  const auto members = surface.members_of(part);
  const auto below = std::count_if(members.begin(), members.end(),
                                   [&](SurfaceVertexId v) { return surface.positions[v.value()].y < marks.chin.y; });
  return 2 * static_cast<std::size_t>(below) > members.size();
}

/// Whether a part below the chin hangs on the body: most of the skin beneath it does not turn.
bool hangs_on_body(const Surface& surface, PartId part, const NearestPoint& skin,
                   std::span<const std::uint8_t> turn_of_skin) {
  double turn = 0.0;
  const auto members = surface.members_of(part);
  for (const SurfaceVertexId v : members) {
    turn += turn_of_skin[skin.nearest(surface.positions[v.value()]).index];
  }
  const auto count = static_cast<double>(members.size());
  return turn < 0.5 * 255.0 * count;
}

bool may_be_body(const Part& part) {
  return !part.role_by_user && (part.role == PartRole::attached || part.role == PartRole::rest);
}

/// By part: whether it is worn on the head, as hair is that reaches down to the waist: enough of its vertices lie on
/// the skull. Parts of one name count together, because hair consists of strands; those without a name or with the
/// skin's count alone.
std::vector<bool> worn_on_head(const Surface& surface, std::span<const Part> parts, const NearestPoint& skin,
                               std::span<const std::uint8_t> turn_of_skin, const Landmarks& marks) {
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
    const NearestPoint::Hit below = skin.nearest(place);
    return below.distance < near_skull * marks.height && turn_of_skin[below.index] == 255;
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

}  // namespace

NeckJoints plausible_joints(const NeckJoints& joints, std::span<const Part> parts, const FeaturePointSet& points) {
  const std::optional<double> eyes = eye_height(points, parts);
  const std::optional<glm::dvec3> chin = eyes ? chin_place(points, *eyes) : std::nullopt;
  if (!chin || !(*eyes > chin->y)) return {};
  const double height = *eyes - chin->y;
  const auto is_within = [&](const std::optional<SkinJoint>& joint, double low, double high) {
    if (!joint) return false;
    const glm::dvec3 from_chin = (glm::dvec3(joint->position) - *chin) / height;
    return std::abs(from_chin.x) <= joint_aside && from_chin.z <= -joint_behind_chin &&
           from_chin.z >= -joint_far_behind_chin && from_chin.y >= low && from_chin.y <= high;
  };
  NeckJoints result;
  if (is_within(joints.head, -head_joint_below_chin, 1.0)) result.head = joints.head;
  const bool is_below_head = !joints.head || (joints.neck && joints.neck->position.y < joints.head->position.y);
  if (is_below_head && is_within(joints.neck, -shoulders_within, 0.0)) result.neck = joints.neck;
  return result;
}

std::vector<std::uint8_t> turn_with_head(const Surface& surface, std::span<Part> parts, const FeaturePointSet& points,
                                         const glm::vec3& head_pivot, const NeckJoints& joints) {
  const std::optional<Landmarks> marks = landmarks_of(points, parts, head_pivot);
  if (!marks) return {};
  const std::vector<bool> is_skin = skin_of(surface, parts);
  const std::vector<Border> borders = borders_below_jaw(surface, is_skin, *marks);
  std::optional<Neck> neck = find_neck(surface, is_skin, *marks, borders);
  if (!neck) return {};
  if (joints.neck) start_shoulders_at(*joints.neck, *marks, *neck);

  std::vector<SurfaceVertexId> seeds;
  for (const SurfacePoint& point : surface_points(surface, points)) {
    if (is_skin[point.vertex.value()]) seeds.push_back(point.vertex);
  }
  std::vector<SurfaceVertexId> still;
  for (std::uint32_t s = 0; s < surface.vertex_count(); ++s) {
    if (is_skin[s] && is_still(*neck, *marks, surface.positions[s])) still.emplace_back(s);
  }
  EdgePathSearch search(surface);
  for (const Border& border : borders) {
    if (border.high - border.low >= spanning * 2.0 * neck->radius)
      still.insert(still.end(), border.vertices.begin(), border.vertices.end());
  }
  const double margin = border_height * marks->height;
  const auto from_head_view = search.from(head_vertices(surface, seeds, *marks));
  const std::vector<double> from_head(from_head_view.begin(), from_head_view.end());
  const auto from_still = search.from(still);

  std::vector<std::uint8_t> turn(surface.vertex_count(), 255);
  std::vector<glm::dvec3> skin;
  std::vector<std::uint8_t> turn_of_skin;
  for (std::uint32_t s = 0; s < surface.vertex_count(); ++s) {
    if (!is_skin[s]) continue;
    const double down = from_head[s];
    const double up = std::max(0.0, from_still[s] - margin);
    if (std::isinf(down)) {
      turn[s] = std::isinf(up) ? 255 : 0;
    } else if (!std::isinf(up)) {
      turn[s] = down + up > 0.0 ? in_255ths(share_of_turn(up / (down + up), *neck, surface.positions[s])) : 255;
    }
    skin.push_back(surface.positions[s]);
    turn_of_skin.push_back(turn[s]);
  }
  // Made for the first part that needs them: most heads have none.
  std::optional<NearestPoint> nearest;
  std::vector<bool> worn;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    if (may_be_body(parts[p]) && is_below_chin(surface, PartId(p), *marks)) {
      if (!nearest) {
        nearest.emplace(skin);
        worn = worn_on_head(surface, parts, *nearest, turn_of_skin, *marks);
      }
      if (!worn[p] && hangs_on_body(surface, PartId(p), *nearest, turn_of_skin)) parts[p].role = PartRole::body;
    }
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
