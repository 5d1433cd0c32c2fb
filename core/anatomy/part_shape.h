#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/geometry/sphere_fit.h"
#include "core/geometry/surface.h"
#include "core/types/model.h"

namespace semblante {

/// What a part looks like from outside: what the guess of its role goes by, beside the points on it.
struct PartShape {
  std::string name;      ///< of the primitive most of its triangles belong to
  std::string material;  ///< of that primitive
  std::uint32_t file_vertices = 0;
  std::uint32_t triangles = 0;
  glm::dvec3 low{0.0}, high{0.0};  ///< its box
  glm::dvec3 center{0.0};          ///< mean of its vertices
  std::vector<glm::dvec3> positions;
  std::optional<Sphere> sphere;  ///< best fitting; empty for flat parts

  [[nodiscard]] glm::dvec3 extent() const { return high - low; }
  [[nodiscard]] glm::dvec3 box_center() const { return 0.5 * (low + high); }
};

/// #P shapes, by PartId.
std::vector<PartShape> measure_parts(const Model& model, const Surface& surface);

/// Part of an eyeball or not: nearly a sphere, and more of it than a cap.
bool is_ball(const PartShape& shape);

}  // namespace semblante
