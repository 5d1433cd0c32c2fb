#pragma once

#include <map>
#include <string>

#include "deploy/sample_head/half_mesh.h"

namespace semblante::sample_head_detail {

/// A separate part of the mouth as a half mesh, with the FPs on it.
struct MouthPart {
  HalfMesh mesh;
  std::map<std::string, int, std::less<>> marks;
};

MouthPart make_upper_teeth();
MouthPart make_lower_teeth();
MouthPart make_tongue();

}  // namespace semblante::sample_head_detail
