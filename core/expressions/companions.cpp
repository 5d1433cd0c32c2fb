#include "core/expressions/companions.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
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

/// `point` follows `leader` if they are nearer to each other than `far` times the distance of `from` and `to`.
struct Neighbour {
  std::string_view point, leader, from, to;
  double far;
};
/// Cheeks beside the corners of the mouth. Faces with marked cheeks have 0.36 to 0.8; creatures whose mouths end at the
/// side of the head 0.1.
constexpr double far_cheek = 1.0 / 3.0;
constexpr std::array near_corners = {Neighbour{"5.1", "8.3", "8.3", "8.4", far_cheek},
                                     Neighbour{"5.2", "8.4", "8.3", "8.4", far_cheek}};
/// Folds of lids above and below their edges. Faces with marked folds have 0.41 to 0.52 of the eye's opening above the
/// upper lid, 0.46 to 0.87 below the lower one; proposals on eyes that are wide open or have no fold 0.06 to 0.15.
constexpr double far_upper_fold = 0.4;
constexpr double far_lower_fold = 0.45;
constexpr std::array near_edges = {
    Neighbour{"3.13", "3.1", "3.1", "3.3", far_upper_fold}, Neighbour{"3.14", "3.2", "3.2", "3.4", far_upper_fold},
    Neighbour{"3.9", "3.3", "3.1", "3.3", far_lower_fold}, Neighbour{"3.10", "3.4", "3.2", "3.4", far_lower_fold}};
/// Lower lids above the cheek bones. Faces with marked cheek bones have 0.68 to 0.82 of the eye's width from the edge,
/// 0.45 to 0.67 from the fold; eyes as wide as the face 0.25 and 0.16.
constexpr double far_edge_of_cheek = 0.65;
constexpr double far_fold_of_cheek = 0.45;
constexpr std::array near_cheek_bones = {Neighbour{"3.3", "5.3", "3.11", "3.7", far_edge_of_cheek},
                                         Neighbour{"3.4", "5.4", "3.8", "3.12", far_edge_of_cheek},
                                         Neighbour{"3.9", "5.3", "3.11", "3.7", far_fold_of_cheek},
                                         Neighbour{"3.10", "5.4", "3.8", "3.12", far_fold_of_cheek}};

std::optional<glm::dvec3> place_of(const FeaturePointSet& points, std::string_view name) {
  const FeaturePoint* const point = find_point(points, *parse_feature_point(name));
  return point != nullptr ? std::optional(glm::dvec3(point->position)) : std::nullopt;
}

std::vector<Companion> near_ones(const FeaturePointSet& points, std::span<const Neighbour> neighbours) {
  std::vector<Companion> result;
  for (const Neighbour& n : neighbours) {
    const auto point = place_of(points, n.point);
    const auto leader = place_of(points, n.leader);
    const auto from = place_of(points, n.from);
    const auto to = place_of(points, n.to);
    if (!point || !leader || !from || !to) continue;
    const double far = n.far * glm::distance(*from, *to);
    const double beside = glm::distance(*point, *leader);
    if (!(beside < far)) continue;
    result.push_back(
        {*parse_feature_point(n.point), *parse_feature_point(n.leader), static_cast<float>(1.0 - beside / far)});
  }
  return result;
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
  return near_ones(points, near_corners);
}

std::vector<Companion> folds_beside_near_edges(const FeaturePointSet& points) { return near_ones(points, near_edges); }

std::vector<Companion> lids_above_near_cheek_bones(const FeaturePointSet& points) {
  return near_ones(points, near_cheek_bones);
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
  const auto share_of = [&result](FeaturePointId point, FeaturePointId leader) {
    const auto known = std::find_if(result.begin(), result.end(), [&](const Companion& c) {
      return c.point == point && c.leader == leader && !c.is_choice;
    });
    return known != result.end() ? &known->share : nullptr;
  };
  for (const auto& near : {cheeks_beside_near_corners(points), folds_beside_near_edges(points)}) {
    for (const Companion& companion : near) {
      if (float* const known = share_of(companion.point, companion.leader))
        *known += companion.share * (1.0F - *known);
      else
        result.push_back(companion);
    }
  }
  // A fold goes along with the edge of its lid, and with that already by some of the cheek's displacement.
  for (const Companion& lid : lids_above_near_cheek_bones(points)) {
    float share = lid.share;
    for (const Companion& edge : result) {
      const float* const of_edge = edge.point == lid.point ? share_of(edge.leader, lid.leader) : nullptr;
      if (of_edge != nullptr) share -= edge.share * *of_edge;
    }
    if (share > 0.0F) result.push_back({lid.point, lid.leader, share});
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
