#pragma once

#include <vector>

#include "core/lod/decimate.h"

namespace semblante {

/// The six expressions at full intensity: the faces in which the error of a level counts and is reported.
std::vector<LodPose> lod_poses(const Rig& rig, const Model& model);

}  // namespace semblante
