#pragma once

#include <cstdint>
#include <string>

#include "core/import/limits.h"
#include "core/types/model.h"
#include "core/types/result.h"

namespace semblante::import {

/// One corner of a triangle: indices into positions, uvs and normals.
struct Corner {
  std::uint32_t vertex = 0;
  std::uint32_t uv = Model::no_index;
  std::uint32_t normal = Model::no_index;
};

/// What all readers share: collects triangles in file order under the current primitive, leaves out those that have a
/// vertex twice, and makes the promises of Model true at the end. Readers fill model.positions, uvs, normals, materials
/// and images themselves, and check every index against them before add_triangle.
class ModelBuilder {
 public:
  explicit ModelBuilder(const ImportLimits& limits) : limits_(limits) {}

  Model model;

  /// Triangles added from now on belong to a primitive of this name (printable()) and material (-1: none).
  void begin_primitive(const std::string& name, int material);
  void add_triangle(const Corner& a, const Corner& b, const Corner& c);
  void warn(std::string message);

  [[nodiscard]] const ImportLimits& limits() const { return limits_; }
  /// How many more triangles may be added; left-out ones count, so that work stays bounded.
  [[nodiscard]] std::size_t triangles_left() const { return limits_.max_triangles - triangles_seen_; }

  /// The finished model, or why there is none: no triangles, a position that is not finite or beyond any unit.
  Result<Model> finish(std::string format) &&;

 private:
  ImportLimits limits_;
  std::size_t triangles_seen_ = 0;
  std::size_t degenerate_ = 0;
  std::size_t suppressed_warnings_ = 0;
};

}  // namespace semblante::import
