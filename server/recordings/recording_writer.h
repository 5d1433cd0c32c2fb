#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "server/recordings/recording_format.h"

namespace semblante::recordings {

/// How far a recording has come. Times in ms after the first frame.
struct RecordingProgress {
  std::uint64_t frames = 0, lost = 0;
  std::uint64_t bytes = 0;       ///< of the file
  std::uint64_t media_time = 0;  ///< of the first frame, on the stream's clock
  std::uint32_t duration = 0;    ///< time of the last frame
  std::uint64_t sequence = 0;    ///< of the last frame; 0: none yet

  friend bool operator==(const RecordingProgress&, const RecordingProgress&) = default;
};

/// Writes one recording: frames are gathered, and written as a chunk by flush() or when there are as many as one takes.
/// What flush() has returned from is on the disk. One thread.
class RecordingWriter {
 public:
  /// Makes the file, which must not be there, with its beginning; durable, the folder too. Errors: io.
  static Result<std::unique_ptr<RecordingWriter>> create(const std::filesystem::path& path, const Header& header);
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  /// Frames of the stream, in its order. Those before them that never came are counted as lost. A time that falls
  /// becomes that of the frame before. Errors: io (what is on the disk stays whole); out_of_range beyond a day: then
  /// nothing more is taken.
  Status add(const Frames& batch);
  Status flush();

  /// Of what is written and durable; add() alone changes nothing in it until its chunk is full.
  [[nodiscard]] const RecordingProgress& durable() const { return durable_; }
  /// Of the first frame that came, durable or not.
  [[nodiscard]] std::optional<std::uint64_t> first_media_time() const {
    return last_sequence_ == 0 ? std::nullopt : std::optional(first_time_);
  }

 private:
  RecordingWriter(int descriptor, std::uint64_t bytes);
  Status write(const std::vector<std::uint8_t>& bytes);

  const int descriptor_;
  RecordingProgress durable_;
  std::vector<RecordingFrame> waiting_;
  std::uint32_t lost_before_ = 0;    ///< the frames that wait
  std::uint64_t last_sequence_ = 0;  ///< that came
  std::uint64_t last_time_ = 0, first_time_ = 0;
  bool broken_ = false;
};

/// Cuts a file off after its last whole chunk, as a process that was killed while it wrote may have left it; durable.
/// Returns how it is then. Errors: as RecordingReader::open; mismatch when more than a chunk would have to go: that is
/// damage and no torn end, and nothing is changed.
Result<RecordingProgress> repair_recording(const std::filesystem::path& path);

}  // namespace semblante::recordings
