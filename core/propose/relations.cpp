#include "core/propose/relations.h"

#include <algorithm>
#include <string_view>

#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

enum Axis : std::uint8_t { x, y, z };

/// Coordinate `axis` of a point is the mean of those of two other points (the same point twice: level with it).
struct Relation {
  std::string_view id;
  Axis axis;
  std::string_view first, second;
};

constexpr std::array relations = {
    // Half way along the lips.
    Relation{"2.6", x, "2.2", "2.4"},
    Relation{"2.7", x, "2.2", "2.5"},
    Relation{"2.8", x, "2.3", "2.4"},
    Relation{"2.9", x, "2.3", "2.5"},
    Relation{"8.5", x, "8.1", "8.3"},
    Relation{"8.6", x, "8.1", "8.4"},
    Relation{"8.7", x, "8.2", "8.3"},
    Relation{"8.8", x, "8.2", "8.4"},
    // The middle of the eyes.
    Relation{"3.1", x, "3.7", "3.11"},
    Relation{"3.2", x, "3.8", "3.12"},
    Relation{"3.3", x, "3.7", "3.11"},
    Relation{"3.4", x, "3.8", "3.12"},
    Relation{"3.9", x, "3.7", "3.11"},
    Relation{"3.10", x, "3.8", "3.12"},
    Relation{"3.13", x, "3.7", "3.11"},
    Relation{"3.14", x, "3.8", "3.12"},
    // Cheeks level with the corners of the mouth, flanks of the nose with its bump.
    Relation{"5.1", y, "8.3", "8.3"},
    Relation{"5.2", y, "8.4", "8.4"},
    Relation{"9.13", y, "9.12", "9.12"},
    Relation{"9.14", y, "9.12", "9.12"},
    // The borders of the tongue at the depth of its middle.
    Relation{"6.3", z, "6.2", "6.2"},
    Relation{"6.4", z, "6.2", "6.2"},
};

/// The outer contour of the lower lip half way to a corner, and the inner edge there.
struct LowerLip {
  std::string_view outer, inner;
};

constexpr std::array lower_lips = {LowerLip{"8.7", "2.8"}, LowerLip{"8.8", "2.9"}};
/// There the lip is at least this high, as a share of its height in the middle: 0.78 to 1.3 on twenty heads. Else the
/// contour of a high lip, as of a creature, would be proposed on its edge, and 8.2 alone would move the skin below it.
constexpr double least_height = 0.7;

}  // namespace

glm::dvec3 apply_relations(FeaturePointId id, glm::dvec3 place, const Places& settled) {
  const std::string_view name = mpeg4::feature_points[id.value()].id;
  for (const Relation& relation : relations) {
    if (relation.id != name) continue;
    const auto& first = settled[parse_feature_point(relation.first)->value()];
    const auto& second = settled[parse_feature_point(relation.second)->value()];
    if (!first || !second) continue;
    place[relation.axis] = 0.5 * ((*first)[relation.axis] + (*second)[relation.axis]);
  }
  const auto& outer = settled[parse_feature_point("8.2")->value()];
  const auto& inner = settled[parse_feature_point("2.3")->value()];
  for (const LowerLip& half_way : lower_lips) {
    const auto& edge = settled[parse_feature_point(half_way.inner)->value()];
    if (half_way.outer != name || !outer || !inner || !edge) continue;
    place.y = std::min(place.y, edge->y - least_height * (inner->y - outer->y));
  }
  return place;
}

bool has_relation(FeaturePointId id) {
  return std::any_of(relations.begin(), relations.end(),
                     [&](const Relation& r) { return r.id == mpeg4::feature_points[id.value()].id; });
}

}  // namespace semblante
