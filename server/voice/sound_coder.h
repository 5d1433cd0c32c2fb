#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/types/result.h"

struct OpusEncoder;

namespace semblante::voice {

inline constexpr double packet_ms = 60.0;                ///< how long each packet lasts, but the last ones of a part
inline constexpr std::uint32_t packet_bitrate = 20'000;  ///< bit/s, of voiced sound

/// An Opus packet (RFC 6716), and when what is decoded of it begins, ms.
struct CodedSound {
  std::uint64_t time = 0;
  std::vector<std::uint8_t> packet;
};

/// Sound of one channel as Opus packets for the messages `sound` of a stream. It is given in parts, of any rates, which
/// follow each other without a gap. The delay of the coder is taken out, and the first milliseconds of the sound with
/// it. One thread.
class SoundCoder {
 public:
  /// Error `internal`: the library's.
  static Result<SoundCoder> make();

  /// Takes up a part; less than 10 ms of silence complete it, so that all of it can be coded before the next one comes.
  /// Error `out_of_range`: a sample rate outside 8,000 to 48,000 Hz.
  Status add(std::span<const std::int16_t> samples, std::uint32_t sample_rate);
  /// Where the sound that was taken up ends, ms.
  [[nodiscard]] double end() const;
  /// The part of which nothing has been coded yet begins later. `ms` is a multiple of 10.
  void pause(double ms);
  /// Codes about as much as this, ms, of what was taken up. Packets in which nothing is heard are left out. Takes 9 ms
  /// of processor time for each second of sound.
  Result<std::vector<CodedSound>> code(double ms);
  /// Whether all that was taken up has been coded.
  [[nodiscard]] bool done() const { return waiting_.size() == coded_; }

 private:
  using Encoder = std::unique_ptr<OpusEncoder, void (*)(OpusEncoder*)>;
  SoundCoder(Encoder encoder, std::size_t delay) : encoder_(std::move(encoder)), delay_(delay), cut_(delay) {}

  Encoder encoder_;
  std::size_t delay_;           ///< of the coder, samples
  std::size_t cut_;             ///< how many samples are still to be left out at the beginning
  std::size_t begin_ = 0;       ///< when what is waiting begins, samples
  std::size_t coded_ = 0;       ///< of what is waiting
  std::vector<float> waiting_;  ///< the part, within +-1
};

}  // namespace semblante::voice
