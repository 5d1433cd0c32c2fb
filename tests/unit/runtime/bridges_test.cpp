#include <array>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "clients/runtime/semblante.h"

namespace semblante::testing {
namespace {

constexpr std::size_t jaw_open = 17;

TEST(SdkBridges, Arkit_InAndOut) {
  std::array<float, 52> coefficients{};
  coefficients[jaw_open] = 0.5F;
  semblante_frame frame{};
  ASSERT_EQ(semblante_frame_from_arkit(coefficients.data(), &frame, nullptr), SEMBLANTE_OK);
  EXPECT_GT(frame.fap[3], 200.0F);
  std::array<float, 52> back{};
  ASSERT_EQ(semblante_arkit_from_frame(&frame, back.data()), SEMBLANTE_OK);
  EXPECT_NEAR(back[jaw_open], 0.5F, 0.1F);
}

TEST(SdkBridges, Oculus_InAndOut) {
  std::array<float, 15> weights{};
  weights[10] = 1.0F;
  semblante_frame frame{};
  ASSERT_EQ(semblante_frame_from_oculus(weights.data(), &frame, nullptr), SEMBLANTE_OK);
  EXPECT_EQ(frame.viseme1, 10);
  EXPECT_EQ(frame.viseme_blend, 63);
  std::array<float, 15> back{};
  ASSERT_EQ(semblante_oculus_from_frame(&frame, back.data()), SEMBLANTE_OK);
  EXPECT_NEAR(back[10], 1.0F, 1e-5F);
}

TEST(SdkBridges, BadInput_IsRefusedByName) {
  std::array<float, 52> coefficients{};
  coefficients[jaw_open] = std::numeric_limits<float>::quiet_NaN();
  semblante_frame frame{};
  semblante_error error{};
  EXPECT_EQ(semblante_frame_from_arkit(coefficients.data(), &frame, &error), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(std::string(error.where), "jawOpen");
  EXPECT_EQ(semblante_frame_from_arkit(nullptr, &frame, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_frame_from_arkit(nullptr, &frame, &error), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(std::string(error.where), "coefficients");
  EXPECT_EQ(semblante_frame_from_oculus(nullptr, &frame, &error), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(std::string(error.where), "weights");
  EXPECT_EQ(semblante_frame_from_arkit(coefficients.data(), nullptr, &error), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(std::string(error.where), "frame");
  EXPECT_EQ(semblante_frame_from_oculus(nullptr, &frame, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_arkit_from_frame(&frame, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  frame.fap[3] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(semblante_arkit_from_frame(&frame, coefficients.data()), SEMBLANTE_INVALID_ARGUMENT);
}

}  // namespace
}  // namespace semblante::testing
