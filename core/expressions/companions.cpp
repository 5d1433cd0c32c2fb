#include "core/expressions/companions.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include <glm/geometric.hpp>

#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

struct Fold {
  std::string_view fold, edge, brow;
  std::array<std::string_view, 2> corners;
};
constexpr std::array folds = {Fold{"3.13", "3.1", "4.3", {"3.11", "3.7"}}, Fold{"3.14", "3.2", "4.4", {"3.8", "3.12"}}};
/// Distance of a brow from the fold of its lid, in widths of the eye, from which on the fold stays when the brow moves.
constexpr double far_brow = 0.5;

struct Cheek {
  std::string_view cheek, corner;
};
constexpr std::array cheeks = {Cheek{"5.1", "8.3"}, Cheek{"5.2", "8.4"}};
/// Distance of a cheek from the corner of the mouth, in widths of the mouth, from which on it moves as the library
/// says. Faces with marked cheeks have 0.36 to 0.8; creatures whose mouths end at the side of the head 0.1.
constexpr double far_cheek = 1.0 / 3.0;

std::optional<glm::dvec3> place_of(const FeaturePointSet& points, std::string_view name) {
  const FeaturePoint* const point = find_point(points, *parse_feature_point(name));
  return point != nullptr ? std::optional(glm::dvec3(point->position)) : std::nullopt;
}

}  // namespace

std::vector<Companion> folds_below_near_brows(const FeaturePointSet& points) {
  std::vector<Companion> result;
  for (const Fold& eye : folds) {
    const auto fold = place_of(points, eye.fold);
    const auto edge = place_of(points, eye.edge);
    const auto brow = place_of(points, eye.brow);
    const auto inner = place_of(points, eye.corners[0]);
    const auto outer = place_of(points, eye.corners[1]);
    if (!fold || !edge || !brow || !inner || !outer) continue;
    const double above = glm::distance(*brow, *fold);
    const double below = glm::distance(*fold, *edge);
    const double width = glm::distance(*inner, *outer);
    if (!(width > 0.0 && above > 0.0 && above < far_brow * width)) continue;
    const double share = std::min(1.0 - above / (far_brow * width), below / (above + below));
    result.push_back({*parse_feature_point(eye.fold), *parse_feature_point(eye.brow), static_cast<float>(share)});
  }
  return result;
}

std::vector<Companion> cheeks_beside_near_corners(const FeaturePointSet& points) {
  std::vector<Companion> result;
  const auto left = place_of(points, cheeks[0].corner);
  const auto right = place_of(points, cheeks[1].corner);
  if (!left || !right) return result;
  const double far = far_cheek * glm::distance(*left, *right);
  for (const Cheek& side : cheeks) {
    const auto cheek = place_of(points, side.cheek);
    if (!cheek) continue;
    const double beside = glm::distance(*cheek, *place_of(points, side.corner));
    if (!(beside < far)) continue;
    result.push_back(
        {*parse_feature_point(side.cheek), *parse_feature_point(side.corner), static_cast<float>(1.0 - beside / far)});
  }
  return result;
}

std::vector<Companion> companions_of(const FeaturePointSet& points) {
  const auto is_marked = [&points](FeaturePointId id) { return find_point(points, id) != nullptr; };
  std::vector<Companion> result;
  for (const mpeg4::Companion& entry : mpeg4::companions) {
    const Companion companion{FeaturePointId(entry.point), FeaturePointId(entry.leader),
                              static_cast<float>(entry.share), entry.is_choice};
    if (is_marked(companion.point) && is_marked(companion.leader)) result.push_back(companion);
  }
  for (const Companion& fold : folds_below_near_brows(points)) result.push_back(fold);
  for (const Companion& cheek : cheeks_beside_near_corners(points)) {
    const auto known = std::find_if(result.begin(), result.end(), [&cheek](const Companion& c) {
      return c.point == cheek.point && c.leader == cheek.leader;
    });
    if (known != result.end()) known->share += cheek.share * (1.0F - known->share);
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
