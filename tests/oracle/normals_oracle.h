#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tests/oracle/kernel_oracle.h"

namespace semblante::oracle {

/// Unit normals of `positions` in double, one a vertex: `rest_normals` (#V by 3), turned by the smallest rotation that
/// carries the normals of the triangles at rest to those of the triangles now. In these every corner adds its
/// triangle's normal by Max's weight sin(angle) / (|edge| |edge|), vertices with equal `rest` and equal `rest_normals`
/// share one, and it is +Z where there is none. A zero rest normal means that of the triangles.
std::vector<Vec3> normals(const std::vector<Vec3>& positions,
                          const std::vector<std::array<std::uint32_t, 3>>& triangles, const std::vector<float>& rest,
                          const std::vector<float>& rest_normals);

}  // namespace semblante::oracle
