#include <bit>

#include "clients/gateways/osc/bundle_writer.h"
#include "clients/gateways/osc/packet.h"
#include "tests/unit/gateways/golden_packets.h"

namespace semblante::osc {
namespace {

using testing::Bytes;
using testing::from_hex;
using testing::golden;

/// An argument as the golden file has it.
Argument argument_of(const nlohmann::json& pair, Bytes& storage) {
  const char tag = pair[0].get<std::string>()[0];
  const auto& value = pair[1];
  if (tag == 'i' || tag == 'c' || tag == 'r') return value.get<std::int32_t>();
  if (tag == 'f') return value.get<float>();
  if (tag == 's' || tag == 'S') return std::string_view(value.get_ref<const std::string&>());
  if (tag == 'h') return value.get<std::int64_t>();
  if (tag == 'd') return value.get<double>();
  if (tag == 't') return TimeTag{value.get<std::uint64_t>()};
  if (tag == 'T' || tag == 'F') return tag == 'T';
  if (tag != 'b') return Nothing{};
  storage = from_hex(value.get<std::string>());
  return Blob(storage);
}

void expect_same(const Argument& read, const Argument& expected) {
  ASSERT_EQ(read.index(), expected.index());
  if (const auto* blob = std::get_if<Blob>(&read)) {
    const auto& other = std::get<Blob>(expected);
    EXPECT_TRUE(std::equal(blob->begin(), blob->end(), other.begin(), other.end()));
    return;
  }
  std::visit(
      [&expected](const auto& value) {
        using T = std::decay_t<decltype(value)>;
        if constexpr (!std::is_same_v<T, Blob>) {
          EXPECT_EQ(value, std::get<T>(expected));
        }
      },
      read);
}

TEST(OscPacket, GoldenPackets_AreRead) {
  const auto file = golden("osc.json");
  ASSERT_GE(file["packets"].size(), 10U);
  for (const auto& entry : file["packets"]) {
    SCOPED_TRACE(entry["name"].get<std::string>());
    const Bytes bytes = from_hex(entry["hex"]);
    const auto packet = read_packet(bytes);
    ASSERT_TRUE(packet) << packet.error().where << ": " << packet.error().message;
    EXPECT_EQ(packet->is_bundle, entry["bundle"].get<bool>());
    ASSERT_EQ(packet->messages.size(), entry["messages"].size());
    for (std::size_t m = 0; m < packet->messages.size(); ++m) {
      const auto& expected = entry["messages"][m];
      EXPECT_EQ(packet->messages[m].address, expected["address"].get<std::string>());
      ASSERT_EQ(packet->messages[m].arguments.size(), expected["arguments"].size());
      for (std::size_t a = 0; a < packet->messages[m].arguments.size(); ++a) {
        Bytes storage;
        expect_same(packet->messages[m].arguments[a], argument_of(expected["arguments"][a], storage));
      }
    }
  }
}

TEST(OscPacket, GoldenFaults_AreRefused) {
  const auto file = golden("osc.json");
  ASSERT_GE(file["refused"].size(), 10U);
  for (const auto& entry : file["refused"]) {
    SCOPED_TRACE(entry["name"].get<std::string>());
    const auto packet = read_packet(from_hex(entry["hex"]));
    ASSERT_FALSE(packet);
    EXPECT_EQ(testing::name_of(packet.error().code), entry["code"].get<std::string>()) << packet.error().message;
    EXPECT_TRUE(packet.error().where.starts_with("byte ")) << packet.error().where;
  }
}

TEST(OscPacket, EveryPrefixAndFlippedByte_IsReadWithinItsBoundsOrRefused) {
  const auto file = golden("osc.json");
  ASSERT_GE(file["packets"].size(), 5U);
  for (const auto& entry : file["packets"]) {
    const Bytes whole = from_hex(entry["hex"]);
    testing::for_each_damage(whole, [](std::span<const std::uint8_t> bytes) {
      const auto packet = read_packet(bytes);
      if (!packet) return;
      for (const Message& message : packet->messages) {
        EXPECT_TRUE(message.address.starts_with('/'));
        const auto* begin = reinterpret_cast<const char*>(bytes.data());
        EXPECT_TRUE(message.address.data() >= begin && message.address.data() < begin + bytes.size());
        EXPECT_LE(message.arguments.size(), max_arguments);
      }
    });
  }
}

TEST(OscPacket, MoreThanUdpCarries_IsRefused) {
  const Bytes bytes(max_packet_bytes + 1, 0);
  const auto packet = read_packet(bytes);
  ASSERT_FALSE(packet);
  EXPECT_EQ(packet.error().code, ErrorCode::too_large);
}

TEST(BundleWriter, OneMessage_HasTheBytesOfTheSpecification) {
  BundleWriter writer(1472);
  writer.add("/foo", {std::int32_t{1000}, std::int32_t{-1}, std::string_view("hello"), 1.234F, 5.678F});
  const auto bundles = writer.finish();
  ASSERT_EQ(bundles.size(), 1U);
  const Bytes expected = from_hex(
      "2362756e646c6500"  // #bundle
      "0000000000000001"  // at once
      "00000028"          // 40 bytes: the specification's second example
      "2f666f6f00000000"
      "2c69697366660000"
      "000003e8ffffffff"
      "68656c6c6f000000"
      "3f9df3b640b5b22d");
  EXPECT_EQ(bundles[0], expected);
  EXPECT_TRUE(writer.finish().empty());
}

TEST(BundleWriter, WhatDoesNotFitOneBundle_GoesOnInTheNext) {
  BundleWriter writer(100);
  std::vector<std::string> names;
  for (int i = 0; i < 30; ++i) names.push_back(std::string(static_cast<std::size_t>(i), 'x'));
  for (std::size_t i = 0; i < names.size(); ++i) writer.add("/v", {std::string_view(names[i]), static_cast<float>(i)});
  const auto bundles = writer.finish();
  EXPECT_GT(bundles.size(), 5U);
  std::size_t next = 0;
  for (const Bytes& bundle : bundles) {
    EXPECT_LE(bundle.size(), 100U);
    const auto packet = read_packet(bundle);
    ASSERT_TRUE(packet) << packet.error().message;
    EXPECT_TRUE(packet->is_bundle);
    ASSERT_FALSE(packet->messages.empty());
    for (const Message& message : packet->messages) {
      EXPECT_EQ(std::get<std::string_view>(message.arguments[0]), names[next]);
      EXPECT_EQ(std::get<float>(message.arguments[1]), static_cast<float>(next));
      ++next;
    }
  }
  EXPECT_EQ(next, names.size());
}

}  // namespace
}  // namespace semblante::osc
