#include "protocol/cpp/rig_kernel.h"

#include "core/expressions/companions.h"
#include "core/expressions/kernel_parts.h"

namespace semblante {
namespace {

template <std::size_t N>
std::vector<float> dense(const std::array<RigDocument::DisplacementSet, N>& sets) {
  constexpr std::size_t row = std::size_t{SEMBLANTE_FP_COUNT} * 3;
  std::vector<float> values(N * row);
  for (std::size_t s = 0; s < N; ++s) {
    for (const RigDocument::Displacement& displacement : sets[s].displacements) {
      float* to = &values[s * row + std::size_t{displacement.id.value()} * 3];
      to[0] = displacement.by.x;
      to[1] = displacement.by.y;
      to[2] = displacement.by.z;
    }
  }
  return values;
}

}  // namespace

KernelRig to_kernel_rig(const RigDocument& document) {
  KernelRig rig;
  rig.visemes = dense(document.visemes);
  rig.expressions = dense(document.expressions);
  rig.companions = to_kernel(document.companions);
  for (std::size_t unit = 0; unit < SEMBLANTE_FAPU_COUNT; ++unit) {
    rig.fixed.fapu[unit] = static_cast<float>(document.fapu.value[unit].value_or(0.0));
  }
  copy_vector(document.eye_pivots[0], rig.fixed.eye_pivot[0]);
  copy_vector(document.eye_pivots[1], rig.fixed.eye_pivot[1]);
  copy_vector(document.head_pivot, rig.fixed.head_pivot);
  set_moving_parts(document.irises, document.tongue, document.lids, rig.fixed);
  rig.fixed.viseme_share = static_cast<float>(document.viseme_share);
  return rig;
}

}  // namespace semblante
