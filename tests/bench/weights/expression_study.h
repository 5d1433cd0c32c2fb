#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/geometry/surface.h"
#include "core/parametrize/point_distances.h"
#include "core/types/marked_point.h"

namespace semblante::bench {

/// A head in `expressions/` of its folder, and what predicts its skin: the displacements of its feature points.
struct Expression {
  std::string name;
  std::vector<glm::dvec3> displacement;  ///< #M, of the skin's vertices
};

/// The skin of a real head with its expressions: what the weights of every method are judged by.
struct ExpressionStudy {
  Model model;
  Surface surface;
  PointDistances distances;  ///< of the skin, along edges
  double eye_separation = 0.0;
  std::vector<Triangle> triangles;  ///< of the skin, by member
  std::vector<std::uint32_t> member_of_point;
  std::vector<bool> hidden;  ///< #M: inside the mouth or an eye's socket
  std::vector<Expression> expressions;

  [[nodiscard]] std::size_t member_count() const { return distances.members.size(); }
  [[nodiscard]] std::size_t point_count() const { return distances.points.size(); }
  [[nodiscard]] const glm::dvec3& position(std::size_t member) const {
    return surface.positions[distances.members[member].value()];
  }
};

/// A head without expressions.
ExpressionStudy study_of(Model model, const std::vector<MarkedPoint>& points);
/// An expression from the displacement of each file vertex.
Expression expression_of(const ExpressionStudy& study, std::string name,
                         const std::function<glm::dvec3(std::uint32_t file_vertex)>& displacement);

/// A head with morph targets, which are its expressions.
ExpressionStudy target_study(Model model, const std::vector<MarkedPoint>& points);
/// The same from files, by the positions of its points; throws.
ExpressionStudy read_target_study(const std::filesystem::path& model, const std::filesystem::path& points);
/// Reads `folder`/{neutral.obj, ict-facekit.fps.json, expressions/*.obj}; throws where they cannot be read.
ExpressionStudy read_expression_study(const std::filesystem::path& folder);

/// An edge of a triangle of the skin, by member, with half the cotangent of the angle it faces there. Triangles without
/// area have none.
struct CotangentEdge {
  std::uint32_t a, b;
  double weight;
};
std::vector<CotangentEdge> cotangent_edges(const ExpressionStudy& study);

/// Shares of the points (#F) in each vertex of the skin, #M x #F: D_P = sum(share D).
using Shares = std::vector<double>;

struct Figures {
  /// sum |predicted - true|^2 / sum |true|^2, mean of the expressions.
  double error = 0.0;
  double visible_error = 0.0;  ///< the same of vertices outside the mouth and the eyes' sockets
  /// Mean over the vertices of |cotangent Laplacian of the error| / largest displacement, mean of the expressions. The
  /// Laplacian is sum (cot a + cot b) / 2 (e_j - e_i), not divided by areas.
  double roughness = 0.0;
  double mean_influences = 0.0;
  std::size_t max_influences = 0;
  double lip_leak = 0.0;  ///< greatest share of the lower lip's points in a vertex of the upper lip
  double lid_leak = 0.0;  ///< the same for the lids
  double least = 0.0;     ///< the least share: below zero a vertex can go against its point
};

Figures measure(const ExpressionStudy& study, const Shares& shares);

}  // namespace semblante::bench
