#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "core/import/limits.h"
#include "core/types/model.h"
#include "core/types/result.h"
#include "core/types/warning_groups.h"

namespace semblante::import {

/// One corner of a triangle: indices into positions, uvs and normals.
struct Corner {
  std::uint32_t vertex = 0;
  std::uint32_t uv = Model::no_index;
  std::uint32_t normal = Model::no_index;
};

/// Common part of all readers: collects triangles in file order under the current primitive, omits those with a
/// repeated vertex, and establishes the invariants of Model at the end. Readers fill model.positions, uvs, normals,
/// colors, materials and images themselves, and check every index before add_triangle.
class ModelBuilder {
 public:
  explicit ModelBuilder(const ImportLimits& limits) : limits_(limits) {}

  Model model;

  /// Starts a primitive with this name (printable()) and material (-1: none) for the following triangles. `has_colors`:
  /// some of its vertices have a colour in model.colors.
  void begin_primitive(const std::string& name, int material, bool has_colors = false);
  void add_triangle(const Corner& a, const Corner& b, const Corner& c);
  void warn(std::string message) { warnings_.add(std::move(message)); }

  [[nodiscard]] const ImportLimits& limits() const { return limits_; }
  /// Number of triangles that may still be added; omitted ones count, so that the time is bounded.
  [[nodiscard]] std::size_t triangles_left() const { return limits_.max_triangles - triangles_seen_; }

  /// The finished model, or an error: no triangles, or a position that is not finite or too large.
  Result<Model> finish(std::string format) &&;

 private:
  ImportLimits limits_;
  std::size_t triangles_seen_ = 0;
  std::size_t degenerate_ = 0;
  /// Bounds the text that a hostile file can cause.
  static constexpr std::size_t max_kinds_of_warnings = 32;
  WarningGroups warnings_{max_kinds_of_warnings};
};

}  // namespace semblante::import
