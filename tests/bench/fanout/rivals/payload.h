#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

namespace semblante::bench::rivals {

/// What every baseline sends: u64 sequence from 1, i64 ns of the monotonic clock (both little-endian, as the machines
/// this runs on have it), then zeros up to the size that was asked for.
struct Payload {
  std::uint64_t sequence = 0;
  std::int64_t sent_ns = 0;
};
inline constexpr std::size_t least_payload = 16;

inline std::string write_payload(const Payload& payload, std::size_t bytes) {
  std::string text(bytes < least_payload ? least_payload : bytes, '\0');
  std::memcpy(text.data(), &payload.sequence, 8);
  std::memcpy(text.data() + 8, &payload.sent_ns, 8);
  return text;
}

inline std::optional<Payload> read_payload(std::string_view bytes) {
  if (bytes.size() < least_payload) return std::nullopt;
  Payload payload;
  std::memcpy(&payload.sequence, bytes.data(), 8);
  std::memcpy(&payload.sent_ns, bytes.data() + 8, 8);
  return payload;
}

}  // namespace semblante::bench::rivals
