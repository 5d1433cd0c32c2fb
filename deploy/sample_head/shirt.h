#pragma once

#include "deploy/sample_head/half_mesh.h"

namespace semblante::sample_head_detail {

/// The edge of the skin at the base of the neck, by azimuth 0 (front) .. pi (back): on the sculpt, lower in front.
Vec3 neckline(double azimuth);

/// A shirt over shoulders and chest, from a round collar just above the neckline down to a hem.
HalfMesh make_shirt();

}  // namespace semblante::sample_head_detail
