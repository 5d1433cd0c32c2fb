#include "core/parametrize/own_shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace semblante {
namespace {

constexpr double least_share_at_rest = 0.1;
/// A point is at rest if it moves by less than this share of the point that moves most.
constexpr double at_rest = 0.02;

/// The shape by surface vertex; of file vertices at one place the first counts.
Example on_surface(const Example& example, const Surface& surface) {
  std::vector<std::pair<std::uint32_t, glm::vec3>> moved;
  for (std::size_t i = 0; i < example.vertices.size(); ++i) {
    moved.emplace_back(surface.surface_of[example.vertices[i]].value(), example.displacements[i]);
  }
  std::stable_sort(moved.begin(), moved.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  moved.erase(std::unique(moved.begin(), moved.end(), [](const auto& a, const auto& b) { return a.first == b.first; }),
              moved.end());
  Example result{example.name, {}, {}};
  for (const auto& [vertex, displacement] : moved) {
    result.vertices.push_back(vertex);
    result.displacements.push_back(displacement);
  }
  return result;
}

bool is_expression(const Example& shape, std::span<const SurfacePoint> points) {
  std::vector<double> moved;
  for (const SurfacePoint& point : points) moved.push_back(glm::length(glm::dvec3(shape.at(point.vertex.value()))));
  const double most = moved.empty() ? 0.0 : *std::max_element(moved.begin(), moved.end());
  if (!(most > 0.0)) return false;
  const auto still = std::count_if(moved.begin(), moved.end(), [&](double by) { return by <= at_rest * most; });
  return static_cast<double>(still) >= least_share_at_rest * static_cast<double>(moved.size());
}

}  // namespace

OwnShapes own_shapes(const Model& model, const Surface& surface, std::span<const SurfacePoint> points) {
  OwnShapes result;
  for (const Example& example : model.examples) {
    Example shape = on_surface(example, surface);
    if (result.shapes.size() < max_own_shapes && is_expression(shape, points)) {
      result.shapes.push_back(std::move(shape));
    } else {
      result.ignored.push_back(example.name);
    }
  }
  return result;
}

std::vector<Example> shapes_of_members(std::span<const Example> shapes, std::span<const SurfaceVertexId> members) {
  std::vector<Example> result;
  for (const Example& shape : shapes) {
    Example& of_part = result.emplace_back();
    of_part.name = shape.name;
    auto from = members.begin();
    for (std::size_t i = 0; i < shape.vertices.size() && from != members.end(); ++i) {
      from = std::lower_bound(from, members.end(), SurfaceVertexId(shape.vertices[i]));
      if (from == members.end() || from->value() != shape.vertices[i]) continue;
      of_part.vertices.push_back(static_cast<std::uint32_t>(from - members.begin()));
      of_part.displacements.push_back(shape.displacements[i]);
    }
  }
  return result;
}

}  // namespace semblante
