#include "core/expressions/kernel_rig.h"

#include <type_traits>

#include "core/expressions/companions.h"
#include "core/expressions/contact.h"
#include "core/expressions/kernel_parts.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

static_assert(SEMBLANTE_FP_COUNT == feature_point_count && feature_point_count == mpeg4::feature_points.size());
static_assert(SEMBLANTE_FAP_COUNT == mpeg4::fap_count);
static_assert(SEMBLANTE_FAPU_COUNT == fapu_unit_count);
static_assert(SEMBLANTE_VISEME_COUNT == mpeg4::viseme_count);
static_assert(SEMBLANTE_EXPRESSION_COUNT == mpeg4::expression_count);
static_assert(static_cast<int>(RigidMotion::left_eye) == SEMBLANTE_RIGID_LEFT_EYE);
static_assert(static_cast<int>(RigidMotion::right_eye) == SEMBLANTE_RIGID_RIGHT_EYE);
static_assert(static_cast<int>(RigidMotion::left_iris) == SEMBLANTE_RIGID_LEFT_IRIS);
static_assert(static_cast<int>(RigidMotion::right_iris) == SEMBLANTE_RIGID_RIGHT_IRIS);
static_assert(static_cast<int>(RigidMotion::left_lids) == SEMBLANTE_RIGID_LEFT_LIDS);
static_assert(static_cast<int>(RigidMotion::right_lids) == SEMBLANTE_RIGID_RIGHT_LIDS);
static_assert(Lids::ball_places == SEMBLANTE_BALL_PLACES);
static_assert(static_cast<int>(RigidMotion::tongue_least) == SEMBLANTE_RIGID_TONGUE);
// The kernel reads the strong ids and enums as bytes.
static_assert(sizeof(FeaturePointId) == 1 && std::is_standard_layout_v<FeaturePointId>);
static_assert(sizeof(RigidMotion) == 1);

std::vector<float> dense(std::span<const DisplacementSet> sets, const Rig& rig) {
  std::vector<float> table;
  table.reserve(sets.size() * feature_point_count * 3);
  for (const DisplacementSet& set : sets) {
    const auto row = to_dense(on_face(set, rig.fapu, rig.points, rig.lip_gaps, rig.articulation).displacements);
    table.insert(table.end(), row.begin(), row.end());
  }
  return table;
}

}  // namespace

semblante_rig KernelRig::view() const {
  semblante_rig rig = fixed;
  rig.viseme = visemes.data();
  rig.expression = expressions.data();
  rig.companion = companions.data();
  rig.companion_count = static_cast<std::uint32_t>(companions.size());
  return rig;
}

KernelRig make_kernel_rig(const Rig& rig) {
  KernelRig result;
  result.visemes = dense(viseme_library(), rig);
  result.expressions = dense(expression_library(), rig);
  result.companions = to_kernel(companions_of(rig.points));
  for (std::size_t i = 0; i < fapu_unit_count; ++i) {
    result.fixed.fapu[i] = static_cast<float>(rig.fapu.value[i].value_or(0.0));
  }
  copy_vector(rig.left_eye_pivot, result.fixed.eye_pivot[0]);
  copy_vector(rig.right_eye_pivot, result.fixed.eye_pivot[1]);
  copy_vector(rig.head_pivot, result.fixed.head_pivot);
  set_moving_parts(rig.irises, rig.tongue, rig.lids, result.fixed);
  result.fixed.viseme_share = default_viseme_share;
  return result;
}

semblante_face make_kernel_face(const Rig& rig, const float* rest) {
  semblante_face face{};
  face.vertex_count = static_cast<std::uint32_t>(rig.influence.row_count());
  face.rest = rest;
  face.row_offsets = rig.influence.offsets.data();
  face.row_points = reinterpret_cast<const std::uint8_t*>(rig.influence.points.data());
  face.row_weights = rig.influence.weights.data();
  face.rigid =
      rig.rigid_of_vertex.empty() ? nullptr : reinterpret_cast<const std::uint8_t*>(rig.rigid_of_vertex.data());
  face.turn = rig.turn_of_vertex.empty() ? nullptr : rig.turn_of_vertex.data();
  return face;
}

}  // namespace semblante
