// Packets of capture programs are read in time in proportion to their bytes, up to the largest that UDP carries.

#include "tests/support/growth.h"

#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "clients/gateways/livelink/receiver.h"
#include "clients/gateways/osc/packet.h"
#include "clients/gateways/vmc/receiver.h"

namespace semblante {
namespace {

using Bytes = std::vector<std::uint8_t>;

void put_text(Bytes& bytes, const std::string& text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
  do bytes.push_back(0);
  while (bytes.size() % 4 != 0);
}

void put_u32(Bytes& bytes, std::size_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

/// A bundle of elements, each with its size before it.
Bytes bundle(std::size_t n, const Bytes& element) {
  Bytes bytes;
  put_text(bytes, "#bundle");
  bytes.resize(16);
  for (std::size_t i = 0; i < n && bytes.size() + 4 + element.size() <= osc::max_packet_bytes; ++i) {
    put_u32(bytes, element.size());
    bytes.insert(bytes.end(), element.begin(), element.end());
  }
  return bytes;
}

void expect_linear_packets(const std::string& what, std::size_t most, const std::function<Bytes(std::size_t)>& make) {
  // Read a hundred times: one packet is too small to be measured.
  test::expect_linear(what, {.from = most / 512 + 1, .most = most}, make, [](const Bytes& packet) {
    for (int i = 0; i < 100; ++i) {
      (void)osc::read_packet(packet);
      vmc::Receiver receiver;
      (void)receiver.take(packet, 0.0);
      livelink::Receiver live_link("");
      (void)live_link.take(packet, 0.0);
    }
  });
}

TEST(GatewaysGrowth, Packets) {
  Bytes blend;
  put_text(blend, "/VMC/Ext/Blend/Val");
  put_text(blend, ",sf");
  put_text(blend, "JawOpen");
  put_u32(blend, 0x3F000000);
  expect_linear_packets("blend values", osc::max_packet_bytes / (blend.size() + 4),
                        [&](std::size_t n) { return bundle(n, blend); });
  Bytes address;
  put_text(address, "/a");
  expect_linear_packets("messages without values", osc::max_packet_bytes / 8,
                        [&](std::size_t n) { return bundle(n, address); });
  expect_linear_packets("empty bundles", osc::max_packet_bytes / 20,
                        [&](std::size_t n) { return bundle(n, bundle(0, {})); });
  for (const char fill : {'[', 'T', 'a', '/'}) {
    expect_linear_packets(std::string("tags ") + fill, osc::max_packet_bytes - 16, [&](std::size_t n) {
      Bytes bytes;
      put_text(bytes, "/a");
      put_text(bytes, "," + std::string(n, fill));
      return bytes;
    });
  }
  expect_linear_packets("an address", osc::max_packet_bytes - 16, [](std::size_t n) {
    Bytes bytes;
    put_text(bytes, "/" + std::string(n, 'a'));
    put_text(bytes, ",");
    return bytes;
  });
  expect_linear_packets("zeros", osc::max_packet_bytes, [](std::size_t n) { return Bytes(n); });
  expect_linear_packets("sixes", osc::max_packet_bytes, [](std::size_t n) { return Bytes(n, 6); });
}

}  // namespace
}  // namespace semblante
