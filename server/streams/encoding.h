#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/cpp/messages.h"
#include "protocol/cpp/packed_codec.h"
#include "protocol/cpp/quantizers.h"

namespace semblante::streams {

/// The forms in which a stream's batches are sent: of the binary subprotocol and of the JSON one.
enum class Coding : std::uint8_t { packed, json };
inline constexpr std::size_t coding_count = 2;
inline constexpr std::array<std::string_view, coding_count> coding_names = {"packed", "json"};

/// Appends a binary message with its WebSocket frame header.
void append_payload(std::string& wire, const std::vector<std::uint8_t>& payload);

/// Appends a message; in binary form none with a face, which a PackedEncoder makes. `steps` are the stream's quantizer
/// steps, used to convert levels to FAP units in JSON.
void append_encoded(std::string& wire, const Message& message, bool binary, const QuantizerSteps& steps);

/// Appends the newest state of `packed`, from which a reader of that form can continue.
void append_join_point(std::string& wire, const PackedEncoder& packed, Coding coding, const QuantizerSteps& steps);

}  // namespace semblante::streams
