#include <cstdint>
#include <cstdlib>

#include "clients/gateways/osc/packet.h"

using namespace semblante::osc;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto packet = read_packet({data, size});
  if (!packet) return 0;
  // What was accepted lies within the packet, and is no more than its bytes can say.
  if (packet->messages.size() * 4 > size) std::abort();
  unsigned sum = 0;
  for (const Message& message : packet->messages) {
    if (!message.address.starts_with('/') || message.arguments.size() > max_arguments) std::abort();
    for (const char c : message.address) sum += static_cast<unsigned char>(c);
    for (const Argument& argument : message.arguments) {
      if (const auto* text = std::get_if<std::string_view>(&argument)) {
        for (const char c : *text) sum += static_cast<unsigned char>(c);
      }
      if (const auto* blob = std::get_if<Blob>(&argument)) {
        for (const std::uint8_t byte : *blob) sum += byte;
      }
    }
  }
  // So that the reads above are not left out.
  return sum == 0xFFFFFFFFU ? 1 : 0;
}
