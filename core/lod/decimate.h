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

/// A face in which the error of a level counts: the model's vertices as they are then.
struct LodPose {
  std::string name;
  std::vector<glm::vec3> positions;  ///< #V
};

struct LodOptions {
  /// The most vertices each level may have, as a GPU counts them (corners of different looks); falling, at most
  /// `max_levels`.
  std::vector<std::uint32_t> budgets;
  /// One a triangle: where it changes, borders stay. Empty: the materials of the primitives.
  std::span<const std::uint8_t> labels;
  std::span<const LodPose> poses;
  /// Told how far the work is (0..1); false stops it. May be empty.
  std::function<bool(double progress)> progress;
};

inline constexpr std::size_t max_levels = 8;
/// What a budget may be.
inline constexpr std::uint32_t least_budget = 100, most_budget = 4'000'000;

/// One level of detail of a model: its triangles. Vertices are a subset of the model's, so that positions, UVs,
/// normals, weights, feature points and parts stay what they are, by the model's own numbers.
struct LevelOfDetail {
  std::uint32_t budget = 0;
  std::uint32_t vertex_count = 0;          ///< as the budget counts; more than the budget where nothing more may go
  std::vector<Triangle> triangles;         ///< #T by 3, into Model::positions
  std::vector<Triangle> uv_triangles;      ///< #T by 3 or empty, as in Model
  std::vector<Triangle> normal_triangles;  ///< likewise; empty too where the model is shaded flat
  std::vector<std::uint32_t>
      source_triangles;  ///< #T, rises: the model's triangle each one was; its look is that one's
};

/// Decimates `model` to each of the budgets, every level from the one before, parts of each role by their
/// share. Deterministic. `surface` and `rig` are the model's. Levels that a budget does not make
/// smaller than the one before by a tenth are left out: feature points, lips, lids, borders and seams stay.
///
/// Errors: `cancelled`.
Result<std::vector<LevelOfDetail>> decimate(const Model& model, const Surface& surface, const Rig& rig,
                                            const LodOptions& options);

/// Makes `model` its level: triangles and what hangs on them; vertices keep their numbers, many are unused.
void apply_level(Model& model, const LevelOfDetail& level);

/// `parts` with their counts in `level`.
std::vector<Part> parts_of_level(const Rig& rig, const LevelOfDetail& level);

/// The levels worth having for a model of that many vertices, for who names none: 50000, 20000, 10000, 5000 and 2500,
/// those that save half; none for a model of 10000 or less.
std::vector<std::uint32_t> default_budgets(std::uint32_t vertex_count);

}  // namespace semblante
