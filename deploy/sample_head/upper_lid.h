#pragma once

#include <map>
#include <string>

#include "deploy/sample_head/half_mesh.h"

namespace semblante::sample_head_detail {

/// The left upper lid: a separate part that slides out from under the skin's fold, like the lid of a doll, with 3.1 at
/// the middle of its edge and 3.13 at its root above the eyeball.
///
/// It is not one surface with the skin, because there Eq. 4 gives four or five other points nearly the same weight as
/// 3.1 at every vertex, so that 3.1 pulls a spike out of a lid that does not move. On a separate part with only 3.13
/// beside it, 3.1 moves the whole edge: for P on the edge the angle at 3.1 between P and 3.13 is nearly 90 degrees, so
/// d of Eq. 2 is long and W close to 1. The root must be well behind the edge, so that the angle stays below 90 degrees
/// out to the corners.
struct UpperLid {
  HalfMesh mesh;
  std::map<std::string, int, std::less<>> marks;
};
UpperLid make_upper_lid(bool closed);

}  // namespace semblante::sample_head_detail
