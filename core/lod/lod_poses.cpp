#include "core/lod/lod_poses.h"

#include "core/expressions/kernel_rig.h"
#include "core/expressions/library.h"

namespace semblante {

std::vector<LodPose> poses_in(const Rig& rig, const Model& model, std::span<const semblante_frame> frames) {
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  std::vector<LodPose> poses;
  if (model.positions.empty()) return poses;
  const KernelRig kernel = make_kernel_rig(rig);
  const semblante_rig view = kernel.view();
  const semblante_face face = make_kernel_face(rig, &model.positions[0].x);
  for (const semblante_frame& frame : frames) {
    semblante_pose pose{};
    semblante_evaluate(&view, &frame, &pose);
    LodPose& out = poses.emplace_back();
    out.positions.resize(model.positions.size());
    semblante_deform(&face, &pose, &out.positions[0].x);
  }
  return poses;
}

std::vector<LodPose> lod_poses(const Rig& rig, const Model& model) {
  std::vector<semblante_frame> frames;
  for (std::uint8_t expression = 1; expression < expression_library().size(); ++expression) {
    semblante_frame& frame = frames.emplace_back();
    frame.expression1 = expression;
    frame.intensity1 = SEMBLANTE_BLEND_MAX;
  }
  std::vector<LodPose> poses = poses_in(rig, model, frames);
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i].name = expression_library()[i + 1].name;
  return poses;
}

}  // namespace semblante
