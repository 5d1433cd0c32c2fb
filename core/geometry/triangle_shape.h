#pragma once

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace semblante {

/// The normal of triangle abc, towards the side from which it is counter-clockwise; its length is twice the area.
inline glm::dvec3 area_vector(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return glm::cross(b - a, c - a);
}

/// Shape quality of a triangle: 1 for half a square, 0 for a line.
inline double fullness(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double twice_area) {
  const glm::dvec3 ab = b - a;
  const glm::dvec3 bc = c - b;
  const glm::dvec3 ca = a - c;
  const double longest = std::max({glm::dot(ab, ab), glm::dot(bc, bc), glm::dot(ca, ca)});
  return longest > 0.0 ? twice_area / longest : 0.0;
}

/// Twice the signed area of a texture triangle; the sign is its orientation.
inline double twice_uv_area(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
  const glm::dvec2 ab = glm::dvec2(b) - glm::dvec2(a);
  const glm::dvec2 ac = glm::dvec2(c) - glm::dvec2(a);
  return ab.x * ac.y - ab.y * ac.x;
}

}  // namespace semblante
