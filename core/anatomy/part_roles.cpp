#include "core/anatomy/part_roles.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <string_view>

#include "core/anatomy/part_shape.h"
#include "core/anatomy/point_lookup.h"
#include "core/anatomy/role_by_name.h"
#include "core/anatomy/role_by_place.h"

namespace semblante {
namespace {

/// The role of a part that has this point, including skin. nullopt for 7.1 and group 11.
std::optional<PartRole> role_of_point(FeaturePointId id) {
  if (is_skin_point(id)) return PartRole::skin;
  const int number = number_of(id);
  switch (group_of(id)) {
    case 3:
      return number == 5 ? PartRole::left_eye : PartRole::right_eye;
    case 6:
      return PartRole::tongue;
    case 9:  // 9.8 and 9.10 are on the upper teeth, 9.9 and 9.11 on the lower
      return number % 2 == 0 ? PartRole::upper_teeth : PartRole::lower_teeth;
    default:
      return std::nullopt;
  }
}

constexpr std::size_t role_count = part_role_names.size();
using Votes = std::array<std::size_t, role_count>;

std::vector<Votes> votes_of_points(const Surface& surface, std::span<const SurfacePoint> points) {
  std::vector<Votes> votes(surface.part_count(), Votes{});
  for (const SurfacePoint& point : points) {
    const std::optional<PartRole> role = role_of_point(point.id);
    if (role) ++votes[surface.part_of[point.vertex.value()].value()][static_cast<std::size_t>(*role)];
  }
  return votes;
}

/// A mesh often has one name and several materials; then the material distinguishes its parts.
std::string most_telling_name(const Model& model, const PartShape& shape) {
  if (shape.material.empty()) return shape.name;
  const auto shared = std::count_if(model.primitives.begin(), model.primitives.end(),
                                    [&](const Primitive& p) { return p.name == shape.name; });
  return shape.name.empty() || shared > 1 ? shape.material : shape.name;
}

constexpr std::size_t skin = static_cast<std::size_t>(PartRole::skin);

/// The part with the most skin points; of equals, and without any, the one with the most vertices.
std::size_t main_skin_part(const Surface& surface, const std::vector<Votes>& votes) {
  const auto size = [&](std::size_t p) { return surface.members_of(PartId(static_cast<std::uint32_t>(p))).size(); };
  std::size_t best = 0;
  for (std::size_t p = 1; p < votes.size(); ++p) {
    if (std::pair(votes[p][skin], size(p)) > std::pair(votes[best][skin], size(best))) best = p;
  }
  return best;
}

/// The part of the face, if no point tells: one named as a face; of equals, and without any, the one with the most
/// vertices that is not named as something else. The body of a character is often larger than its face.
std::size_t main_skin_part_by_name(const Surface& surface, std::span<const PartShape> shapes) {
  const auto rank = [&](std::size_t p) {
    const int by_name = is_face_name(shapes[p]) ? 2 : has_name_of_another_part(shapes[p]) ? 0 : 1;
    return std::pair(shapes[p].triangles > 0 ? by_name : -1,
                     surface.members_of(PartId(static_cast<std::uint32_t>(p))).size());
  };
  std::size_t best = 0;
  for (std::size_t p = 1; p < shapes.size(); ++p) {
    if (rank(p) > rank(best)) best = p;
  }
  return best;
}

/// Whether a part is both eyeballs in one piece. It cannot turn about the pivot of one of them.
bool has_both_eyes(const PartShape& shape, const FeaturePointSet& points) {
  const auto has_one_of = [&](std::initializer_list<std::string_view> names) {
    return std::any_of(names.begin(), names.end(), [&](std::string_view name) {
      const FeaturePoint* const point = find_point(points, name);
      return point != nullptr && point->position.x > shape.low.x && point->position.x < shape.high.x;
    });
  };
  return has_one_of({"3.1", "3.3", "3.5"}) && has_one_of({"3.2", "3.4", "3.6"});
}

}  // namespace

std::optional<PartId> largest_part(std::span<const Part> parts, PartRole role) {
  std::optional<std::uint32_t> largest;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    if (parts[p].role == role && (!largest || parts[p].vertex_count > parts[*largest].vertex_count)) largest = p;
  }
  return largest ? std::optional(PartId(*largest)) : std::nullopt;
}

