#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <span>
#include <vector>

#include "core/types/result.h"

namespace semblante::recordings {

/// Writes packets of sound as a file Ogg/Opus (RFC 7845) whose clock is that of the packets: what a player of the file
/// plays at a time is what the packet of that time has. Between packets there is silence: no clock of a file has gaps.
class OggOpusWriter {
 public:
  /// Writes the beginning to `to`, which outlives it. `channels`: 1 or 2, of what a player makes.
  OggOpusWriter(std::ostream& to, unsigned channels);
  ~OggOpusWriter();
  OggOpusWriter(const OggOpusWriter&) = delete;
  OggOpusWriter& operator=(const OggOpusWriter&) = delete;

  /// A packet that begins `ms` after the beginning of the file. Times increase; a packet that begins more than 10 ms
  /// before the end of the one before is left out, so that lateness does not add up. `packet` is one for which
  /// opus_packet_ms() has a value.
  void add(std::uint64_t ms, std::span<const std::uint8_t> packet);
  /// Ends the file after the last packet.
  void finish();
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  struct Muxer;
  void append(std::span<const std::uint8_t> packet, std::int64_t samples);
  void put(bool is_last);
  void write_pages(bool all);

  std::ostream& to_;
  const std::unique_ptr<Muxer> muxer_;
  std::vector<std::uint8_t> pending_;  ///< the newest packet: only the last one of the file is marked as the last
  std::int64_t position_ = 0;          ///< samples of 48 kHz before the next packet
  std::int64_t packets_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace semblante::recordings
