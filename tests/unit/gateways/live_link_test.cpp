#include <cmath>

#include "clients/gateways/livelink/packet.h"
#include "clients/gateways/livelink/receiver.h"
#include "core/bridges/head_turn.h"
#include "tests/unit/gateways/golden_packets.h"

namespace semblante::livelink {
namespace {

using testing::Bytes;
using testing::from_hex;
using testing::golden;

Bytes golden_packet(const std::string& name) {
  const auto file = golden("live_link.json");
  for (const auto& entry : file["packets"]) {
    if (entry["name"] == name) return from_hex(entry["hex"]);
  }
  ADD_FAILURE() << name;
  return {};
}

/// The same packet from a device of another subject name, of one letter.
Bytes from_subject(char letter, const Bytes& packet) {
  constexpr std::size_t at = 1 + 4 + 36;  // of the name's length
  constexpr std::size_t name_bytes = 6;   // "iPhone"
  Bytes other;
  for (std::size_t i = 0; i < packet.size(); ++i) {
    if (i < at || i >= at + 4 + name_bytes) {
      other.push_back(packet[i]);
    } else if (i < at + 5) {
      other.push_back(i == at + 3   ? std::uint8_t{1}
                      : i == at + 4 ? static_cast<std::uint8_t>(letter)
                                    : std::uint8_t{0});
    }
  }
  return other;
}

TEST(LiveLinkPacket, GoldenPackets_AreRead) {
  const auto file = golden("live_link.json");
  ASSERT_GE(file["packets"].size(), 5U);
  for (const auto& entry : file["packets"]) {
    SCOPED_TRACE(entry["name"].get<std::string>());
    const auto packet = read_packet(from_hex(entry["hex"]));
    ASSERT_TRUE(packet) << packet.error().where << ": " << packet.error().message;
    EXPECT_EQ(packet->device, entry["device"].get<std::string>());
    EXPECT_EQ(packet->subject, entry["subject"].get<std::string>());
    ASSERT_EQ(packet->seconds.has_value(), entry.contains("seconds"));
    if (packet->seconds) {
      EXPECT_NEAR(*packet->seconds, entry["seconds"].get<double>(), 1e-9);
      EXPECT_NEAR(packet->rate, entry["rate"].get<double>(), 1e-9);
    }
    ASSERT_EQ(packet->face.has_value(), entry.contains("values"));
    if (!packet->face) continue;
    for (std::size_t i = 0; i < arkit_count; ++i) {
      EXPECT_EQ(packet->face->coefficients[i], entry["values"][i].get<float>()) << arkit_name(i);
    }
    EXPECT_EQ(packet->face->head.yaw, entry["values"][52].get<float>());
    EXPECT_EQ(packet->face->head.pitch, entry["values"][53].get<float>());
    EXPECT_EQ(packet->face->head.roll, entry["values"][54].get<float>());
  }
}

TEST(LiveLinkPacket, GoldenFaults_AreRefused) {
  const auto file = golden("live_link.json");
  ASSERT_GE(file["refused"].size(), 10U);
  for (const auto& entry : file["refused"]) {
    SCOPED_TRACE(entry["name"].get<std::string>());
    const auto packet = read_packet(from_hex(entry["hex"]));
    ASSERT_FALSE(packet);
    EXPECT_EQ(testing::name_of(packet.error().code), entry["code"].get<std::string>()) << packet.error().message;
    EXPECT_TRUE(packet.error().where.starts_with("byte ")) << packet.error().where;
  }
}

TEST(LiveLinkPacket, EveryPrefixAndFlippedByte_IsReadOrRefused) {
  const auto file = golden("live_link.json");
  ASSERT_GE(file["packets"].size(), 5U);
  for (const auto& entry : file["packets"]) {
    testing::for_each_damage(from_hex(entry["hex"]), [](std::span<const std::uint8_t> bytes) {
      const auto packet = read_packet(bytes);
      if (!packet || !packet->face) return;
      for (const float value : packet->face->coefficients) ASSERT_TRUE(std::isfinite(value));
      ASSERT_TRUE(packet->seconds && std::isfinite(*packet->seconds));
    });
  }
}

TEST(LiveLinkReceiver, AFace_IsThatOfTheBridgeWithTheHeadTurned) {
  Receiver receiver("");
  const auto taken = receiver.take(golden_packet("a face, 61 values"), 1.0);
  ASSERT_TRUE(taken && *taken);
  ArkitCoefficients coefficients{};
  for (std::size_t i = 0; i < arkit_count; ++i) coefficients[i] = static_cast<float>(std::round(i) * 0.01);
  semblante_frame expected = frame_from_arkit(coefficients)->frame;
  turn_head(expected, {0.25F, -0.5F, 0.125F});
  for (std::size_t n = 3; n <= SEMBLANTE_FAP_COUNT; ++n) EXPECT_NEAR((*taken)->frame.fap[n], expected.fap[n], 0.01F);
  EXPECT_NEAR((*taken)->frame.fap[49], -25000.0F, 0.1F) << "yaw to the face's right is negative in FAP 49";
  EXPECT_NEAR((*taken)->seconds.value(), 1234.25 / 60, 1e-9);
}

TEST(LiveLinkReceiver, SeveralDevices_TheFirstThatSendsAFaceIsFollowedUntilItFallsSilent) {
  const Bytes face = golden_packet("a face, 61 values");
  const Bytes faceless = golden_packet("no face: a count of 0");
  Receiver receiver("");
  EXPECT_FALSE(receiver.take(from_subject('a', faceless), 0.0)->has_value()) << "sees nothing: not followed";
  EXPECT_TRUE(receiver.take(from_subject('b', face), 0.1)->has_value());
  EXPECT_FALSE(receiver.take(from_subject('a', face), 0.2)->has_value());
  EXPECT_EQ(receiver.others(), 1U);
  EXPECT_FALSE(receiver.take(from_subject('b', faceless), 4.0)->has_value()) << "keeps its place without a face";
  EXPECT_FALSE(receiver.take(from_subject('a', face), 6.0)->has_value());
  EXPECT_TRUE(receiver.take(from_subject('a', face), 9.1)->has_value());
  EXPECT_EQ(receiver.others(), 2U);
  EXPECT_EQ(receiver.faceless(), 2U);
}

TEST(LiveLinkReceiver, ASubjectThatIsNamed_IsTheOnlyOneFollowed) {
  const Bytes face = golden_packet("a face, 61 values");
  Receiver receiver("b");
  EXPECT_FALSE(receiver.take(from_subject('a', face), 0.0)->has_value());
  EXPECT_FALSE(receiver.take(face, 0.0)->has_value());
  EXPECT_TRUE(receiver.take(from_subject('b', face), 0.1)->has_value());
  EXPECT_EQ(receiver.others(), 2U);
}

}  // namespace
}  // namespace semblante::livelink
