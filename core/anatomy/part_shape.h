#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/geometry/sphere_fit.h"
#include "core/geometry/surface.h"
#include "core/types/model.h"

namespace semblante {

/// The shape of a part, used together with its points to guess its role.
struct PartShape {
  std::string name;      ///< of the primitive with most of its triangles
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

/// Whether a part can be an eyeball: nearly a sphere, and more than a cap of it.
bool is_ball(const PartShape& shape);

}  // namespace semblante
