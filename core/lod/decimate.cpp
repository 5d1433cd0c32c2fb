#include "core/lod/decimate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/geometry/stitch.h"
#include "core/lod/collapse_history.h"
#include "core/lod/corners.h"
#include "core/lod/fixed_vertices.h"
#include "core/lod/importance.h"
#include "core/lod/level_normals.h"

namespace semblante {
namespace {

constexpr std::array<std::uint32_t, 5> ladder = {50000, 20000, 10000, 5000, 2500};
/// A model with at most this many vertices is small enough for every client.
constexpr std::uint32_t light_model = 10000;
/// A level with more than this fraction of the vertices of the previous one is omitted.
constexpr double most_of_level_before = 0.9;
/// Minimum of the parts of a role, relative to the level's fraction of the model: teeth must not vanish.
constexpr double least_of_share = 0.125;

std::vector<glm::dvec3> on_surface(const Surface& surface, std::span<const glm::vec3> file_positions) {
  std::vector<glm::dvec3> positions;
  positions.reserve(surface.vertex_count());
  for (const VertexId v : surface.file_vertex_of) positions.emplace_back(file_positions[v.value()]);
  return positions;
}

/// The material of each triangle.
std::vector<std::uint8_t> labels_by_material(const Model& model) {
  std::vector<std::uint8_t> labels(model.triangles.size(), 0);
  for (const Primitive& primitive : model.primitives) {
    const auto first = labels.begin() + static_cast<std::ptrdiff_t>(primitive.first_triangle);
    std::fill_n(first, primitive.triangle_count, static_cast<std::uint8_t>(primitive.material + 1));
  }
  return labels;
}

/// The triangles of the parts of each role, without degenerate triangles.
std::vector<std::vector<std::uint32_t>> triangles_by_role(const Model& model, const Surface& surface, const Rig& rig) {
  std::vector<std::vector<std::uint32_t>> groups(part_role_names.size());
  for (std::uint32_t t = 0; t < model.triangles.size(); ++t) {
    Triangle at{};
    for (std::size_t c = 0; c < 3; ++c) at[c] = surface.surface_of[model.triangles[t][c]].value();
    if (!has_three_corners(at)) continue;
    const PartId part = surface.part_of[at[0]];
    groups[static_cast<std::size_t>(rig.parts[part.value()].role)].push_back(t);
  }
  std::erase_if(groups, [](const auto& group) { return group.empty(); });
  return groups;
}

/// `normals`: by corner.
LevelOfDetail level_from(const Corners& corners, const std::vector<LevelTriangle>& triangles, bool has_uvs,
                         std::span<const glm::vec3> normals) {
  LevelOfDetail level;
  std::vector<std::uint32_t> normal_of(corners.corners.size(), Model::no_index);
  for (const LevelTriangle& triangle : triangles) {
    Triangle vertices{};
    Triangle uvs{};
    Triangle normal_at{};
    for (std::size_t c = 0; c < 3; ++c) {
      const Corner& corner = corners.corners[triangle.corners[c]];
      std::uint32_t& normal = normal_of[triangle.corners[c]];
      if (normal == Model::no_index) {
        normal = static_cast<std::uint32_t>(level.normals.size());
        level.normals.push_back(normals[triangle.corners[c]]);
      }
      vertices[c] = corner.file_vertex;
      uvs[c] = corner.uv;
      normal_at[c] = normal;
    }
    level.source_triangles.push_back(triangle.source);
    level.triangles.push_back(vertices);
    if (has_uvs) level.uv_triangles.push_back(uvs);
    level.normal_triangles.push_back(normal_at);
  }
  return level;
}

/// The limit of a group at a price, and the fraction of its corners that it keeps at any price.
CollapseLimit limit_of(const CollapseHistory& group, double price, double least_share) {
  return {price, static_cast<std::size_t>(least_share * static_cast<double>(group.full()))};
}

/// The least price at which the groups together have at most `budget` corners; the dearest if there is none.
double price_within(const std::vector<CollapseHistory>& groups, std::size_t budget, double least_share) {
  const auto count_at = [&](double price) {
    std::size_t count = 0;
    for (const CollapseHistory& group : groups) count += group.count_at(limit_of(group, price, least_share));
    return count;
  };
  double dearest = 0.0;
  for (const CollapseHistory& group : groups) dearest = std::max(dearest, group.dearest());
  // The bits of positive doubles are in the order of their values: 64 steps find the very price.
  std::uint64_t low = 0;
  auto high = std::bit_cast<std::uint64_t>(dearest);
  while (low < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    if (count_at(std::bit_cast<double>(middle)) <= budget) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return std::bit_cast<double>(high);
}

/// The limits of all groups at one price, with at most this many corners. Each group keeps a fraction of `share`.
std::vector<CollapseLimit> limits_within(const std::vector<CollapseHistory>& groups, std::size_t corners,
                                         double share) {
  const double least_share = least_of_share * share;
  const double price = price_within(groups, corners, least_share);
  std::vector<CollapseLimit> limits;
  limits.reserve(groups.size());
  for (const CollapseHistory& group : groups) limits.push_back(limit_of(group, price, least_share));
  return limits;
}

std::vector<LevelTriangle> triangles_at(const std::vector<CollapseHistory>& groups,
                                        std::span<const CollapseLimit> limits) {
  std::vector<LevelTriangle> triangles;
  for (std::size_t g = 0; g < groups.size(); ++g) groups[g].append_triangles(limits[g], triangles);
  std::sort(triangles.begin(), triangles.end(), [](const auto& a, const auto& b) { return a.source < b.source; });
  return triangles;
}

/// Number of vertices for a client: Draco writes a corner once for every fan of triangles around it that is separated
/// by seams.
std::size_t drawn_vertices(const Corners& corners, const std::vector<LevelTriangle>& triangles) {
  struct Side {
    std::uint32_t low, high;        // file vertices
    std::uint32_t at_low, at_high;  // places in `parent`
    std::uint32_t corner_low, corner_high;
  };
  std::vector<Side> sides;
  sides.reserve(triangles.size() * 3);
  std::vector<std::uint32_t> parent(triangles.size() * 3);
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t at) {
    while (parent[at] != at) at = parent[at] = parent[parent[at]];
    return at;
  };
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t d = (c + 1) % 3;
      Side side{0, 0, t * 3 + c, t * 3 + d, triangles[t].corners[c], triangles[t].corners[d]};
      side.low = corners.corners[side.corner_low].file_vertex;
      side.high = corners.corners[side.corner_high].file_vertex;
      if (side.low > side.high) {
        std::swap(side.low, side.high);
        std::swap(side.at_low, side.at_high);
        std::swap(side.corner_low, side.corner_high);
      }
      sides.push_back(side);
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.at_low) < std::tie(b.low, b.high, b.at_low);
  });
  std::size_t fans = parent.size();
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    fans -= a != b ? 1 : 0;
    parent[std::max(a, b)] = std::min(a, b);
  };
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const Side& a = sides[i - 1];
    const Side& b = sides[i];
    if (a.corner_low != b.corner_low || a.corner_high != b.corner_high) continue;
    join(a.at_low, b.at_low);
    join(a.at_high, b.at_high);
  }
  return fans;
}

