#include "core/doctor/mirror_offsets.h"

#include <algorithm>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>

#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

/// Parallel to the model's axes, half way between the pairs, for points that show no plane of their own; the median is
/// robust against misplaced points.
std::optional<MirrorPlane> upright_plane(const FaceAxes& face) {
  std::vector<double> halves;
  for (std::size_t id = 0; id < feature_point_count; ++id) {
    const auto& info = mpeg4::feature_points[id];
    if (info.side == mpeg4::Side::left && face.places[id] && face.places[info.mirror])
      halves.push_back(0.5 * (face.places[id]->x + face.places[info.mirror]->x));
  }
  if (halves.size() < 2) return std::nullopt;
  const auto half = halves.begin() + static_cast<std::ptrdiff_t>(halves.size() / 2);
  std::nth_element(halves.begin(), half, halves.end());
  return MirrorPlane{{1.0, 0.0, 0.0}, *half};
}

}  // namespace

std::array<double, feature_point_count> mirror_offsets(const FaceAxes& face) {
  std::array<double, feature_point_count> offsets{};
  if (!face.eye_separation) return offsets;
  const auto plane = face.symmetry ? std::optional(face.symmetry->plane) : upright_plane(face);
  if (!plane) return offsets;
  for (std::size_t id = 0; id < feature_point_count; ++id) {
    const auto& info = mpeg4::feature_points[id];
    if (!face.places[id] || !face.places[info.mirror]) continue;
    const glm::dvec3 mirrored = plane->image(*face.places[info.mirror]);
    const double off = glm::distance(*face.places[id], mirrored) / *face.eye_separation;
    offsets[id] = info.mirror == id ? 0.5 * off : off;
  }
  return offsets;
}

}  // namespace semblante
