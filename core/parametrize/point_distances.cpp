#include "core/parametrize/point_distances.h"

#include <algorithm>

#include "core/geometry/distances_from_all.h"

namespace semblante {

PointDistances measure_distances(const Surface& graph, PartId part, std::span<const SurfacePoint> points) {
  PointDistances result;
  result.members = graph.members_of(part);
  std::vector<SurfaceVertexId> sources;
  for (const SurfacePoint& point : points) {
    if (graph.part_of[point.vertex.value()] != part) continue;
    result.points.push_back(point);
    sources.push_back(point.vertex);
  }
  const std::size_t count = result.points.size();
  result.to_members = distances_from_all(graph, part, sources);
  // Sums of lengths from either end may differ in the last bit; d_ij is the one from the lower id.
  result.between.resize(count * count);
  for (std::size_t j = 0; j < count; ++j) {
    const auto member = std::lower_bound(result.members.begin(), result.members.end(), sources[j]);
    const auto at_j = static_cast<std::size_t>(member - result.members.begin());
    for (std::size_t i = 0; i <= j; ++i) {
      result.between[i * count + j] = result.between[j * count + i] = result.at(i, at_j);
    }
  }
  return result;
}

}  // namespace semblante
