#include "core/expressions/contact.h"

#include <algorithm>

namespace semblante {
namespace {

const FeaturePoint* find(const FeaturePointSet& points, FeaturePointId id) {
  const auto at = std::find_if(points.begin(), points.end(), [&](const FeaturePoint& p) { return p.id == id; });
  return at != points.end() ? &*at : nullptr;
}

Displacement* find(std::vector<Displacement>& displacements, FeaturePointId id) {
  const auto at =
      std::find_if(displacements.begin(), displacements.end(), [&](const Displacement& d) { return d.point == id; });
  return at != displacements.end() ? &*at : nullptr;
}

}  // namespace

void stop_at_contact(std::vector<Displacement>& displacements, const FeaturePointSet& points, double mouth_nose,
                     const std::optional<LipGaps>& gaps) {
  for (std::size_t i = 0; i < facing_lips.size(); ++i) {
    const FacingLips& lips = facing_lips[i];
    const FeaturePointId upper = *parse_feature_point(lips.upper);
    const FeaturePointId lower = *parse_feature_point(lips.lower);
    const FeaturePoint* const above = find(points, upper);
    const FeaturePoint* const below = find(points, lower);
    if (above == nullptr || below == nullptr) continue;
    Displacement* const down = find(displacements, upper);
    Displacement* const up = find(displacements, lower);
    if (down == nullptr || up == nullptr) continue;
    const double apart = gaps ? (*gaps)[i] : std::max(0.0, static_cast<double>(above->position.y) - below->position.y);
    const double closing = static_cast<double>(up->value.y) - down->value.y;
    const double excess = closing - (apart + lip_give * mouth_nose);
    if (excess <= 0.0) continue;
    down->value.y += static_cast<float>(excess / 2.0);
    up->value.y -= static_cast<float>(excess / 2.0);
  }
}

ModelDisplacements on_face(const DisplacementSet& set, const Fapu& fapu, const FeaturePointSet& points,
                           const std::optional<LipGaps>& gaps) {
  ModelDisplacements result = to_model_units(set, fapu);
  if (const auto mns = fapu[FapuUnit::mns]) stop_at_contact(result.displacements, points, 1024.0 * *mns, gaps);
  return result;
}

}  // namespace semblante
