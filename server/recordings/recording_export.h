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

/// Which part of a recording, and how close together its faces. Times in ms.
struct Cut {
  std::uint32_t from = 0;
  std::uint32_t to = std::numeric_limits<std::uint32_t>::max();
  double rate = 0.0;  ///< faces a second, made by straight lines between frames; 0: the frames at their own times
};

/// What is made in memory is refused beyond so many frames: two hours of 25 a second.
inline constexpr std::size_t max_gathered_frames = 200'000;
inline constexpr std::uint64_t max_written_bytes = std::uint64_t{1} << 30U;

/// The faces of a cut, one after another: times count from its beginning, where the frame before it holds. In FAP
/// units.
class CutFrames {
 public:
  CutFrames(std::shared_ptr<const RecordingReader> reader, const Cut& cut);
  /// False after the last, and where the recording is damaged: then there is an error.
  bool next(TimedValues& frame);
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  bool next_frame(TimedValues& frame);

  const std::shared_ptr<const RecordingReader> reader_;
  const Cut cut_;
  const QuantizerSteps steps_;
  RecordingCursor cursor_;
  bool led_in_ = false;
  std::optional<TimedValues> before_, after_;  ///< of a rate: the frames around the moment
  std::uint64_t sample_ = 0;
  std::optional<Error> error_;
};

// Errors of all: empty (no frame in the cut), too_large (take a shorter one), and damage, by byte.

/// All faces of a cut.
Result<std::vector<TimedValues>> gather(std::shared_ptr<const RecordingReader> reader, const Cut& cut,
                                        std::size_t most = max_gathered_frames);
/// A performance that gives the recorded levels at the recorded times: keys joined by straight lines within a quarter
/// of a quantizer step.
Result<std::string> export_performance(std::shared_ptr<const RecordingReader> reader, const Cut& cut,
                                       const std::string& name);
/// A .fap file of cut.rate frames a second, or of the lowest rate that has every frame; values in whole FAP units.
Result<std::string> export_fap(std::shared_ptr<const RecordingReader> reader, const Cut& cut, const std::string& name);
/// The frames of POST /v1/streams/{id}/frames, one a line; chunk by chunk, whatever the length.
Status export_frames(std::shared_ptr<const RecordingReader> reader, const Cut& cut, std::ostream& to);
/// A take as Live Link Face writes it, likewise.
Status export_arkit_csv(std::shared_ptr<const RecordingReader> reader, const Cut& cut, std::ostream& to);

}  // namespace semblante::recordings
