// The golden vectors.

#include <cmath>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/bridges/arkit.h"
#include "core/bridges/oculus.h"

namespace semblante {
namespace {

nlohmann::json vectors() {
  std::ifstream file(std::string(SEMBLANTE_SOURCE_DIR) + "/protocol/vectors/bridges/bridges.json");
  EXPECT_TRUE(file);
  return nlohmann::json::parse(file);
}

TEST(BridgeVectors, Arkit_InMakesTheFaps) {
  const auto all = vectors();
  ASSERT_GE(all.at("in").size(), 20U);
  for (const auto& each : all.at("in")) {
    ArkitCoefficients c{};
    for (const auto& [name, value] : each.at("coefficients").items()) c.at(find_arkit(name).value()) = value;
    const semblante_frame frame = frame_from_arkit(c).value().frame;
    for (int n = 3; n <= SEMBLANTE_FAP_COUNT; ++n) {
      const auto found = each.at("faps").find(std::to_string(n));
      if (found == each.at("faps").end()) {
        EXPECT_LE(std::abs(frame.fap[n]), 4.0F) << n;
      } else {
        EXPECT_NEAR(frame.fap[n] / found->get<float>(), 1.0F, 1e-5F) << n;
      }
    }
  }
}

TEST(BridgeVectors, Arkit_OutReadsTheFace) {
  const auto all = vectors();
  ASSERT_GE(all.at("out").size(), 20U);
  for (const auto& each : all.at("out")) {
    semblante_frame frame{};
    for (const auto& [number, value] : each.at("faps").items()) frame.fap[std::stoi(number)] = value;
    const ArkitCoefficients c = arkit_from_frame(frame);
    for (std::size_t s = 0; s < arkit_count; ++s) {
      EXPECT_NEAR(c[s], each.at("coefficients").value(std::string(arkit_name(s)), 0.0F), 6e-4F) << arkit_name(s);
    }
  }
}

TEST(BridgeVectors, Oculus_InMakesFap1) {
  const auto all = vectors();
  for (const auto& each : all.at("oculus")) {
    const auto weights = each.at("weights").get<OculusWeights>();
    const semblante_frame frame = frame_from_oculus(weights).value().frame;
    EXPECT_EQ(frame.viseme1, each.at("viseme").at("select1").get<int>());
    EXPECT_EQ(frame.viseme2, each.at("viseme").at("select2").get<int>());
    EXPECT_EQ(frame.viseme_blend, each.at("viseme").at("blend").get<int>());
  }
}

}  // namespace
}  // namespace semblante
