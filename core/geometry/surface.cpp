#include "core/geometry/surface.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include <glm/geometric.hpp>

#include "core/geometry/stitch.h"

namespace semblante {
namespace {

void number_surface_vertices(const Model& model, Surface& surface) {
  const std::vector<std::uint32_t> lowest = stitch_seams(model.positions, model.triangles);
  surface.surface_of.resize(lowest.size());
  for (std::uint32_t v = 0; v < lowest.size(); ++v) {
    if (lowest[v] != v) {
      surface.surface_of[v] = surface.surface_of[lowest[v]];  // numbered already: lowest[v] < v
      continue;
    }
    surface.surface_of[v] = SurfaceVertexId(static_cast<std::uint32_t>(surface.file_vertex_of.size()));
    surface.file_vertex_of.emplace_back(v);
    surface.positions.emplace_back(model.positions[v]);
  }
}

void link_edges(const Model& model, Surface& surface) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;  // both directions
  edges.reserve(model.triangles.size() * 6);
  for (const Triangle& t : model.triangles) {
    if (!has_three_corners(t)) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = surface.surface_of[t[c]].value();
      const std::uint32_t b = surface.surface_of[t[(c + 1) % 3]].value();
      if (a == b) continue;  // its ends were merged by stitching
      edges.emplace_back(a, b);
      edges.emplace_back(b, a);
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

  surface.step_offsets.assign(surface.vertex_count() + 1, 0);
  surface.steps.reserve(edges.size());
  for (const auto& [a, b] : edges) {
    surface.steps.push_back({glm::distance(surface.positions[a], surface.positions[b]), SurfaceVertexId(b)});
    ++surface.step_offsets[a + 1];
  }
  for (std::size_t s = 0; s < surface.vertex_count(); ++s) surface.step_offsets[s + 1] += surface.step_offsets[s];
}

void find_parts(Surface& surface) {
  constexpr PartId unseen(Model::no_index);
  surface.part_of.assign(surface.vertex_count(), unseen);
  std::vector<SurfaceVertexId> pending;
  std::uint32_t count = 0;
  bool has_unused = false;
  // Surface vertices are ordered by their lowest file vertex, so parts found in this order are too.
  for (std::uint32_t seed = 0; seed < surface.vertex_count(); ++seed) {
    if (surface.part_of[seed] != unseen) continue;
    if (surface.steps_from(SurfaceVertexId(seed)).empty()) {
      has_unused = true;
      continue;
    }
    const PartId part(count++);
    surface.part_of[seed] = part;
    pending.assign(1, SurfaceVertexId(seed));
    while (!pending.empty()) {
      const SurfaceVertexId at = pending.back();
      pending.pop_back();
      for (const Surface::Step& step : surface.steps_from(at)) {
        PartId& mark = surface.part_of[step.to.value()];
        if (mark != unseen) continue;
        mark = part;
        pending.push_back(step.to);
      }
    }
  }
  if (has_unused) {
    const PartId loose(count++);
    std::replace(surface.part_of.begin(), surface.part_of.end(), unseen, loose);
  }

  surface.part_offsets.assign(count + 1, 0);
  for (const PartId part : surface.part_of) ++surface.part_offsets[part.value() + 1];
  for (std::size_t p = 0; p < count; ++p) surface.part_offsets[p + 1] += surface.part_offsets[p];
  std::vector<std::uint32_t> next(surface.part_offsets.begin(), surface.part_offsets.end() - 1);
  surface.part_members.resize(surface.vertex_count());
  for (std::uint32_t s = 0; s < surface.vertex_count(); ++s) {
    surface.part_members[next[surface.part_of[s].value()]++] = SurfaceVertexId(s);
  }
}

}  // namespace

Surface build_surface(const Model& model) {
  Surface surface;
  number_surface_vertices(model, surface);
  link_edges(model, surface);
  find_parts(surface);
  return surface;
}

}  // namespace semblante
