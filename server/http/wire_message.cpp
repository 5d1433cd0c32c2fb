#include "server/http/wire_message.h"

#include <cstdint>
#include <utility>

namespace semblante::http {

void append_message(std::string& wire, std::string_view payload, bool binary) {
  constexpr unsigned last_fragment = 0x80U;
  constexpr unsigned text = 1;
  constexpr unsigned bytes = 2;
  const auto append = [&](std::uint64_t value) {
    wire.push_back(static_cast<char>(static_cast<unsigned char>(value)));
  };
  append(last_fragment | (binary ? bytes : text));
  const std::uint64_t size = payload.size();
  if (size < 126) {
    append(size);
  } else {
    const bool fits_in_two = size <= 0xFFFFU;
    append(fits_in_two ? 126 : 127);
    for (int shift = fits_in_two ? 8 : 56; shift >= 0; shift -= 8)
      append((size >> static_cast<unsigned>(shift)) & 0xFFU);
  }
  wire.append(payload);
}

SharedWire make_wire(std::string_view payload, bool binary) {
  constexpr std::size_t longest_header = 10;
  WireMessage message;
  message.bytes.reserve(payload.size() + longest_header);
  append_message(message.bytes, payload, binary);
  return std::make_shared<const WireMessage>(std::move(message));
}

}  // namespace semblante::http
