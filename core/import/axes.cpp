#include "core/import/axes.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace semblante {

void change_axes(Model& model, const glm::dmat3& to_mpeg4) {
  if (to_mpeg4 == glm::dmat3(1.0)) return;
  for (glm::vec3& position : model.positions) position = glm::vec3(to_mpeg4 * glm::dvec3(position));
  for (Example& example : model.examples) {
    for (glm::vec3& displacement : example.displacements) displacement = glm::vec3(to_mpeg4 * glm::dvec3(displacement));
  }
  for (auto* const joint : {&model.neck_joints.neck, &model.neck_joints.head}) {
    if (*joint) (*joint)->position = glm::vec3(to_mpeg4 * glm::dvec3((*joint)->position));
  }
  const glm::dmat3 to_file = glm::inverse(to_mpeg4);
  const glm::dmat3 turn = glm::transpose(to_file);
  for (glm::vec3& normal : model.normals) {
    const glm::dvec3 turned = turn * glm::dvec3(normal);
    const double length = glm::length(turned);
    if (length > 0.0) normal = glm::vec3(turned / length);
  }
  if (glm::determinant(to_mpeg4) < 0.0) {
    for (auto* triangles : {&model.triangles, &model.uv_triangles, &model.normal_triangles}) {
      for (Triangle& triangle : *triangles) std::swap(triangle[1], triangle[2]);
    }
  }
  model.to_file_frame = glm::mat4(glm::dmat4(model.to_file_frame) * glm::dmat4(to_file));
}

void change_axes(FeaturePointsFile& file) {
  if (!file.to_mpeg4_axes) return;
  for (MarkedPoint& point : file.points) {
    if (point.position) point.position = *file.to_mpeg4_axes * *point.position;
  }
}

}  // namespace semblante
