#include "server/streams/sound_guard.h"

#include <cassert>
#include <cmath>
#include <string>

#include "protocol/cpp/opus_packet.h"

namespace semblante::streams {

Result<double> SoundGuard::check(const SoundPacket& sound, Clock::time_point now) {
  const auto lasts = opus_packet_ms(sound.packet);
  assert(lasts);  // the decoders refuse what is no Opus packet: check_sound()
  const auto begins = static_cast<double>(sound.media_time);
  // Packets may last half milliseconds, and media times are whole ones.
  if (begins < std::floor(ends_))
    return Error{ErrorCode::out_of_range, "/media_time", "the packet begins before the one before it has ended"};
  if (!bytes_.take(static_cast<double>(sound.packet.size()), now))
    return Error{ErrorCode::too_large, "/packet",
                 "the sound has more than " + std::to_string(static_cast<int>(bytes_per_second)) + " bytes per second"};
  ends_ = begins + *lasts;
  return *lasts;
}

}  // namespace semblante::streams
