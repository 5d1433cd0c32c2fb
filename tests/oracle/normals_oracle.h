#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tests/oracle/kernel_oracle.h"

namespace semblante::oracle {

/// Unit normals of `positions` in double, one a vertex: every corner adds its triangle's normal by Max's weight
/// sin(angle) / (|edge| |edge|). Vertices with equal `rest` and equal `rest_normals` (#V by 3) share one. +Z where
/// there is none.
std::vector<Vec3> normals(const std::vector<Vec3>& positions,
                          const std::vector<std::array<std::uint32_t, 3>>& triangles, const std::vector<float>& rest,
                          const std::vector<float>& rest_normals);

}  // namespace semblante::oracle
