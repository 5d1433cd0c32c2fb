#include "core/expressions/contact.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>

#include "core/expressions/companions.h"
#include "core/tables/openings.h"

namespace semblante {
namespace {

constexpr std::array lower_lip = {"2.3", "2.8", "2.9", "8.2", "8.7", "8.8"};

Displacement* find(std::vector<Displacement>& displacements, FeaturePointId id) {
  const auto at =
      std::find_if(displacements.begin(), displacements.end(), [&](const Displacement& d) { return d.point == id; });
  return at != displacements.end() ? &*at : nullptr;
}

/// Lips of one skin that stop are not overtaken by their outer contours, or the skin would fold there.
void press_less(std::vector<Displacement>& displacements, float share) {
  for (Displacement& d : displacements) {
    const std::string name = to_string(d.point);
    if (name.substr(0, 2) != "8.") continue;
    const bool is_upper = std::find(mpeg4::mouth.upper_flesh.begin(), mpeg4::mouth.upper_flesh.end(), name) !=
                          mpeg4::mouth.upper_flesh.end();
    const bool is_lower = std::find(mpeg4::mouth.lower_flesh.begin(), mpeg4::mouth.lower_flesh.end(), name) !=
                          mpeg4::mouth.lower_flesh.end();
    if ((is_upper && d.value.y < 0.0F) || (is_lower && d.value.y > 0.0F)) d.value.y *= share;
  }
}

bool is_by_hand(const Fapu& fapu, FapuUnit unit) {
  return fapu.origin[static_cast<std::size_t>(unit)] == FapuOrigin::user;
}

/// `unit` at most `share` of `other`, unless it was given by hand.
void limit(Fapu& fapu, FapuUnit unit, double share, FapuUnit other) {
  auto& value = fapu.value[static_cast<std::size_t>(unit)];
  if (!value || !fapu[other] || is_by_hand(fapu, unit)) return;
  value = std::min(*value, share * *fapu[other]);
}

/// MNS at least that of people with this mouth or with these eyes, unless it was given by hand.
void widen_upper_lip(Fapu& fapu) {
  auto& lip = fapu.value[static_cast<std::size_t>(FapuUnit::mns)];
  const auto mouth = fapu[FapuUnit::mw];
  const auto eyes = fapu[FapuUnit::es];
  if (!lip || !mouth || !eyes || is_by_hand(fapu, FapuUnit::mns)) return;
  lip = std::max(*lip, std::min(least_lip_of_mouth * *mouth, least_lip_of_eyes * *eyes));
}

/// Where the set moves both, a follower moves by its share as its leader.
void follow(std::vector<Displacement>& displacements, std::span<const Companion> followers) {
  for (const Companion& follower : followers) {
    Displacement* const near = find(displacements, follower.point);
    const Displacement* const leader = find(displacements, follower.leader);
    if (near == nullptr || leader == nullptr) continue;
    near->value += follower.share * (leader->value - near->value);
  }
}

}  // namespace

void stop_at_contact(std::vector<Displacement>& displacements, const FeaturePointSet& points, double mouth_nose,
                     const std::optional<LipGaps>& gaps) {
  const bool joined = gaps && gaps->joined;
  double share = 1.0;
  for (std::size_t i = 0; i < facing_lips.size(); ++i) {
    const FacingLips& lips = facing_lips[i];
    const FeaturePointId upper = *parse_feature_point(lips.upper);
    const FeaturePointId lower = *parse_feature_point(lips.lower);
    const FeaturePoint* const above = find_point(points, upper);
    const FeaturePoint* const below = find_point(points, lower);
    if (above == nullptr || below == nullptr) continue;
    Displacement* const down = find(displacements, upper);
    Displacement* const up = find(displacements, lower);
    if (down == nullptr || up == nullptr) continue;
    const double apart =
        gaps ? gaps->closing[i] : std::max(0.0, static_cast<double>(above->position.y) - below->position.y);
    const double closing = static_cast<double>(up->value.y) - down->value.y;
    const double give = joined ? 0.0 : lip_give * mouth_nose;
    const double excess = closing - (apart + give);
    if (excess <= 0.0) continue;
    down->value.y += static_cast<float>(excess / 2.0);
    up->value.y -= static_cast<float>(excess / 2.0);
    share = std::min(share, (apart + give) / closing);
  }
  if (joined) press_less(displacements, static_cast<float>(share));
}

void reach_upper_teeth(std::vector<Displacement>& displacements, const FeaturePointSet& points) {
  const FeaturePoint* const lip = find_point(points, *parse_feature_point("2.3"));
  const FeaturePoint* const teeth = find_point(points, *parse_feature_point("9.10"));
  const Displacement* const middle = find(displacements, *parse_feature_point("2.3"));
  if (lip == nullptr || teeth == nullptr || middle == nullptr || middle->value.z >= 0.0F) return;
  const double back = static_cast<double>(lip->position.z) - teeth->position.z;
  const double scale =
      std::clamp(-share_to_teeth * back / static_cast<double>(middle->value.z), 1.0 / most_to_teeth, most_to_teeth);
  for (const char* const name : lower_lip) {
    if (Displacement* const d = find(displacements, *parse_feature_point(name))) {
      d->value.z = static_cast<float>(scale * static_cast<double>(d->value.z));
    }
  }
}

void follow_near_brows(std::vector<Displacement>& displacements, const FeaturePointSet& points) {
  for (const Companion& follower : folds_below_near_brows(points)) {
    Displacement* const fold = find(displacements, follower.point);
    const Displacement* const brow = find(displacements, follower.leader);
    if (fold == nullptr || brow == nullptr) continue;
    const float along = follower.share * brow->value.y;
    const bool is_less = along < 0.0F ? fold->value.y < 0.0F && fold->value.y > along  //
                                      : fold->value.y > 0.0F && fold->value.y < along;
    if (is_less) fold->value.y = along;
  }
}

void follow_near_corners(std::vector<Displacement>& displacements, const FeaturePointSet& points) {
  follow(displacements, cheeks_beside_near_corners(points));
}

void follow_near_edges(std::vector<Displacement>& displacements, const FeaturePointSet& points) {
  follow(displacements, folds_beside_near_edges(points));
}

void keep_lids_shut(std::vector<Displacement>& displacements) {
  for (const mpeg4::Opening& opening : mpeg4::openings) {
    if (opening.is_mouth) continue;
    for (const std::string_view name : opening.upper) {
      if (Displacement* const lid = find(displacements, *parse_feature_point(name)))
        lid->value.y = std::min(lid->value.y, 0.0F);
    }
    for (const std::string_view name : opening.lower) {
      if (Displacement* const lid = find(displacements, *parse_feature_point(name)))
        lid->value.y = std::max(lid->value.y, 0.0F);
    }
  }
}

std::vector<Displacement> articulated(const DisplacementSet& set, double articulation) {
  std::vector<Displacement> result(set.displacements.begin(), set.displacements.end());
  const auto more = static_cast<float>((articulation - usual_articulation) * set.jaw_open);
  for (const Displacement& jaw : jaw_open_action().displacements) {
    if (Displacement* const moved = find(result, jaw.point)) moved->value += more * jaw.value;
  }
  return result;
}

Fapu units_of_library(const Fapu& fapu) {
  Fapu result = fapu;
  limit(result, FapuUnit::ens, most_nose_of_eyes, FapuUnit::es);
  limit(result, FapuUnit::mns, most_lip_of_mouth, FapuUnit::mw);
  widen_upper_lip(result);
  return result;
}

ModelDisplacements on_face(const DisplacementSet& set, const Fapu& fapu, const FeaturePointSet& points,
                           const std::optional<LipGaps>& gaps, double articulation) {
  const std::vector<Displacement> displacements = articulated(set, articulation);
  const Fapu units = set.of_library ? units_of_library(fapu) : fapu;
  ModelDisplacements result = to_model_units({set.name, displacements}, units);
  if (set.meets_upper_teeth) reach_upper_teeth(result.displacements, points);
  if (set.of_library) {
    follow_near_brows(result.displacements, points);
    follow_near_edges(result.displacements, points);
    follow_near_corners(result.displacements, points);
    if (fapu.origin[static_cast<std::size_t>(FapuUnit::irisd)] == FapuOrigin::closed_eyes)
      keep_lids_shut(result.displacements);
  }
  if (const auto mns = units[FapuUnit::mns]) stop_at_contact(result.displacements, points, 1024.0 * *mns, gaps);
  return result;
}

}  // namespace semblante
