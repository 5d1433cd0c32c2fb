#include "deploy/sample_head/identity.h"

#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/mat3x3.hpp>

#include "deploy/sample_head/half_mesh.h"

namespace semblante::sample_head_detail {
namespace {

/// The place of a point of the sample head on another person, in cm.
Vec3 reshaped(const Vec3& p, const SampleHeadTraits& traits) {
  const double lower_face = glm::smoothstep(-2.0, -7.0, p.y) * (1.0 - glm::smoothstep(-11.5, -15.0, p.y));
  const double below_eyes = glm::smoothstep(-1.8, -12.0, p.y);
  const Vec3 from_nose = (p - Vec3(0.0, -3.2, 10.6)) / Vec3(1.3, 1.9, 2.2);
  const double nose = std::exp(-glm::dot(from_nose, from_nose));
  return {p.x * (1.0 + (traits.jaw_width - 1.0) * lower_face), p.y - (traits.face_length - 1.0) * 11.0 * below_eyes,
          p.z + (traits.nose_length - 1.0) * 2.4 * nose};
}

}  // namespace

void reshape(SampleHeadMesh& mesh, const SampleHeadTraits& traits) {
  constexpr double h = 1e-4;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3 p = Vec3(mesh.positions[v]) * 100.0;
    const auto slope = [&](const Vec3& step) {
      return (reshaped(p + step, traits) - reshaped(p - step, traits)) / (2.0 * h);
    };
    const glm::dmat3 jacobian(slope({h, 0, 0}), slope({0, h, 0}), slope({0, 0, h}));
    mesh.normals[v] = glm::vec3(glm::normalize(glm::inverseTranspose(jacobian) * Vec3(mesh.normals[v])));
    mesh.positions[v] = glm::vec3(reshaped(p, traits) * 0.01);
  }
}

}  // namespace semblante::sample_head_detail
