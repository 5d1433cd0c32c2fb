#include "core/import/gltf_vertex_transform.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace semblante::import {
namespace {

/// The cofactor matrix transforms normals correctly, even if the transform has no inverse.
glm::dmat3 normal_matrix(const glm::dmat4& transform) {
  const glm::dmat3 m(transform);
  const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return glm::determinant(m) < 0.0 ? -cofactors : cofactors;
}

}  // namespace

VertexTransform::VertexTransform(const MeshPlacement* placement) {
  if (placement == nullptr) return;
  is_identity_ = placement->is_identity;
  to_world_ = placement->to_world;
  joints_ = placement->joints;
}

void VertexTransform::add_joints(const std::vector<float>& joints, const std::vector<float>& weights) {
  std::vector<Influence> set(std::min(joints.size(), weights.size()));
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (joints[i] >= 0.0F && joints[i] < static_cast<float>(joints_->size()) && weights[i] > 0.0F) {
      set[i] = {static_cast<std::uint32_t>(joints[i]), weights[i]};
    }
  }
  sets_.push_back(std::move(set));
}

glm::dmat4 VertexTransform::matrix(std::size_t vertex) const {
  if (joints_ == nullptr) return to_world_;
  glm::dmat4 sum(0.0);
  double total = 0.0;
  for (const std::vector<Influence>& set : sets_) {
    for (std::size_t i = 4 * vertex; i < 4 * vertex + 4 && i < set.size(); ++i) {
      if (set[i].weight == 0.0F) continue;
      sum += static_cast<double>(set[i].weight) * (*joints_)[set[i].joint];
      total += static_cast<double>(set[i].weight);
    }
  }
  return total > 0.0 ? sum / total : to_world_;
}

bool VertexTransform::mirrors() const {
  return moves() && glm::determinant(glm::dmat3(joints_ == nullptr ? to_world_ : joints_->front())) < 0.0;
}

glm::vec3 VertexTransform::position(std::size_t vertex, const glm::vec3& value) const {
  if (!moves()) return value;
  return glm::vec3(glm::dvec3(matrix(vertex) * glm::dvec4(value, 1.0)));
}

glm::vec3 VertexTransform::displacement(std::size_t vertex, const glm::vec3& value) const {
  if (!moves()) return value;
  return glm::vec3(glm::dmat3(matrix(vertex)) * glm::dvec3(value));
}

glm::vec3 VertexTransform::normal(std::size_t vertex, const glm::vec3& value) const {
  if (!moves()) return value;
  const glm::dvec3 turned = normal_matrix(matrix(vertex)) * glm::dvec3(value);
  const double length = glm::length(turned);
  // Normalized before the conversion to float: the cofactors of a model in millimetres would underflow.
  return length > 0.0 ? glm::vec3(turned / length) : glm::vec3(0.0F);
}

}  // namespace semblante::import
