#include "core/import/feature_points_file.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/matrix.hpp>

#include "core/import/json_vector.h"
#include "core/import/text.h"
#include "core/json/json_cursor.h"
#include "core/json/json_tree.h"

namespace semblante {
namespace {

/// Far above the size of 84 points with a page of remarks each.
constexpr JsonLimits point_limits = {.max_bytes = std::size_t{4} << 20U, .max_depth = 64, .max_values = 500'000};

MarkedPoint read_point(FeaturePointId id, const JsonCursor& point) {
  MarkedPoint marked{id, std::nullopt, std::nullopt};
  point.must_be_object();
  if (point.has("vertex")) {
    marked.vertex =
        static_cast<std::uint32_t>(point.member("vertex").integer(0, std::numeric_limits<std::uint32_t>::max()));
  }
  if (point.has("position")) marked.position = import::read_vector(point.member("position"));
  if (point.has("proposed")) marked.proposed = point.member("proposed").boolean();
  if (!marked.vertex && !marked.position) point.fail(ErrorCode::missing, "has neither a vertex nor a position");
  return marked;
}

glm::dmat3 read_axes(const JsonCursor& rows) {
  glm::dmat3 matrix(1.0);
  if (rows.size() != 3) {
    rows.fail(ErrorCode::malformed, "must have 3 rows of 3 numbers");
    return matrix;
  }
  for (int row = 0; row < 3; ++row) {
    const glm::dvec3 values = import::read_vector(rows.element(static_cast<std::size_t>(row)));
    for (int column = 0; column < 3; ++column) matrix[column][row] = values[column];
  }
  // Relative to the size of its rows, so that a change of unit is accepted and a singular matrix is not.
  const double size = glm::length(matrix[0]) * glm::length(matrix[1]) * glm::length(matrix[2]);
  if (!(std::abs(glm::determinant(matrix)) > 1e-6 * size) || !std::isfinite(size)) {
    rows.fail(ErrorCode::invalid_argument, "has no inverse");
  }
  return matrix;
}

}  // namespace

Result<FeaturePointsFile> parse_feature_points(std::string_view json) {
  const auto tree = read_json_object_tree(json, point_limits);
  if (!tree) return tree.error();
  std::optional<Error> fault;
  const JsonCursor root(*tree, fault);
  const JsonCursor points = root.member("points");
  points.must_be_object();
  if (fault) return *fault;
  if (root.integer_or("vertex_index_base", 0) != 0) {
    root.member("vertex_index_base").fail(ErrorCode::unsupported, "must be 0, because vertices are numbered from 0");
  }
  FeaturePointsFile file;
  for (const auto& [name, point] : points.members()) {
    const auto id = parse_feature_point(name);
    if (!id) {
      return Error{ErrorCode::invalid_argument, point.pointer(),
                   import::shown(name) + " is not a feature point of MPEG-4 (2.1 to 11.6)"};
    }
    file.points.push_back(read_point(*id, point));
    if (fault) return *fault;
  }
  if (root.has("to_mpeg4_axes")) file.to_mpeg4_axes = read_axes(root.member("to_mpeg4_axes"));
  if (!fault && file.points.empty()) points.fail(ErrorCode::empty, "has no points");
  if (fault) return *fault;
  std::sort(file.points.begin(), file.points.end(),
            [](const MarkedPoint& a, const MarkedPoint& b) { return a.id < b.id; });
  return file;
}

}  // namespace semblante
