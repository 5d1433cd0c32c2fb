#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "protocol/package/quantization.h"

namespace semblante {

/// A mesh for a GPU: one vertex for every distinct (file vertex, uv, normal, material) corner of a Model.
struct RenderMesh {
  std::vector<std::uint32_t> file_vertex;        ///< #R, the model file's number of each vertex
  std::vector<glm::vec3> positions;              ///< #R
  std::vector<glm::vec3> normals;                ///< #R, those of the file, else smooth ones
  std::vector<glm::vec2> uvs;                    ///< #R, or empty when the model has none
  std::vector<Color8> colors;                    ///< #R, or empty when the model has none
  std::vector<std::uint8_t> materials;           ///< #R, numbers of MaterialAssignment
  std::vector<Triangle> triangles;               ///< #T by 3, in the model's order
  std::vector<std::uint8_t> triangle_materials;  ///< #T
  int position_bits = least_position_bits;       ///< of quantized positions
};

/// Merges equal corners. `smooth` (#S) are the normals used if the file has none: a level of detail can use those of
/// the full model for equally detailed shading. `triangle_materials` has one entry per triangle.
RenderMesh make_render_mesh(const Model& model, const Surface& surface,
                            std::span<const std::uint8_t> triangle_materials, std::span<const glm::vec3> smooth);

/// The least and the greatest coordinates of a mesh that is not empty.
std::pair<glm::vec3, glm::vec3> bounds_of(const RenderMesh& mesh);

}  // namespace semblante
