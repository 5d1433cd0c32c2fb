#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/types/fapu.h"
#include "core/types/feature_point_id.h"

namespace semblante {

struct Displacement {
  FeaturePointId point;
  glm::vec3 value;  ///< in the unit that the owner of the displacement defines
};

/// A viseme or an expression for any head: the displacement of each FP, each component in units of the FAPU for this FP
/// and axis (fapu_of below). Sorted by point, without zero displacements.
struct DisplacementSet {
  std::string_view name;
  std::span<const Displacement> displacements;
  bool meets_upper_teeth = false;  ///< the lower lip moves to the edge of the upper teeth of each head
  double jaw_open = 0.0;           ///< the amount of jaw_open_action() in a viseme of the library
  bool of_library = false;         ///< else of one face: measured there, or made by a user
};

/// The 15 visemes of FAP 1, by number: sil p_b_m f_v th t_d k_g ch_j_sh s_z n_l r a e i o u. Static
/// lifetime.
std::span<const DisplacementSet> viseme_library();
/// The expressions of FAP 2, by number: none joy sadness anger fear disgust surprise. Static lifetime.
std::span<const DisplacementSet> expression_library();

/// The opening of the jaw that visemes contain, at full strength; FAPU units. Static lifetime.
const DisplacementSet& jaw_open_action();

/// The FAPU of an FP along an axis (0 x, 1 y, 2 z): that of the FAP that moves it along this axis, else that of its
/// region (mouth and jaw: MW, MNS; eyes: ES, IRISD; all else: ES, ENS).
FapuUnit fapu_of(FeaturePointId point, int axis);

/// A displacement that cannot be applied to a head, because its unit is unknown there.
struct MissingUnit {
  FeaturePointId point;
  FapuUnit unit;
};

/// A displacement set on one head.
struct ModelDisplacements {
  std::vector<Displacement> displacements;  ///< model units
  std::vector<MissingUnit> skipped;         ///< omitted FPs, each with its first missing unit
};

/// The set in model units of a head. An FP with a non-zero component in an unknown FAPU is omitted and reported.
ModelDisplacements to_model_units(const DisplacementSet& set, const Fapu& fapu);

/// 84 by 3 floats for the kernel, zero for points that are not in the set.
std::array<float, feature_point_count * 3> to_dense(std::span<const Displacement> displacements);

}  // namespace semblante