/// How far each group is collapsed for a level, and the triangles that are left.
struct LevelShape {
  std::vector<CollapseLimit> limits;
  std::vector<LevelTriangle> triangles;
  std::size_t vertex_count = 0;
};

/// `share`: of the full mesh.
LevelShape shape_within(const std::vector<CollapseHistory>& groups, const Corners& corners, std::uint32_t budget,
                        double share) {
  const auto shape_for = [&](std::size_t aim) {
    LevelShape shape;
    shape.limits = limits_within(groups, aim, share);
    shape.triangles = triangles_at(groups, shape.limits);
    shape.vertex_count = drawn_vertices(corners, shape.triangles);
    return shape;
  };
  LevelShape shape = shape_for(budget);
  // A non-manifold mesh has slightly more vertices than corners: lower the target by the difference, a few times.
  for (std::size_t aim = budget, attempt = 0; shape.vertex_count > budget && attempt < 3; ++attempt) {
    aim -= std::min(aim, shape.vertex_count - budget);
    shape = shape_for(aim);
  }
  return shape;
}

}  // namespace

Result<std::vector<LevelOfDetail>> decimate(const Model& model, const Surface& surface, const Rig& rig,
                                            const LodOptions& options) {
  assert(options.budgets.size() <= max_levels);
  assert(options.labels.empty() || options.labels.size() == model.triangles.size());
  std::vector<LevelOfDetail> levels;
  if (options.budgets.empty()) return levels;
  const Corners corners = options.labels.empty() ? join_corners(model, surface, labels_by_material(model), true)
                                                 : join_corners(model, surface, options.labels, true);
  std::vector<std::vector<glm::dvec3>> poses;
  for (const LodPose& pose : options.poses) poses.push_back(on_surface(surface, pose.positions));
  const std::vector<bool> fixed = fixed_vertices(surface, model, rig.points, rig.influence);
  const std::vector<double> importance = importance_of_vertices(surface, rig);
  const DecimationMesh mesh{corners, model.uvs, surface.positions, poses, fixed, importance, model.colors};
  const double least_share =
      least_of_share * options.budgets.back() / static_cast<double>(std::max<std::size_t>(corners.corners.size(), 1));

  const CornerNormals normals = corner_normals(model, surface, corners);

  std::vector<CollapseHistory> groups;
  std::size_t triangles_done = 0;
  bool stopped = false;
  const auto go_on = [&] {
    const double done = static_cast<double>(triangles_done) / static_cast<double>(model.triangles.size());
    stopped = stopped || (options.progress && !options.progress(done));
    return !stopped;
  };
  for (const auto& sources : triangles_by_role(model, surface, rig)) {
    if (!go_on()) break;
    groups.push_back(collapse_group(mesh, sources, least_share, go_on));
    triangles_done += sources.size();
  }
  if (stopped) return Error{ErrorCode::cancelled, "", "stopped on request"};

  std::size_t before = 0;
  for (const CollapseHistory& group : groups) before += group.full();
  const auto full = static_cast<double>(std::max<std::size_t>(before, 1));
  for (const std::uint32_t budget : options.budgets) {
    if (budget >= before) continue;
    const LevelShape shape = shape_within(groups, corners, budget, budget / full);
    if (static_cast<double>(shape.vertex_count) > most_of_level_before * static_cast<double>(before)) continue;
    std::vector<std::uint32_t> kept(corners.corners.size());
    std::iota(kept.begin(), kept.end(), 0U);
    for (std::size_t g = 0; g < groups.size(); ++g) groups[g].replace_corners(shape.limits[g], kept);
    levels.push_back(level_from(corners, shape.triangles, !model.uvs.empty() && !model.uv_triangles.empty(),
                                level_normals(normals, kept)));
    levels.back().budget = budget;
    levels.back().vertex_count = static_cast<std::uint32_t>(shape.vertex_count);
    before = shape.vertex_count;
  }
  return levels;
}

