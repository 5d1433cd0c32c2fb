#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace semblante::bench {

/// How a subscriber wants a stream.
enum class Coding : std::uint8_t { packed, json };

std::string_view subprotocol_of(Coding coding);
/// A subscriber's hello, as a masked WebSocket message.
std::string hello_frame(Coding coding);

}  // namespace semblante::bench
