#pragma once

#include <map>
#include <string>

#include "deploy/sample_head/half_mesh.h"

namespace semblante::sample_head_detail {

/// The left upper lid: a part of its own that comes out from under the skin's fold, as a doll's lid does, with 3.1 at
/// the middle of its edge and 3.13 at its root above the ball.
///
/// Why not one surface with the skin: there 3.1 shares every vertex with four or five other points that Eq. 4 gives
/// nearly its own weight, so that 3.1 pulls a spike out of a lid that does not move. As a separate part with only 3.13,
/// it moves the whole edge: for P on the edge the angle at 3.1 between P and 3.13 is nearly right, d of Eq. 2 is long
/// and W close to 1. That needs the root well behind the edge, so that the angle stays under 90 degrees out to the
/// corners.
struct UpperLid {
  HalfMesh mesh;
  std::map<std::string, int, std::less<>> marks;
};
UpperLid make_upper_lid();

}  // namespace semblante::sample_head_detail
