#include "clients/native/plain/web_socket_reader.h"

#include <limits>
#include <utility>

namespace semblante::client {
namespace {

constexpr std::uint8_t final_bit = 0x80;
constexpr std::uint8_t mask_bit = 0x80;
constexpr std::size_t most_of_control = 125;
// Lengths of the second byte that say how many bytes with the length follow.
constexpr std::uint8_t two_bytes = 126;
constexpr std::uint8_t eight_bytes = 127;

Error bad_frame(const char* what) { return {ErrorCode::malformed, "socket", what}; }

}  // namespace

void WebSocketReader::take(std::span<const std::uint8_t> bytes) {
  held_.erase(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(at_));
  at_ = 0;
  held_.insert(held_.end(), bytes.begin(), bytes.end());
}

Result<std::optional<WebSocketReader::Message>> WebSocketReader::next() {
  using Next = std::optional<Message>;
  if (kind_ == WebSocketKind::continuation) message_.clear();
  while (true) {
    const std::span<const std::uint8_t> rest = std::span<const std::uint8_t>(held_).subspan(at_);
    if (rest.size() < 2) return Next();
    const bool is_final = (rest[0] & final_bit) != 0;
    const auto kind = static_cast<WebSocketKind>(rest[0] & 0x0FU);
    const bool is_control = kind >= WebSocketKind::close;
    if ((rest[0] & 0x70U) != 0 || kind > WebSocketKind::pong || (kind > WebSocketKind::binary && !is_control)) {
      return bad_frame("a frame of an unknown kind");
    }
    if ((rest[1] & mask_bit) != 0) return bad_frame("a masked frame, which only clients send");
    std::uint64_t size = rest[1];
    std::size_t head = 2;
    if (size >= two_bytes) {
      const std::size_t width = size == two_bytes ? 2 : 8;
      head += width;
      if (rest.size() < head) return Next();
      size = 0;
      for (std::size_t i = 2; i < head; ++i) size = size << 8U | rest[i];
      if (size <= (width == 2 ? most_of_control : std::numeric_limits<std::uint16_t>::max())) {
        return bad_frame("a length with more bytes than it needs");
      }
    }
    if (is_control && (!is_final || size > most_of_control)) return bad_frame("a control frame in parts, or too long");
    if (!is_control && (kind == WebSocketKind::continuation) == (kind_ == WebSocketKind::continuation)) {
      return bad_frame("a fragment without its message, or a message within another");
    }
    if (size > most_ - message_.size()) return Error{ErrorCode::too_large, "socket", "the message exceeds the limit"};
    if (rest.size() - head < size) return Next();
    const auto bytes = rest.subspan(head, size);
    at_ += head + size;
    if (is_control) return Next({kind, bytes});
    if (kind != WebSocketKind::continuation) kind_ = kind;
    message_.insert(message_.end(), bytes.begin(), bytes.end());
    if (is_final) return Next({std::exchange(kind_, WebSocketKind::continuation), message_});
  }
}

std::vector<std::uint8_t> web_socket_frame(WebSocketKind kind, std::span<const std::uint8_t> bytes,
                                           std::uint32_t mask) {
  std::vector<std::uint8_t> frame{static_cast<std::uint8_t>(final_bit | static_cast<std::uint8_t>(kind))};
  const std::uint64_t size = bytes.size();
  const auto add = [&](std::uint64_t number, unsigned width) {
    while (width-- > 0) frame.push_back(static_cast<std::uint8_t>(number >> (8 * width)));
  };
  if (size <= most_of_control) {
    add(mask_bit | size, 1);
  } else {
    const bool is_short = size <= std::numeric_limits<std::uint16_t>::max();
    add(mask_bit | (is_short ? two_bytes : eight_bytes), 1);
    add(size, is_short ? 2 : 8);
  }
  add(mask, 4);
  for (std::size_t i = 0; i < size; ++i) {
    frame.push_back(static_cast<std::uint8_t>(bytes[i] ^ (mask >> (8 * (3 - i % 4)))));
  }
  return frame;
}

}  // namespace semblante::client
