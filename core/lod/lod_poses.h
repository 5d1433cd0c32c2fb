#pragma once

#include <span>
#include <vector>

#include "core/kernel/semblante_kernel.h"
#include "core/lod/decimate.h"

namespace semblante {

/// The model in each of `frames`; without names.
std::vector<LodPose> poses_in(const Rig& rig, const Model& model, std::span<const semblante_frame> frames);

/// The six expressions at full intensity: the poses in which the error of a level counts and is reported.
std::vector<LodPose> lod_poses(const Rig& rig, const Model& model);

}  // namespace semblante
