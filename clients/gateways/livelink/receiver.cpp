#include "clients/gateways/livelink/receiver.h"

#include <utility>

#include "clients/gateways/livelink/packet.h"

namespace semblante::livelink {

Result<std::optional<ReceivedFace>> Receiver::take(std::span<const std::uint8_t> bytes, double arrival) {
  auto packet = read_packet(bytes);
  if (!packet) return std::move(packet).error();
  const std::pair sender(packet->device, packet->subject);
  if (followed_ && *followed_ != sender && arrival - last_ > forget_seconds) followed_.reset();
  const bool is_wanted = wanted_.empty() || packet->subject == wanted_;
  if (!is_wanted || (followed_ && *followed_ != sender)) {
    ++others_;
    return std::optional<ReceivedFace>();
  }
  if (!packet->face) {
    // A device without a face is not followed yet.
    if (followed_) last_ = arrival;
    ++faceless_;
    return std::optional<ReceivedFace>();
  }
  followed_ = sender;
  last_ = arrival;
  const auto made = frame_from_arkit(packet->face->coefficients);
  if (!made) return made.error();
  ReceivedFace face{made->frame, packet->seconds, made->clamped};
  turn_head(face.frame, packet->face->head);
  return std::optional<ReceivedFace>(face);
}

}  // namespace semblante::livelink