bool has_part(std::span<const Part> parts, PartRole role) {
  return std::any_of(parts.begin(), parts.end(), [role](const Part& part) { return part.role == role; });
}

bool is_skin_point(FeaturePointId id) {
  const int number = number_of(id);
  switch (group_of(id)) {
    case 2:
    case 4:
    case 5:
    case 8:
    case 10:
      return true;
    case 3:
      return number != 5 && number != 6;
    case 9:
      return number <= 7 || number >= 12;
    default:
      return false;
  }
}

std::vector<std::optional<PartRole>> roles_clear_from_points(const Surface& surface,
                                                             std::span<const SurfacePoint> points) {
  std::vector<std::optional<PartRole>> roles(surface.part_count());
  if (roles.empty()) return roles;
  const std::vector<Votes> votes = votes_of_points(surface, points);
  const std::size_t main = main_skin_part(surface, votes);
  const std::size_t largest = main_skin_part(surface, std::vector<Votes>(votes.size(), Votes{}));
  for (std::size_t p = 0; p < roles.size(); ++p) {
    Votes inner = votes[p];
    inner[skin] = 0;
    const auto most = std::max_element(inner.begin(), inner.end());
    if (*most == 0 || p == largest) continue;
    // A skin with painted eyes has the pupils too, but many more skin points.
    if (p == main && votes[p][skin] > *most) continue;
    roles[p] = static_cast<PartRole>(most - inner.begin());
  }
  return roles;
}

std::vector<Part> describe_parts(const Model& model, const Surface& surface, const FeaturePointSet& points,
                                 std::span<const std::optional<PartRole>> roles_by_user) {
  const std::vector<PartShape> shapes = measure_parts(model, surface);
  std::vector<std::optional<PartRole>> roles(shapes.size());
  if (!shapes.empty()) {
    const std::vector<SurfacePoint> on_surface = surface_points(surface, points);
    roles = roles_clear_from_points(surface, on_surface);
    const std::vector<Votes> votes = votes_of_points(surface, on_surface);
    for (std::size_t p = 0; p < roles.size(); ++p) {
      if (p < roles_by_user.size() && roles_by_user[p]) roles[p] = roles_by_user[p];
      if (!roles[p] && votes[p][skin] > 0) roles[p] = PartRole::skin;
    }
    std::size_t main = main_skin_part(surface, votes);
    if (votes[main][skin] == 0 || roles[main].value_or(PartRole::skin) != PartRole::skin)
      main = main_skin_part_by_name(surface, shapes);
    if (!roles[main]) roles[main] = PartRole::skin;
    guess_roles_by_name(shapes, roles);
    guess_roles_by_place(shapes, points, main, roles);
    for (std::size_t p = 0; p < roles.size(); ++p) {
      if (p < roles_by_user.size() && roles_by_user[p]) continue;
      const bool is_eye = roles[p] == PartRole::left_eye || roles[p] == PartRole::right_eye;
      if (is_eye && has_both_eyes(shapes[p], points)) roles[p] = PartRole::rest;
    }
  }

  std::vector<Part> parts;
  parts.reserve(shapes.size());
  for (std::size_t p = 0; p < shapes.size(); ++p) {
    const PartShape& shape = shapes[p];
    Part part;
    part.name = most_telling_name(model, shape);
    part.role = roles[p].value_or(PartRole::rest);
    part.role_by_user = p < roles_by_user.size() && roles_by_user[p].has_value();
    part.vertex_count = shape.file_vertices;
    part.triangle_count = shape.triangles;
    part.box_min = glm::vec3(shape.low);
    part.box_max = glm::vec3(shape.high);
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace semblante
