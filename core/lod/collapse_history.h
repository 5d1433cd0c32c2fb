#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/lod/corners.h"

namespace semblante {

/// A triangle of a level: its corners, and the model's triangle that it was.
struct LevelTriangle {
  std::uint32_t source;
  std::array<std::uint32_t, 3> corners;  ///< into Corners::corners
};

/// A mesh to be decimated, and the faces it makes.
struct DecimationMesh {
  const Corners& corners;
  std::span<const glm::vec2> uvs;
  std::span<const glm::dvec3> positions;  ///< #S
  /// Each #S: the same surface in faces where its error counts, too.
  std::span<const std::vector<glm::dvec3>> poses;
  const std::vector<bool>& fixed;  ///< #S, never removed
};

/// All collapses of a group of triangles, one after the other, and so every level between the full mesh and the least.
class CollapseHistory {
 public:
  explicit CollapseHistory(std::vector<LevelTriangle> full);

  // ---- written in this order
  /// A triangle, by its place in the full list, has these corners now.
  void change(std::uint32_t triangle, const std::array<std::uint32_t, 3>& corners);
  void remove(std::uint32_t triangle);
  void end_collapse();

  /// Corners that triangles use after the last collapse: what a GPU draws as vertices.
  [[nodiscard]] std::size_t least() const { return counts_.back(); }
  [[nodiscard]] std::size_t full() const { return counts_.front(); }
  /// Corners at the first moment there are at most `budget`, or the least there are.
  [[nodiscard]] std::size_t count_within(std::size_t budget) const { return counts_[collapses_within(budget)]; }
  /// Appends the triangles of that moment, rising by source.
  void append_triangles(std::size_t budget, std::vector<LevelTriangle>& triangles) const;

 private:
  struct Edit {
    std::uint32_t triangle;
    std::array<std::uint32_t, 3> corners;  ///< Model::no_index: the triangle is gone
  };
  [[nodiscard]] std::size_t collapses_within(std::size_t budget) const;
  void count_out(std::uint32_t corner);

  std::vector<LevelTriangle> full_;
  std::vector<std::array<std::uint32_t, 3>> now_;
  std::vector<Edit> edits_;
  std::vector<std::size_t> edits_after_{0};  ///< by number of collapses
  std::vector<std::size_t> counts_;          ///< by number of collapses; never rises
  std::vector<std::uint32_t> uses_;          ///< by corner: how many triangles have it
  std::size_t used_ = 0;
};

/// Removes vertices of the triangles `sources` of a mesh by half-edge collapse, those first whose loss changes the
/// surface least: quadrics (Garland and Heckbert 1997) added up over the neutral face and all poses, so that what bends
/// in an expression counts although it is flat at rest (Mohr and Gleicher 2003). Ends when at most that share of the
/// corners is left, when nothing more may go, or when `go_on`, asked now and then, says no.
///
/// A collapse is refused where it would move a border, join or cut a seam, remove a fixed vertex, fold a triangle over
/// at rest or in a pose, or fold the texture. Triangles that make no manifold with the others stay as they are.
///
/// `sources` rise; none of the triangles names a surface vertex twice.
CollapseHistory collapse_group(const DecimationMesh& mesh, std::span<const std::uint32_t> sources, double least_share,
                               const std::function<bool()>& go_on);

}  // namespace semblante
