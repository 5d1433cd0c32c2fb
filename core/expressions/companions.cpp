#include "core/expressions/companions.h"

#include <algorithm>

#include "core/tables/mpeg4.h"

namespace semblante {

std::vector<Companion> companions_of(const FeaturePointSet& points) {
  const auto is_marked = [&points](FeaturePointId id) {
    return std::any_of(points.begin(), points.end(), [id](const FeaturePoint& point) { return point.id == id; });
  };
  std::vector<Companion> result;
  for (const mpeg4::Companion& entry : mpeg4::companions) {
    const Companion companion{FeaturePointId(entry.point), FeaturePointId(entry.leader),
                              static_cast<float>(entry.share), entry.is_choice};
    if (is_marked(companion.point) && is_marked(companion.leader)) result.push_back(companion);
  }
  return result;
}

std::vector<semblante_companion> to_kernel(std::span<const Companion> companions) {
  std::vector<semblante_companion> result;
  for (const Companion& companion : companions) {
    result.push_back({companion.point.value(), companion.leader.value(),
                      static_cast<std::uint8_t>(companion.is_choice ? 1 : 0), 0, companion.share});
  }
  return result;
}

}  // namespace semblante
