#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "core/types/feature_points.h"
#include "core/types/marked_point.h"
#include "core/types/model.h"

namespace semblante::testing {

/// One primitive over all triangles.
Model make_model(std::vector<glm::vec3> positions, std::vector<Triangle> triangles, std::string name = "");

/// A flat strip: bottom vertices k = 0..n at (k, 0, 0), top vertices n+1+k at (k, 1, 0); each square is split from its
/// top left to its bottom right corner.
///
///     t0---t1---t2
///     | \  | \  |
///     b0---b1---b2
Model make_strip(std::uint32_t squares);

/// A grid of columns x rows squares of side 1 in the plane z = 0; vertex (column, row) is row * (columns + 1) + column.
Model make_grid(std::uint32_t columns, std::uint32_t rows);

/// A sphere of triangles; the poles lie on the y axis.
Model make_ball(const glm::vec3& center, float radius, std::uint32_t slices = 16, std::uint32_t stacks = 8);

/// A box of 12 triangles, its faces joined.
Model make_box(const glm::vec3& low, const glm::vec3& high);

/// A plate of columns -6..6 by rows -4..4 in the plane z = 0 with a mouth that is shut: between the corners at (-2, 0,
/// 0) and (2, 0, 0) upper and lower rim have a vertex each at the same place. Behind the rims both lips go back to z =
/// -4 side by side, where they meet.
struct ClosedMouth {
  Model model;
  /// By column and row; of the two at a place on the rims that of the lip asked for.
  [[nodiscard]] std::uint32_t at(int column, int row, bool of_upper = false) const;
};
ClosedMouth make_closed_mouth();

/// The same mesh elsewhere. Two meshes at one place would be stitched where their borders coincide.
Model shifted(Model model, const glm::vec3& by);

/// Adds the vertices and triangles of `more` as a primitive of that name; returns the number of its first vertex.
std::uint32_t append(Model& model, const Model& more, std::string name);

FeaturePointId fp(std::string_view name);
MarkedPoint at_vertex(std::string_view name, std::uint32_t vertex);
MarkedPoint at_position(std::string_view name, const glm::dvec3& position);

using Marks = std::vector<std::pair<std::string_view, std::uint32_t>>;
/// Placed points at file vertices, in rising order of id. A later mark of a point counts in place of an earlier one.
FeaturePointSet points_at(const Model& model, const Marks& marks);
/// `marks` and then `more`.
Marks with(Marks marks, const Marks& more);

}  // namespace semblante::testing
