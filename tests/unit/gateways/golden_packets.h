#pragma once

#include <cstdint>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/types/result.h"

namespace semblante::testing {

using Bytes = std::vector<std::uint8_t>;

/// A file of protocol/vectors/gateways.
inline nlohmann::json golden(const std::string& file) {
  std::ifstream stream(std::string(SEMBLANTE_SOURCE_DIR) + "/protocol/vectors/gateways/" + file);
  EXPECT_TRUE(stream) << file;
  return nlohmann::json::parse(stream);
}

inline Bytes from_hex(const std::string& hex) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

inline std::string name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::truncated:
      return "truncated";
    case ErrorCode::malformed:
      return "malformed";
    case ErrorCode::too_large:
      return "too_large";
    case ErrorCode::unsupported:
      return "unsupported";
    case ErrorCode::out_of_range:
      return "out_of_range";
    case ErrorCode::not_finite:
      return "not_finite";
    default:
      return "another";
  }
}

/// Every prefix and every packet with one byte changed in each of its bits and as a whole. The copy is of exactly the
/// packet's size, so that a sanitizer sees a read past its end.
inline void for_each_damage(const Bytes& packet, const std::function<void(std::span<const std::uint8_t>)>& take) {
  for (std::size_t size = 0; size < packet.size(); ++size) {
    const Bytes prefix(packet.begin(), packet.begin() + static_cast<std::ptrdiff_t>(size));
    take(prefix);
  }
  for (std::size_t at = 0; at < packet.size(); ++at) {
    for (unsigned bit = 0; bit <= 8; ++bit) {
      Bytes flipped = packet;
      flipped[at] = static_cast<std::uint8_t>(flipped[at] ^ (bit == 8 ? 0xFFU : 1U << bit));
      take(flipped);
    }
  }
}

}  // namespace semblante::testing
