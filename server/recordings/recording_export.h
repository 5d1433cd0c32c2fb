#pragma once

#include <cstdint>
#include <iosfwd>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "protocol/cpp/face_values.h"
#include "server/recordings/recording_reader.h"

namespace semblante::recordings {

/// A part of a recording, and the rate of its faces. Times in ms.
struct Cut {
  std::uint32_t from = 0;
  std::uint32_t to = std::numeric_limits<std::uint32_t>::max();
  double rate = 0.0;  ///< faces per second, interpolated linearly; 0: the frames at their own times
};

/// Limit of exports that are made in memory: two hours with 25 frames per second.
inline constexpr std::size_t max_gathered_frames = 200'000;
inline constexpr std::uint64_t max_written_bytes = std::uint64_t{1} << 30U;

/// Iterates over the faces of a cut, in FAP units. Times count from its beginning, which shows the frame before it.
class CutFrames {
 public:
  CutFrames(std::shared_ptr<const RecordingReader> reader, const Cut& cut);
  /// False after the last face, and at a damaged place: then error() is set.
  bool next(TimedValues& frame);
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  bool next_frame(TimedValues& frame);

  const std::shared_ptr<const RecordingReader> reader_;
  const Cut cut_;
  const QuantizerSteps steps_;
  RecordingCursor cursor_;
  bool led_in_ = false;
  std::optional<TimedValues> before_, after_;  ///< with a rate: the frames around the current time
  std::uint64_t sample_ = 0;
  std::optional<Error> error_;
};

// Errors of all functions below: empty (no frame in the cut), too_large (request a shorter cut), damage, with its byte,
// and io when the stream fails.

/// All faces of a cut.
Result<std::vector<TimedValues>> gather(std::shared_ptr<const RecordingReader> reader, const Cut& cut,
                                        std::size_t most = max_gathered_frames);
/// A performance that reproduces the recorded levels at the recorded times: keys with linear interpolation, within a
/// quarter of a quantizer step.
Result<std::string> export_performance(std::shared_ptr<const RecordingReader> reader, const Cut& cut,
                                       const std::string& name);
/// A .fap file with cut.rate frames per second, or with the lowest rate that has every frame; values in whole FAP
/// units.
Result<std::string> export_fap(std::shared_ptr<const RecordingReader> reader, const Cut& cut, const std::string& name);
/// Frames in the form of POST /v1/streams/{id}/frames, one per line; written chunk by chunk, for any length.
Status export_frames(std::shared_ptr<const RecordingReader> reader, const Cut& cut, std::ostream& to);
/// A take in the CSV form of Live Link Face; written chunk by chunk.
Status export_arkit_csv(std::shared_ptr<const RecordingReader> reader, const Cut& cut, std::ostream& to);
/// The sound as Ogg/Opus on the clock of the faces of the same cut; written chunk by chunk, for any length. Empty when
/// no sound begins in the cut.
Status export_sound(const std::shared_ptr<const RecordingReader>& reader, const Cut& cut, std::ostream& to);

}  // namespace semblante::recordings
