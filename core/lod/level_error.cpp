#include "core/lod/level_error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>

#include "core/geometry/triangle_shape.h"
#include "core/geometry/triangle_tree.h"
#include "core/lod/corners.h"

namespace semblante {
namespace {

constexpr std::size_t max_samples = 50'000;

/// A vertex of the full mesh.
struct Sample {
  std::uint32_t vertex;
  bool kept;  ///< the level has it: its distance is zero
};

/// Flags of the surface vertices that triangles use.
std::vector<bool> used_by(const Surface& surface, std::span<const Triangle> triangles) {
  std::vector<bool> used(surface.vertex_count(), false);
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) used[surface.surface_of[v].value()] = true;
  }
  return used;
}

std::vector<Sample> choose_samples(const Model& model, const Surface& surface, const LevelOfDetail& level) {
  const std::vector<bool> used = used_by(surface, model.triangles);
  const std::vector<bool> kept = used_by(surface, level.triangles);
  std::vector<Sample> samples;
  for (std::size_t s = 0; s < used.size(); ++s) {
    if (used[s]) samples.push_back({surface.file_vertex_of[s].value(), kept[s]});
  }
  if (samples.size() <= max_samples) return samples;
  std::vector<Sample> some;
  for (std::size_t i = 0; i < max_samples; ++i) some.push_back(samples[i * samples.size() / max_samples]);
  return some;
}

/// The charts of the texture: triangles connected by vertices without a seam.
struct Charts {
  std::vector<std::uint32_t> of_triangle;  ///< #T, some triangle of the chart
  std::vector<std::uint32_t> uv_of;        ///< #S into uvs; no_index on seams and where there is no UV
  std::vector<std::uint32_t> of_vertex;    ///< #S, where uv_of is known
};

std::uint32_t find_root(std::vector<std::uint32_t>& parent, std::uint32_t at) {
  while (parent[at] != at) at = parent[at] = parent[parent[at]];
  return at;
}

Charts find_charts(const Model& model, const Surface& surface) {
  const Corners corners = join_corners(model, surface, {}, /*with_normals=*/false);
  std::vector<std::uint32_t> parent(corners.corners.size());
  std::iota(parent.begin(), parent.end(), 0U);
  for (const auto& t : corners.triangles) {
    for (const std::uint32_t other : {t[1], t[2]}) parent[find_root(parent, other)] = find_root(parent, t[0]);
  }
  Charts charts;
  for (const auto& t : corners.triangles) charts.of_triangle.push_back(find_root(parent, t[0]));
  charts.uv_of.assign(surface.vertex_count(), Model::no_index);
  charts.of_vertex.assign(surface.vertex_count(), Model::no_index);
  std::vector<bool> seen(surface.vertex_count(), false);
  for (std::uint32_t c = 0; c < corners.corners.size(); ++c) {
    const std::uint32_t s = corners.corners[c].surface_vertex;
    charts.uv_of[s] = seen[s] ? Model::no_index : corners.corners[c].uv;
    charts.of_vertex[s] = find_root(parent, c);
    seen[s] = true;
  }
  return charts;
}

/// Nearest points of all samples in one pose; each search starts at `guesses`, which receives the results.
std::vector<TriangleTree::Hit> nearest_places(const Surface& surface, const LevelOfDetail& level,
                                              std::span<const Sample> samples, const TriangleTree& tree,
                                              std::span<const glm::vec3> positions,
                                              std::vector<std::uint32_t>& guesses) {
  const auto part_of = [&](std::uint32_t v) { return surface.part_of[surface.surface_of[v].value()]; };
  std::vector<TriangleTree::Hit> hits(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].kept) continue;
    const PartId part = part_of(samples[i].vertex);
    const auto same_part = [&](std::uint32_t t) { return part_of(level.triangles[t][0]) == part; };
    hits[i] = tree.nearest(glm::dvec3(positions[samples[i].vertex]), same_part, guesses[i]);
    if (std::isfinite(hits[i].distance)) guesses[i] = hits[i].triangle;
  }
  return hits;
}

SurfaceError sum_up(std::span<const Sample> samples, std::span<const TriangleTree::Hit> hits) {
  SurfaceError error;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double distance = samples[i].kept || !std::isfinite(hits[i].distance) ? 0.0 : hits[i].distance;
    error.max = std::max(error.max, distance);
    error.mean += distance;
    error.rms += distance * distance;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(samples.size(), 1));
  error.mean /= count;
  error.rms = std::sqrt(error.rms / count);
  return error;
}

