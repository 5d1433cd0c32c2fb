#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "core/kernel/semblante_kernel.h"

namespace semblante::testing {

/// A rig with zeroed displacement sets that a test fills in.
struct TestRig {
  std::vector<float> viseme = std::vector<float>(15 * 84 * 3);
  std::vector<float> expression = std::vector<float>(7 * 84 * 3);
  semblante_rig rig{};

  TestRig() {
    rig.viseme = viseme.data();
    rig.expression = expression.data();
    const float fapu[5] = {0.5F, 2.0F, 4.0F, 8.0F, 16.0F};  // IRISD ES ENS MNS MW: powers of two, exact products
    std::memcpy(rig.fapu, fapu, sizeof fapu);
    rig.viseme_share = 0.75F;  // not 0.85: the share is the rig's, and 0.75 is exact in binary
  }
  TestRig(const TestRig&) = delete;
  TestRig& operator=(const TestRig&) = delete;

  semblante_pose pose(const semblante_frame& frame) const {
    semblante_pose pose;
    std::memset(&pose, 0xFF, sizeof pose);  // NaN everywhere: evaluate must write all of it
    semblante_evaluate(&rig, &frame, &pose);
    return pose;
  }
};

inline float& component(std::vector<float>& table, int entry, int fp, int axis) {
  return table[static_cast<std::size_t>((entry * 84 + fp) * 3 + axis)];
}

inline constexpr float quarter_turn = 157079.63F;  // AU

/// FPs by dense index.
inline constexpr int jaw = 0, lower_lip = 2, chin = 9, upper_lid = 14, lower_lid = 16, fold = 26;

/// One vertex at (x, y, z) with no influencer; `rigid` is one of SEMBLANTE_RIGID_*.
inline std::vector<float> one_vertex(const TestRig& rig, const semblante_frame& frame, std::vector<float> at,
                                     std::uint8_t rigid = 0) {
  const std::uint32_t offsets[2] = {0, 0};
  const semblante_face face = {1, at.data(), offsets, nullptr, nullptr, &rigid, nullptr};
  const semblante_pose pose = rig.pose(frame);
  std::vector<float> out(3);
  semblante_deform(&face, &pose, out.data());
  return out;
}

inline void expect_near(const std::vector<float>& a, const std::vector<float>& b, float tolerance = 1e-6F) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

}  // namespace semblante::testing