void apply_level(Model& model, const LevelOfDetail& level) {
  auto source = level.source_triangles.begin();
  std::uint32_t first = 0;
  for (Primitive& primitive : model.primitives) {
    const auto end =
        std::lower_bound(source, level.source_triangles.end(), primitive.first_triangle + primitive.triangle_count);
    primitive.first_triangle = first;
    primitive.triangle_count = static_cast<std::uint32_t>(end - source);
    first += primitive.triangle_count;
    source = end;
  }
  model.triangles = level.triangles;
  model.uv_triangles = level.uv_triangles;
  model.normals = level.normals;
  model.normal_triangles = level.normal_triangles;
}

std::vector<Part> parts_of_level(const Rig& rig, const LevelOfDetail& level) {
  std::vector<Part> parts = rig.parts;
  for (Part& part : parts) part.vertex_count = part.triangle_count = 0;
  std::vector<bool> seen(rig.part_of_vertex.size(), false);
  for (const Triangle& t : level.triangles) {
    ++parts[rig.part_of_vertex[t[0]].value()].triangle_count;
    for (const std::uint32_t v : t) {
      if (seen[v]) continue;
      seen[v] = true;
      ++parts[rig.part_of_vertex[v].value()].vertex_count;
    }
  }
  return parts;
}

std::vector<std::uint32_t> default_budgets(std::uint32_t vertex_count) {
  std::vector<std::uint32_t> budgets;
  if (vertex_count <= light_model) return budgets;
  for (const std::uint32_t budget : ladder) {
    if (budget <= vertex_count / 2) budgets.push_back(budget);
  }
  return budgets;
}

}  // namespace semblante
