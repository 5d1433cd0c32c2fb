#include "core/import/model_builder.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/import/text.h"
#include "core/import/vertex_colors.h"
#include "core/types/printable.h"

namespace semblante::import {
namespace {

/// Squares of coordinates are finite in float32 below this, for any unit of the file.
constexpr float max_coordinate = 1e15F;

bool no_corner_has_one(const std::vector<Triangle>& triangles) {
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t index : triangle) {
      if (index != Model::no_index) return false;
    }
  }
  return true;
}

/// Normalizes normals; removes those of length zero from their corners.
void normalize_normals(Model& model) {
  std::vector<bool> usable(model.normals.size());
  for (std::size_t i = 0; i < model.normals.size(); ++i) {
    const glm::dvec3 normal(model.normals[i]);
    const double length = glm::length(normal);
    usable[i] = std::isfinite(length) && length > 1e-12;
    model.normals[i] = usable[i] ? glm::vec3(normal / length) : glm::vec3(0.0F, 0.0F, 1.0F);
  }
  for (Triangle& triangle : model.normal_triangles) {
    for (std::uint32_t& index : triangle) {
      if (index != Model::no_index && !usable[index]) index = Model::no_index;
    }
  }
}

Status check_positions(const Model& model) {
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const float value = model.positions[i][axis];
      if (!std::isfinite(value)) {
        return Error{ErrorCode::not_finite, "vertex " + std::to_string(i), "a coordinate is not a finite number"};
      }
      if (std::abs(value) > max_coordinate) {
        return Error{ErrorCode::out_of_range, "vertex " + std::to_string(i), "a coordinate is larger than 1e15"};
      }
    }
  }
  return Unit{};
}

/// Those of the file are finite; a texture's transform can make them infinite, which no reader of glTF takes.
Status check_uvs(const Model& model) {
  for (std::size_t i = 0; i < model.uvs.size(); ++i) {
    if (std::abs(model.uvs[i].x) <= max_coordinate && std::abs(model.uvs[i].y) <= max_coordinate) continue;
    return Error{ErrorCode::out_of_range, "texture coordinate " + std::to_string(i),
                 "a texture coordinate is larger than 1e15"};
  }
  return Unit{};
}

/// A displacement has the same bound as a position, because it has the same transforms.
Status check_examples(const Model& model) {
  for (const Example& example : model.examples) {
    for (const glm::vec3& d : example.displacements) {
      if (std::abs(d.x) <= max_coordinate && std::abs(d.y) <= max_coordinate && std::abs(d.z) <= max_coordinate)
        continue;
      return Error{ErrorCode::out_of_range, "morph target " + shown(example.name), "moves a vertex by more than 1e15"};
    }
  }
  return Unit{};
}

bool has_extent(const Model& model) {
  for (const Triangle& triangle : model.triangles) {
    for (const std::uint32_t index : triangle) {
      if (model.positions[index] != model.positions[model.triangles.front()[0]]) return true;
    }
  }
  return false;
}

/// float32 keeps 24 bits of a coordinate. A scan in the coordinates of a map, thousands of kilometres from their
/// origin, loses the shape of its face; empty if nothing that can be seen is lost.
std::optional<std::string> lost_shape(const Model& model) {
  /// The step between two coordinates, as a share of the model's size: about the thickness of an eyelid.
  constexpr double least_share = 1.0 / 2000.0;
  glm::dvec3 low(1e300);
  glm::dvec3 high(-1e300);
  for (const Triangle& triangle : model.triangles) {
    for (const std::uint32_t index : triangle) {
      low = glm::min(low, glm::dvec3(model.positions[index]));
      high = glm::max(high, glm::dvec3(model.positions[index]));
    }
  }
  const glm::dvec3 farthest = glm::max(glm::abs(low), glm::abs(high));
  const auto far = static_cast<float>(std::max({farthest.x, farthest.y, farthest.z}));
  const double step = std::nextafter(far, std::numeric_limits<float>::infinity()) - far;
  const double size = glm::distance(low, high);
  if (model.triangles.empty() || step < least_share * size) return std::nullopt;
  return "the model is so far from the origin that its coordinates are rounded to " + in_three_digits(step) +
         ", and it is only " + in_three_digits(size) + " large: move it to the origin before the export";
}

}  // namespace

void ModelBuilder::begin_primitive(const std::string& name, int material, bool has_colors) {
  if (!model.primitives.empty()) {
    Primitive& last = model.primitives.back();
    if (last.triangle_count == 0) {
      last.name = name;
      last.material = material;
      last.has_colors = has_colors;
      return;
    }
    if (last.name == name && last.material == material && last.has_colors == has_colors) return;
  }
  Primitive next;
  next.name = name;
  next.material = material;
  next.has_colors = has_colors;
  next.first_triangle = static_cast<std::uint32_t>(model.triangles.size());
  model.primitives.push_back(std::move(next));
}

void ModelBuilder::add_triangle(const Corner& a, const Corner& b, const Corner& c) {
  assert(triangles_seen_ < limits_.max_triangles);
  assert(a.vertex < model.positions.size() && b.vertex < model.positions.size() && c.vertex < model.positions.size());
  ++triangles_seen_;
  if (a.vertex == b.vertex || b.vertex == c.vertex || c.vertex == a.vertex) {
    ++degenerate_;
    return;
  }
  if (model.primitives.empty()) begin_primitive("", -1);
  model.triangles.push_back({a.vertex, b.vertex, c.vertex});
  model.uv_triangles.push_back({a.uv, b.uv, c.uv});
  model.normal_triangles.push_back({a.normal, b.normal, c.normal});
  ++model.primitives.back().triangle_count;
}

Result<Model> ModelBuilder::finish(std::string format) && {
  if (Status status = check_positions(model); !status) return status.error();
  if (Status status = check_uvs(model); !status) return status.error();
  if (Status status = check_examples(model); !status) return status.error();
  if (model.triangles.empty() && (limits_.needs_triangles || model.positions.empty())) {
    return Error{ErrorCode::empty, "",
                 degenerate_ == 0 ? "the file has no triangles" : "every triangle of the file uses a vertex twice"};
  }
  if (limits_.needs_triangles && !has_extent(model))
    return Error{ErrorCode::empty, "", "all triangles are at one point"};
  if (degenerate_ > 0) {
    warn(std::to_string(degenerate_) + " triangles that use a vertex twice were omitted");
  }
  if (auto lost = lost_shape(model)) warn(std::move(*lost));
  if (!model.colors.empty()) model.colors.resize(model.positions.size(), white);
  if (keep_seen_colors(model))
    warn("all vertex colours are black and are omitted: the face has those of its materials");
  model.warnings = warnings_.sentences();
  while (!model.primitives.empty() && model.primitives.back().triangle_count == 0) model.primitives.pop_back();
  normalize_normals(model);
  if (model.uvs.empty() || no_corner_has_one(model.uv_triangles)) {
    model.uvs.clear();
    model.uv_triangles.clear();
  }
  if (model.normals.empty() || no_corner_has_one(model.normal_triangles)) {
    model.normals.clear();
    model.normal_triangles.clear();
  }
  for (Material& material : model.materials) material.name = printable(material.name);
  model.format = std::move(format);
  return std::move(model);
}

}  // namespace semblante::import
