#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace semblante::streams {

/// The payloads of the WebSocket messages that lie one after another in `wire`: RFC 6455 section 5.2, without masks.
inline std::vector<std::string> unframed(std::string_view wire) {
  std::vector<std::string> payloads;
  while (!wire.empty()) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(wire.at(i)); };
    EXPECT_TRUE(byte(0) == 0x81 || byte(0) == 0x82) << "a whole message in one frame";
    std::size_t header = 2;
    std::size_t size = byte(1);
    EXPECT_LT(size, 128U) << "a server does not mask";
    if (size >= 126) {
      const std::size_t bytes = size == 126 ? 2 : 8;
      size = 0;
      for (std::size_t i = 0; i < bytes; ++i) size = size << 8U | byte(2 + i);
      header += bytes;
    }
    if (wire.size() < header + size) {
      ADD_FAILURE() << "the last message is not whole";
      break;
    }
    payloads.emplace_back(wire.substr(header, size));
    wire.remove_prefix(header + size);
  }
  return payloads;
}

}  // namespace semblante::streams
