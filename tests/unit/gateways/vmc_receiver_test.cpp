#include <cmath>

#include "clients/gateways/vmc/receiver.h"
#include "clients/gateways/vmc/vrm_blends.h"
#include "core/bridges/head_turn.h"
#include "core/tables/mpeg4.h"
#include "tests/unit/gateways/golden_packets.h"

namespace semblante::vmc {
namespace {

using testing::Bytes;
using testing::from_hex;
using testing::golden;

constexpr double units_of_degree = 3.14159265358979323846 / 180.0 * 1e5;

/// The face that the golden file describes, by core/bridges and the meaning of FAPs 23 to 26 and 48 to 50.
semblante_frame expected_frame(const nlohmann::json& face) {
  ArkitCoefficients coefficients{};
  const auto named = face.value("coefficients", nlohmann::json::object());
  for (const auto& [name, value] : named.items()) {
    coefficients[find_arkit(name).value()] = value;
  }
  semblante_frame frame = frame_from_arkit(coefficients)->frame;
  if (face.contains("viseme")) {
    frame.viseme1 = face["viseme"][0];
    frame.viseme2 = face["viseme"][1];
    frame.viseme_blend = face["viseme"][2];
  }
  if (face.contains("expression")) {
    frame.expression1 = face["expression"][0];
    frame.intensity1 = face["expression"][1];
    frame.expression2 = face["expression"][2];
    frame.intensity2 = face["expression"][3];
  }
  const auto turn = [&](std::size_t fap, double degrees) {
    frame.fap[fap] = static_cast<float>(degrees * units_of_degree);
  };
  if (face.contains("head")) {
    turn(48, face["head"]["down"]);
    turn(49, face["head"]["left"]);
    turn(50, face["head"]["right_shoulder"]);
  }
  if (face.contains("eyes")) {
    turn(23, face["eyes"]["left"]["left"]);
    turn(25, face["eyes"]["left"]["down"]);
    turn(24, face["eyes"]["right"]["left"]);
    turn(26, face["eyes"]["right"]["down"]);
  }
  return frame;
}

void expect_same(const semblante_frame& frame, const semblante_frame& expected) {
  EXPECT_EQ(frame.viseme1, expected.viseme1);
  EXPECT_EQ(frame.viseme2, expected.viseme2);
  EXPECT_EQ(frame.viseme_blend, expected.viseme_blend);
  EXPECT_EQ(frame.expression1, expected.expression1);
  EXPECT_EQ(frame.intensity1, expected.intensity1);
  EXPECT_EQ(frame.expression2, expected.expression2);
  EXPECT_EQ(frame.intensity2, expected.intensity2);
  for (std::size_t n = 3; n <= SEMBLANTE_FAP_COUNT; ++n) EXPECT_NEAR(frame.fap[n], expected.fap[n], 0.05F) << n;
}

TEST(VmcReceiver, GoldenSequences_FinishTheFacesTheySay) {
  const auto file = golden("vmc.json");
  ASSERT_GE(file["sequences"].size(), 15U);
  for (const auto& sequence : file["sequences"]) {
    SCOPED_TRACE(sequence["name"].get<std::string>());
    Receiver receiver;
    std::size_t next = 0;
    for (std::size_t p = 0; p < sequence["packets"].size(); ++p) {
      const auto& packet = sequence["packets"][p];
      const auto taken = receiver.take(from_hex(packet["hex"]), packet["at"]);
      ASSERT_TRUE(taken) << taken.error().message;
      const bool due = next < sequence["faces"].size() && sequence["faces"][next]["packet"] == p;
      ASSERT_EQ(taken->has_value(), due) << "packet " << p;
      if (!due) continue;
      const auto& face = sequence["faces"][next++];
      expect_same((*taken)->frame, expected_frame(face));
      EXPECT_EQ((*taken)->time.has_value(), face.contains("time"));
      if (face.contains("time")) {
        EXPECT_EQ((*taken)->time.value_or(0.0), face["time"].get<double>());
      }
      EXPECT_EQ((*taken)->clamped, face.value("clamped", std::size_t{0}));
      EXPECT_EQ(receiver.skipped(), face.value("skipped", std::uint64_t{0}));
    }
    EXPECT_EQ(next, sequence["faces"].size());
  }
}

TEST(VmcReceiver, EveryPrefixAndFlippedByte_LeavesFacesWithinTheirRanges) {
  const auto file = golden("vmc.json");
  ASSERT_GE(file["sequences"].size(), 5U);
  for (const auto& sequence : file["sequences"]) {
    for (const auto& packet : sequence["packets"]) {
      const Bytes whole = from_hex(packet["hex"]);
      Receiver receiver;
      double arrival = 0.0;
      testing::for_each_damage(whole, [&](std::span<const std::uint8_t> bytes) {
        const auto taken = receiver.take(bytes, arrival += 0.01);
        if (!taken || !*taken) return;
        for (std::size_t n = 3; n <= SEMBLANTE_FAP_COUNT; ++n) {
          const mpeg4::Fap& fap = mpeg4::fap(n);
          const float value = (*taken)->frame.fap[n];
          ASSERT_TRUE(value >= static_cast<float>(fap.min()) && value <= static_cast<float>(fap.max())) << n;
        }
        ASSERT_LE((*taken)->frame.viseme1, 14);
        ASSERT_LE((*taken)->frame.expression1, 6);
        ASSERT_LE((*taken)->frame.intensity1, 63);
      });
    }
  }
}

TEST(VrmBlends, EveryPreset_SaysOneThingAtMostAndIsFoundByBothNames) {
  const auto& presets = vrm_presets();
  EXPECT_EQ(presets.size(), 18U);
  for (std::size_t i = 0; i < presets.size(); ++i) {
    EXPECT_EQ(find_vrm_preset(presets[i].vrm0), i);
    EXPECT_EQ(find_vrm_preset(presets[i].vrm1), i);
    const int says = (presets[i].arkit.empty() ? 0 : 1) + (presets[i].viseme ? 1 : 0) + (presets[i].expression ? 1 : 0);
    EXPECT_LE(says, 1) << presets[i].vrm0;
    EXPECT_FALSE(find_perfect_sync(presets[i].vrm0) || find_perfect_sync(presets[i].vrm1)) << presets[i].vrm0;
  }
  EXPECT_EQ(find_vrm_preset("bLiNk_l"), find_vrm_preset("BLINKLEFT"));
  EXPECT_FALSE(find_vrm_preset("blink_"));
  EXPECT_FALSE(find_vrm_preset(""));
  EXPECT_EQ(find_perfect_sync("JAWOPEN"), find_arkit("jawOpen"));
}

TEST(VrmBlends, EveryViseme_ShowsNoMoreThanAWholeMouth) {
  for (std::size_t v = 0; v < oculus_count; ++v) {
    float sum = 0.0F;
    for (const VrmPreset& preset : vrm_presets()) sum += preset.shown[v];
    EXPECT_LE(sum, 1.0F) << oculus_name(v);
  }
  for (const VrmPreset& preset : vrm_presets()) {
    if (preset.viseme) {
      EXPECT_EQ(preset.shown[*preset.viseme], 1.0F) << preset.vrm0;
    }
  }
}

}  // namespace
}  // namespace semblante::vmc
