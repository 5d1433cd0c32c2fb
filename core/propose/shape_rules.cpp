#include "core/propose/shape_rules.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <glm/geometric.hpp>

#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

enum class Search : std::uint8_t {
  climb,     ///< from the nearest vertex along ascending edges: does not cross a dip to another maximum
  farthest,  ///< of all vertices near the place
};

struct Extreme {
  std::string_view id;  ///< id of a point in the middle or on the left
  glm::dvec3 direction;
  double within;  ///< maximum distance from the place, in ES0
  Search search;
};

constexpr glm::dvec3 left{1.0, 0.0, 0.0};
constexpr glm::dvec3 up{0.0, 1.0, 0.0};
constexpr glm::dvec3 out{0.0, 0.0, 1.0};

const std::array extremes = {
    Extreme{"2.1", -up, 0.12, Search::climb},      // bottom of the chin
    Extreme{"2.10", out, 0.2, Search::climb},      // chin boss
    Extreme{"6.1", out, 0.2, Search::climb},       // tip of the tongue
    Extreme{"9.1", left, 0.12, Search::climb},     // wing of the nose
    Extreme{"9.3", out, 0.25, Search::farthest},   // tip of the nose
    Extreme{"10.1", up, 0.25, Search::climb},      // top of the ear
    Extreme{"10.3", -out, 0.25, Search::climb},    // back of the ear
    Extreme{"10.5", -up, 0.2, Search::climb},      // lobe
    Extreme{"11.4", up, 0.8, Search::farthest},    // top of the skull
    Extreme{"11.6", -out, 0.8, Search::farthest},  // back of the skull
};

}  // namespace

PartRole role_of_point(FeaturePointId id) {
  const int number = number_of(id);
  switch (group_of(id)) {
    case 3:
      if (number == 5) return PartRole::left_eye;
      if (number == 6) return PartRole::right_eye;
      return PartRole::skin;
    case 6:
      return PartRole::tongue;
    case 9:
      if (number == 8 || number == 10) return PartRole::upper_teeth;
      if (number == 9 || number == 11) return PartRole::lower_teeth;
      return PartRole::skin;
    default:
      return PartRole::skin;
  }
}

std::optional<std::uint32_t> find_extreme(const FaceSurface& face, const MirrorPlane& plane, FeaturePointId id,
                                          const glm::dvec3& place) {
  const mpeg4::FeaturePointInfo& info = mpeg4::feature_points[id.value()];
  const bool on_right = info.side == mpeg4::Side::right;
  const std::string_view name = on_right ? mpeg4::feature_points[info.mirror].id : info.id;
  const auto* const extreme =
      std::find_if(extremes.begin(), extremes.end(), [&](const Extreme& e) { return e.id == name; });
  if (extreme == extremes.end()) return std::nullopt;
  glm::dvec3 direction = extreme->direction;
  if (on_right) direction.x = -direction.x;
  const MirrorPlane* const on = info.side == mpeg4::Side::center ? &plane : nullptr;
  const PartRole role = role_of_point(id);
  if (extreme->search == Search::farthest) return face.farthest(role, place, extreme->within, direction, on);
  const std::optional<std::uint32_t> start = face.nearest(role, place, on);
  if (!start || glm::distance(face.at(*start), place) > extreme->within) return std::nullopt;
  return face.climb(*start, direction, extreme->within, on);
}

}  // namespace semblante
