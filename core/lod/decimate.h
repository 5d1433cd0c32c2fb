#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "core/types/result.h"
#include "core/types/rig.h"

namespace semblante {

/// A pose in which the error of a level counts: the model's vertices in that pose.
struct LodPose {
  std::string name;
  std::vector<glm::vec3> positions;  ///< #V
};

struct LodOptions {
  /// The maximum number of vertices of each level, counted like a GPU (distinct corners); decreasing, at most
  /// `max_levels` entries.
  std::vector<std::uint32_t> budgets;
  /// One per triangle; borders between labels are kept. Empty: the materials of the primitives.
  std::span<const std::uint8_t> labels;
  std::span<const LodPose> poses;
  /// Progress callback (0..1); returning false cancels. May be empty.
  std::function<bool(double progress)> progress;
};

inline constexpr std::size_t max_levels = 8;
/// Range of a budget.
inline constexpr std::uint32_t least_budget = 100, most_budget = 4'000'000;

/// One level of detail of a model: its triangles. Its vertices are a subset of the model's with the model's numbers, so
/// that positions, UVs, weights, feature points and parts stay valid. Its normals are its own.
struct LevelOfDetail {
  std::uint32_t budget = 0;
  std::uint32_t vertex_count =
      0;  ///< counted like the budget; more than the budget if no further vertex may be removed
  std::vector<Triangle> triangles;         ///< #T by 3, into Model::positions
  std::vector<Triangle> uv_triangles;      ///< #T by 3 or empty, as in Model
  std::vector<glm::vec3> normals;          ///< unit length (level_normals.h)
  std::vector<Triangle> normal_triangles;  ///< #T by 3, into `normals`
  std::vector<std::uint32_t>
      source_triangles;  ///< #T, increasing: the original triangle in the model, which defines the look
};

/// Decimates `model` to each of the budgets, every level from the previous one; vertices go where their errors are
/// least and matter least (importance.h), so that the face keeps most of them. Deterministic. `surface` and `rig` are
/// the model's. Feature points, lips, lids, borders and seams are kept; levels that are not at least a tenth smaller
/// than the previous one are omitted.
///
/// Errors: `cancelled`.
Result<std::vector<LevelOfDetail>> decimate(const Model& model, const Surface& surface, const Rig& rig,
                                            const LodOptions& options);

/// Replaces the triangles of `model` (and data per triangle) by the level's; vertices keep their numbers, many are
/// unused.
void apply_level(Model& model, const LevelOfDetail& level);

/// `parts` with their counts in `level`.
std::vector<Part> parts_of_level(const Rig& rig, const LevelOfDetail& level);

/// The default budgets for a model of that many vertices: those of 50000, 20000, 10000, 5000 and 2500 that save at
/// least half; none for a model of 10000 or less.
std::vector<std::uint32_t> default_budgets(std::uint32_t vertex_count);

}  // namespace semblante