void measure_uvs(const Model& model, const Surface& surface, const LevelOfDetail& level,
                 std::span<const Sample> samples, const TriangleTree& tree, LevelError& error) {
  if (level.uv_triangles.empty()) return;
  const Charts charts = find_charts(model, surface);
  std::size_t measured = 0;
  for (const Sample& sample : samples) {
    const std::uint32_t s = surface.surface_of[sample.vertex].value();
    if (charts.uv_of[s] == Model::no_index) continue;
    ++measured;
    if (sample.kept) continue;
    const auto same_chart = [&](std::uint32_t t) {
      return charts.of_triangle[level.source_triangles[t]] == charts.of_vertex[s];
    };
    const TriangleTree::Hit hit = tree.nearest(glm::dvec3(model.positions[sample.vertex]), same_chart);
    if (!std::isfinite(hit.distance)) continue;
    const Triangle& uvs = level.uv_triangles[hit.triangle];
    if (std::find(uvs.begin(), uvs.end(), Model::no_index) != uvs.end()) continue;
    glm::dvec2 there(0.0);
    for (std::size_t c = 0; c < 3; ++c) there += hit.weights[static_cast<int>(c)] * glm::dvec2(model.uvs[uvs[c]]);
    const double slid = glm::distance(there, glm::dvec2(model.uvs[charts.uv_of[s]]));
    error.uv_max = std::max(error.uv_max, slid);
    error.uv_mean += slid;
  }
  if (measured > 0) error.uv_mean /= static_cast<double>(measured);
}

double uv_area_of(const Model& model, const Triangle& t) {
  if (std::find(t.begin(), t.end(), Model::no_index) != t.end()) return 0.0;
  return twice_uv_area(model.uvs[t[0]], model.uvs[t[1]], model.uvs[t[2]]);
}

glm::dvec3 area_of(const Model& model, const Triangle& t) {
  return area_vector(glm::dvec3(model.positions[t[0]]), glm::dvec3(model.positions[t[1]]),
                     glm::dvec3(model.positions[t[2]]));
}

void count_flips(const Model& model, const Surface& surface, const LevelOfDetail& level, LevelError& error) {
  std::vector<glm::dvec3> around(surface.vertex_count(), glm::dvec3(0.0));
  for (const Triangle& t : model.triangles) {
    const glm::dvec3 area = area_of(model, t);
    for (const std::uint32_t v : t) around[surface.surface_of[v].value()] += area;
  }
  for (std::size_t i = 0; i < level.triangles.size(); ++i) {
    const std::uint32_t source = level.source_triangles[i];
    const Triangle& t = level.triangles[i];
    glm::dvec3 meant(0.0);
    for (const std::uint32_t v : t) meant += around[surface.surface_of[v].value()];
    // Not counted as a flip if the original triangle was also reversed.
    if (glm::dot(area_of(model, t), meant) < 0.0 &&
        glm::dot(area_of(model, t), area_of(model, model.triangles[source])) < 0.0) {
      ++error.flipped_triangles;
    }
    if (level.uv_triangles.empty()) continue;
    if (uv_area_of(model, level.uv_triangles[i]) * uv_area_of(model, model.uv_triangles[source]) < 0.0) {
      ++error.flipped_uvs;
    }
  }
}

}  // namespace

LevelError measure_level(const Model& model, const Surface& surface, const LevelOfDetail& level,
                         std::span<const LodPose> poses) {
  const std::vector<Sample> samples = choose_samples(model, surface, level);
  std::vector<std::uint32_t> guesses(samples.size(), Model::no_index);
  LevelError error;
  TriangleTree tree(model.positions, level.triangles);
  const auto at_rest = nearest_places(surface, level, samples, tree, model.positions, guesses);
  error.neutral = sum_up(samples, at_rest);
  measure_uvs(model, surface, level, samples, tree, error);
  for (const LodPose& pose : poses) {
    tree.move_to(pose.positions);
    error.poses.push_back(sum_up(samples, nearest_places(surface, level, samples, tree, pose.positions, guesses)));
  }
  count_flips(model, surface, level, error);
  return error;
}

}  // namespace semblante
