#include "core/lod/lod_poses.h"

#include "core/expressions/kernel_rig.h"
#include "core/expressions/library.h"

namespace semblante {

std::vector<LodPose> lod_poses(const Rig& rig, const Model& model) {
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  std::vector<LodPose> poses;
  if (model.positions.empty()) return poses;
  const KernelRig kernel = make_kernel_rig(rig);
  const semblante_rig view = kernel.view();
  const semblante_face face = make_kernel_face(rig, &model.positions[0].x);
  for (std::uint8_t expression = 1; expression < expression_library().size(); ++expression) {
    semblante_frame frame{};
    frame.expression1 = expression;
    frame.intensity1 = SEMBLANTE_BLEND_MAX;
    semblante_pose pose{};
    semblante_evaluate(&view, &frame, &pose);
    LodPose& out = poses.emplace_back();
    out.name = expression_library()[expression].name;
    out.positions.resize(model.positions.size());
    semblante_deform(&face, &pose, &out.positions[0].x);
  }
  return poses;
}

}  // namespace semblante
