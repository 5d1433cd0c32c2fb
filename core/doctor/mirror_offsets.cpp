#include "core/doctor/mirror_offsets.h"

#include <algorithm>
#include <vector>

#include <glm/geometric.hpp>

#include "core/tables/mpeg4.h"

namespace semblante {

std::array<double, feature_point_count> mirror_offsets(const FaceAxes& face) {
  std::array<double, feature_point_count> offsets{};
  if (!face.eye_separation) return offsets;
  // The plane is parallel to the model's axes, half way between the pairs; the median is robust against misplaced
  // points. A remaining tilt of the face is within the threshold.
  std::vector<double> halves;
  for (std::size_t id = 0; id < feature_point_count; ++id) {
    const auto& info = mpeg4::feature_points[id];
    if (info.side == mpeg4::Side::left && face.places[id] && face.places[info.mirror])
      halves.push_back(0.5 * (face.places[id]->x + face.places[info.mirror]->x));
  }
  if (halves.size() < 2) return offsets;
  const auto half = halves.begin() + static_cast<std::ptrdiff_t>(halves.size() / 2);
  std::nth_element(halves.begin(), half, halves.end());

  for (std::size_t id = 0; id < feature_point_count; ++id) {
    const auto& info = mpeg4::feature_points[id];
    if (!face.places[id] || !face.places[info.mirror]) continue;
    glm::dvec3 mirrored = *face.places[info.mirror];
    mirrored.x = 2.0 * *half - mirrored.x;
    const double off = glm::distance(*face.places[id], mirrored) / *face.eye_separation;
    offsets[id] = info.mirror == id ? 0.5 * off : off;
  }
  return offsets;
}

}  // namespace semblante
