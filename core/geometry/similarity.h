#pragma once

#include <optional>
#include <span>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace semblante {

/// p -> to + scale * rotation * (p - from).
struct Similarity {
  double scale = 1.0;
  glm::dmat3 rotation{1.0};
  glm::dvec3 from{0.0}, to{0.0};

  [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& p) const { return to + scale * (rotation * (p - from)); }
  /// The p that is mapped to `q`.
  [[nodiscard]] glm::dvec3 back(const glm::dvec3& q) const { return from + (q - to) * rotation / scale; }
};

/// The similarity that maps `from[i]` to `to[i]` with the least squared error (Horn 1987). Empty for fewer than three
/// points, and for collinear or coincident points.
std::optional<Similarity> fit_similarity(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to);

/// Unit eigenvector of the largest eigenvalue of a symmetric matrix; any such vector if that eigenvalue is multiple.
glm::dvec4 principal_axis(const glm::dmat4& symmetric);

}  // namespace semblante
