#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/types/articulation.h"
#include "core/types/facing_lips.h"
#include "core/types/fapu.h"
#include "core/types/feature_points.h"
#include "core/types/moving_parts.h"
#include "core/types/weight_fit.h"
#include "core/types/weight_table.h"

namespace semblante {

/// The anatomical role of a connected part, which determines its motion.
enum class PartRole : std::uint8_t {
  skin,
  left_eye,
  right_eye,
  upper_teeth,
  lower_teeth,
  tongue,
  attached,
  rest,
  body
};
inline constexpr std::array<std::string_view, 9> part_role_names = {
    "skin", "left_eye", "right_eye", "upper_teeth", "lower_teeth", "tongue", "attached", "rest", "body"};

/// A part in reports and for clients.
struct Part {
  std::string name;  ///< of the primitive with most of its triangles; may be empty
  PartRole role = PartRole::skin;
  bool role_by_user = false;       ///< set by the user: a later guess does not change it
  std::uint32_t vertex_count = 0;  ///< file vertices
  std::uint32_t triangle_count = 0;
  glm::vec3 box_min{0.0F}, box_max{0.0F};
};

/// The result of the parametrization of a model, per file vertex. The face package contains it reordered and
/// quantized.
struct Rig {
  FeaturePointSet points;
  Fapu fapu;
  /// #V rows: W of Eq. 4, surface weights only, before roles and the quotient of Eq. 7; shares where
  /// are_shares(method).
  WeightTable<double> weights;
  WeightTable<float> influence;              ///< #V rows: normalized W/sum(W) of Eq. 7, with the roles of parts applied
  std::vector<RigidMotion> rigid_of_vertex;  ///< #V
  std::vector<std::uint8_t> turn_of_vertex;  ///< #V: 255ths of the head's rotation; empty: all turn fully
  std::vector<PartId> part_of_vertex;        ///< #V
  std::vector<Part> parts;                   ///< by PartId
  /// The lip gaps of the closing mouth; empty if unknown, because points are missing or because the weights make each
  /// lip move the other.
  std::optional<LipGaps> lip_gaps;
  glm::vec3 left_eye_pivot{0.0F};
  glm::vec3 right_eye_pivot{0.0F};
  std::array<std::optional<Iris>, 2> irises;  ///< left, right; empty: the eye has no movable iris
  std::optional<Tongue> tongue;               ///< empty: the head has no tongue that can roll
  std::array<std::optional<Lids>, 2> lids;    ///< left, right; empty: the lids move by Eq. 7 alone
  glm::vec3 head_pivot{0.0F};                 ///< 7.1, else the joint of a skeleton, else an estimate
  double articulation = usual_articulation;   ///< the multiple of the library's opening of the jaw in visemes
  std::optional<WeightFit> fit;               ///< only of `fitted` weights
  std::vector<std::string> warnings;          ///< texts: what is missing, and what does not move without it
};

}  // namespace semblante
