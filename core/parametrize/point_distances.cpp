#include "core/parametrize/point_distances.h"

namespace semblante {

PointDistances measure_distances(const Surface& surface, PartId part, std::span<const SurfacePoint> points,
                                 EdgePathSearch& search) {
  PointDistances result;
  result.members = surface.members_of(part);
  for (const SurfacePoint& point : points) {
    if (surface.part_of[point.vertex.value()] == part) result.points.push_back(point);
  }
  const std::size_t count = result.points.size();
  result.to_members.resize(result.members.size() * count);
  result.between.resize(count * count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::span<const double> distances = search.from(result.points[i].vertex);
    for (std::size_t m = 0; m < result.members.size(); ++m) {
      result.to_members[m * count + i] = distances[result.members[m].value()];
    }
    // Lengths added up from either end may differ in the last bit; d_ij must be one number.
    for (std::size_t j = i; j < count; ++j) {
      result.between[i * count + j] = result.between[j * count + i] = distances[result.points[j].vertex.value()];
    }
  }
  return result;
}

}  // namespace semblante
