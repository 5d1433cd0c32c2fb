#include "core/import/polygon.h"

#include <algorithm>
#include <cassert>

#include <glm/geometric.hpp>

namespace semblante::import {
namespace {

/// Twice the area vector of a triangle, in double.
glm::dvec3 area_vector(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
}

/// Sum of the fan's area vectors: the normal of a polygon, planar or not (Newell).
glm::dvec3 polygon_normal(std::span<const glm::vec3> corners) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) sum += area_vector(corners[0], corners[i], corners[i + 1]);
  return sum;
}

/// Whether p lies in the triangle seen along the normal, its border included.
bool contains(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& p, const glm::dvec3& n) {
  return glm::dot(area_vector(a, b, p), n) >= 0.0 && glm::dot(area_vector(b, c, p), n) >= 0.0 &&
         glm::dot(area_vector(c, a, p), n) >= 0.0;
}

}  // namespace

std::span<const std::array<std::uint32_t, 3>> Triangulator::split(std::span<const glm::vec3> corners) {
  assert(corners.size() >= 3);
  triangles_.clear();
  const glm::dvec3 normal = polygon_normal(corners);
  bool fan_turns_over = false;
  for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) {
    triangles_.push_back({0, i, i + 1});
    fan_turns_over |= glm::dot(area_vector(corners[0], corners[i], corners[i + 1]), normal) < 0.0;
  }
  // A quad of any shape is (a b c) (a c d): the diagonal is an edge for surface distances, and every other reader of
  // the file must choose the same one. Heads have a few slightly concave quads, where it does no harm.
  if (!fan_turns_over || corners.size() == 4) return triangles_;
  std::vector<std::array<std::uint32_t, 3>> fan;
  fan.swap(triangles_);
  // A self-intersecting polygon may run out of ears; then the fan is used.
  if (!clip_ears(corners, normal)) triangles_.swap(fan);
  return triangles_;
}

bool Triangulator::clip_ears(std::span<const glm::vec3> corners, const glm::dvec3& normal) {
  std::uint64_t left = std::min<std::uint64_t>(tests_left_, tests_per_corner * corners.size());
  tests_left_ -= left;
  const bool is_whole = clip_ears(corners, normal, left);
  tests_left_ += left;
  return is_whole;
}

bool Triangulator::clip_ears(std::span<const glm::vec3> corners, const glm::dvec3& normal, std::uint64_t& left) {
  ring_.resize(corners.size());
  for (std::uint32_t i = 0; i < ring_.size(); ++i) ring_[i] = i;
  while (ring_.size() > 3) {
    bool clipped = false;
    for (std::size_t i = 0; i < ring_.size() && !clipped; ++i) {
      if (left <= ring_.size()) return false;
      --left;
      const std::uint32_t before = ring_[(i + ring_.size() - 1) % ring_.size()];
      const std::uint32_t tip = ring_[i];
      const std::uint32_t after = ring_[(i + 1) % ring_.size()];
      if (glm::dot(area_vector(corners[before], corners[tip], corners[after]), normal) <= 0.0) continue;
      left -= ring_.size();
      bool empty = true;
      for (const std::uint32_t other : ring_) {
        if (other == before || other == tip || other == after) continue;
        if (contains(corners[before], corners[tip], corners[after], corners[other], normal)) {
          empty = false;
          break;
        }
      }
      if (!empty) continue;
      triangles_.push_back({before, tip, after});
      ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(i));
      clipped = true;
    }
    if (!clipped) return false;
  }
  triangles_.push_back({ring_[0], ring_[1], ring_[2]});
  return true;
}

}  // namespace semblante::import
