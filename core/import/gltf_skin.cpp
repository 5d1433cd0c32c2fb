#include "core/import/gltf_skin.h"

#include <algorithm>
#include <cmath>

namespace semblante::import {
namespace {

/// Inverse bind matrices have the precision of float32, and so have their products.
constexpr double tolerance = 1e-5;

}  // namespace

bool nearly_equal(const glm::dmat4& a, const glm::dmat4& b) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      const double x = a[column][row];
      const double y = b[column][row];
      if (!(std::abs(x - y) <= tolerance * std::max({1.0, std::abs(x), std::abs(y)}))) return false;
    }
  }
  return true;
}

std::vector<glm::dmat4> joint_matrices(GltfDocument& document, std::size_t skin,
                                       std::span<const std::optional<glm::dmat4>> world) {
  const JsonCursor source = document.item("skins", skin);
  const JsonCursor joints = source.member("joints");
  const std::size_t count = joints.size();
  constexpr std::size_t max_joints = 65536;
  if (count > max_joints) joints.fail(ErrorCode::too_large, "has more than " + std::to_string(max_joints) + " joints");
  std::vector<float> inverse_bind;
  const auto accessor = source.index("inverseBindMatrices", document.count("accessors"));
  if (accessor && !document.failed()) inverse_bind = document.floats(*accessor, 16, count);
  std::vector<glm::dmat4> matrices;
  for (std::size_t i = 0; i < count && !document.failed(); ++i) {
    const std::uint64_t node = joints.element(i).integer(0, world.empty() ? 0 : world.size() - 1);
    if (document.failed()) break;
    if (node >= world.size() || !world[node]) return {};
    glm::dmat4 inverse(1.0);
    for (std::size_t k = 0; !inverse_bind.empty() && k < 16; ++k) {
      inverse[static_cast<int>(k / 4)][static_cast<int>(k % 4)] = inverse_bind[16 * i + k];
    }
    matrices.push_back(*world[node] * inverse);
  }
  return matrices;
}

std::optional<glm::dmat4> common_matrix(std::span<const glm::dmat4> matrices) {
  if (matrices.empty()) return std::nullopt;
  for (const glm::dmat4& matrix : matrices) {
    if (!nearly_equal(matrix, matrices.front())) return std::nullopt;
  }
  return nearly_equal(matrices.front(), glm::dmat4(1.0)) ? glm::dmat4(1.0) : matrices.front();
}

}  // namespace semblante::import
