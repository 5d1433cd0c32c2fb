// From a pose to vertices: sums of rows by hand, random faces against the literal oracle.
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/kernel/semblante_kernel.h"
#include "tests/oracle/kernel_oracle.h"
#include "tests/unit/kernel/kernel_rig.h"
#include "tests/unit/kernel/random_case.h"

namespace semblante::testing {
namespace {

TEST(Kernel_Eq7, SumsTheRow) {
  TestRig rig;
  const float rest[] = {0, 0, 0, 1, 1, 1};
  const std::uint32_t offsets[] = {0, 2, 2};
  const std::uint8_t points[] = {0, 5};
  const float weights[] = {0.25F, 0.75F};
  const semblante_face face = {2, rest, offsets, points, weights, nullptr, nullptr};
  semblante_pose pose = rig.pose({});
  pose.fp[1] = -8.0F;     // FP 0: (0, -8, 0)
  pose.fp[5 * 3] = 4.0F;  // FP 5: (4, 0, 0)
  float out[6];
  semblante_deform(&face, &pose, out);
  expect_near({out[0], out[1], out[2]}, {3, -2, 0}, 0.0F);  // .25 * (0,-8,0) + .75 * (4,0,0)
  expect_near({out[3], out[4], out[5]}, {1, 1, 1}, 0.0F);   // an empty row stays
}

TEST(Kernel_Oracle, AgreesOnRandomFacesAndFrames) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    RandomCase test(seed);
    for (int i = 0; i < 5; ++i) {
      const semblante_frame frame = test.frame();
      const semblante_pose pose = test.rig.pose(frame);
      std::vector<float> positions(test.rest.size());
      semblante_deform(&test.face, &pose, positions.data());
      const oracle::Pose literal = oracle::evaluate(test.rig.rig, frame);
      for (std::size_t fp = 0; fp < 84; ++fp) {
        for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(pose.fp[fp * 3 + k], literal.fp[fp][k], 1e-6) << seed;
      }
      const auto expected = oracle::deform(test.face, test.rig.rig, literal);
      for (std::size_t v = 0; v < expected.size(); ++v) {
        for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(positions[v * 3 + k], expected[v][k], 1e-5) << seed << " " << v;
      }
    }
  }
}

TEST(Kernel_Deform, GivesTheRestPositionsExactly_ForTheNeutralPose) {
  RandomCase test(7);
  const semblante_pose pose = test.rig.pose({});
  std::vector<float> positions(test.rest.size());
  semblante_deform(&test.face, &pose, positions.data());
  EXPECT_EQ(positions, test.rest);
}

}  // namespace
}  // namespace semblante::testing
