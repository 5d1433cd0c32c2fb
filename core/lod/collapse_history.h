#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/lod/corners.h"

namespace semblante {

/// A triangle of a level: its corners, and its original triangle in the model.
struct LevelTriangle {
  std::uint32_t source;
  std::array<std::uint32_t, 3> corners;  ///< into Corners::corners
};

/// A mesh to be decimated, and its poses.
struct DecimationMesh {
  const Corners& corners;
  std::span<const glm::vec2> uvs;
  std::span<const glm::dvec3> positions;  ///< #S
  /// Each #S: the surface in the poses whose error also counts.
  std::span<const std::vector<glm::dvec3>> poses;
  const std::vector<bool>& fixed;      ///< #S, never removed
  std::span<const double> importance;  ///< #S, factors of the price of errors there
  std::span<const Color8> colors;      ///< of the file's vertices, or empty
};

/// How far to follow a history: every collapse up to this price, but not below that many corners. A collapse is priced
/// above the one before it, so that a history followed to a price has everything that is cheaper and every number of
/// collapses has a price of its own, also on a flat mesh.
struct CollapseLimit {
  double price = 0.0;
  std::size_t least_corners = 0;
};

/// The sequence of all collapses of a group of triangles: every level between the full and the smallest mesh.
class CollapseHistory {
 public:
  explicit CollapseHistory(std::vector<LevelTriangle> full);

  // ---- recording, in this order
  /// Records the new corners of a triangle, by its index in the full list.
  void change(std::uint32_t triangle, const std::array<std::uint32_t, 3>& corners);
  void remove(std::uint32_t triangle);
  /// `price`: the error of the surface that the collapse makes, 0 or more.
  void end_collapse(double price);

  /// Number of used corners after the last collapse: the vertices that a GPU draws.
  [[nodiscard]] std::size_t least() const { return counts_.back(); }
  [[nodiscard]] std::size_t full() const { return counts_.front(); }
  /// The price of the dearest collapse.
  [[nodiscard]] double dearest() const { return prices_.back(); }
  /// Number of corners at that limit.
  [[nodiscard]] std::size_t count_at(const CollapseLimit& limit) const { return counts_[collapses_at(limit)]; }
  /// Appends the triangles at that limit, by increasing source.
  void append_triangles(const CollapseLimit& limit, std::vector<LevelTriangle>& triangles) const;
  /// Sets for each corner of the group that is gone at that limit the one in its place. `kept`: by corner.
  void replace_corners(const CollapseLimit& limit, std::span<std::uint32_t> kept) const;

 private:
  struct Edit {
    std::uint32_t triangle;
    std::array<std::uint32_t, 3> corners;  ///< Model::no_index: the triangle is gone
  };
  [[nodiscard]] std::size_t collapses_at(const CollapseLimit& limit) const;
  void count_out(std::uint32_t corner);

  std::vector<LevelTriangle> full_;
  std::vector<std::array<std::uint32_t, 3>> now_;
  std::vector<Edit> edits_;
  std::vector<std::size_t> edits_after_{0};  ///< by number of collapses
  std::vector<std::size_t> counts_;          ///< by number of collapses; never rises
  std::vector<double> prices_{0.0};          ///< by number of collapses; rises
  std::vector<std::uint32_t> uses_;          ///< by corner: how many triangles have it
  std::size_t used_ = 0;
};

/// Removes vertices of the triangles `sources` of a mesh by half-edge collapse, in order of the smallest change of the
/// surface, weighted by its importance: quadrics (Garland and Heckbert 1997) summed over the neutral face and all
/// poses, so that regions that are flat at rest but bend in an expression are kept (Mohr and Gleicher 2003). Ends when
/// at most that fraction of the corners is left, when no collapse is allowed, or when `go_on`, called from time to
/// time, returns false.
///
/// A collapse is refused if it would move a border, join or cut a seam, remove a fixed vertex, flip a triangle at rest
/// or in a pose, or fold the texture. Triangles that are not manifold with the others are kept.
///
/// `sources` increase; no triangle has a repeated surface vertex.
CollapseHistory collapse_group(const DecimationMesh& mesh, std::span<const std::uint32_t> sources, double least_share,
                               const std::function<bool()>& go_on);

}  // namespace semblante
