#include "server/api/mirror_points.h"

#include <algorithm>

#include "core/anatomy/rim_sides.h"
#include "core/tables/mpeg4.h"
#include "core/types/feature_point_id.h"

namespace semblante::api {
namespace {

constexpr double reach = 0.05;  ///< of the box diagonal, as for positions in place_feature_points

std::optional<std::array<double, 3>> position_of(const store::FeaturePointRecord& point,
                                                 const VertexPositions& positions) {
  if (point.vertex) return positions.of(*point.vertex);
  return point.position;
}

}  // namespace

void fill_by_mirror(std::vector<store::FeaturePointRecord>& points, const VertexPositions& positions) {
  std::array<bool, feature_point_count> marked{};
  double middle_sum = 0.0;
  int middle_count = 0;
  for (const auto& point : points) {
    const auto id = parse_feature_point(point.id)->value();
    marked[id] = true;
    if (mpeg4::feature_points[id].mirror != id) continue;
    if (const auto position = position_of(point, positions)) {
      middle_sum += (*position)[0];
      ++middle_count;
    }
  }
  const double middle = middle_count > 0 ? middle_sum / middle_count : 0.0;

  const std::size_t given = points.size();
  for (std::size_t i = 0; i < given; ++i) {
    const auto partner = mpeg4::feature_points[parse_feature_point(points[i].id)->value()].mirror;
    auto position = position_of(points[i], positions);
    if (marked[partner] || !position) continue;
    (*position)[0] = 2.0 * middle - (*position)[0];
    store::FeaturePointRecord mirrored{to_string(FeaturePointId(partner)), std::nullopt, std::nullopt,
                                       points[i].proposal};
    if (points[i].vertex) {
      mirrored.vertex = positions.nearest(*position, reach);
      if (!mirrored.vertex) continue;
      // Where lips or lids touch, the nearest vertex may belong to the other one, which positions alone do not show.
      if (rim_of_point(FeaturePointId(partner)).opening != nullptr) {
        mirrored.vertex = positions.only_one_at(*position);
        if (!mirrored.vertex) mirrored.position = position;
      }
    } else {
      mirrored.position = position;
    }
    marked[partner] = true;
    points.push_back(std::move(mirrored));
  }
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return *parse_feature_point(a.id) < *parse_feature_point(b.id); });
}

}  // namespace semblante::api
