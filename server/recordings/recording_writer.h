#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "server/recordings/recording_format.h"

namespace semblante::recordings {

/// The durable part of a recording. Times in ms after the first frame.
struct RecordingProgress {
  std::uint64_t frames = 0, lost = 0;
  std::uint64_t bytes = 0;       ///< of the file
  std::uint64_t media_time = 0;  ///< of the first frame, on the stream's clock
  std::uint32_t duration = 0;    ///< time of the last frame
  std::uint64_t sequence = 0;    ///< of the last frame; 0: none
  std::uint64_t sound_packets = 0;

  friend bool operator==(const RecordingProgress&, const RecordingProgress&) = default;
};

/// Writes one recording. Frames, packets of sound and texts are gathered and written as chunks by flush() or when a
/// chunk is full. They are durable when flush() returns. One thread.
class RecordingWriter {
 public:
  /// Creates the file, which must not exist, with its header chunk; durable, with its folder. Errors: io.
  static Result<std::unique_ptr<RecordingWriter>> create(const std::filesystem::path& path, const Header& header);
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  /// Adds frames in the stream's order. Missing frames before them are counted as lost. A decreasing time is replaced
  /// by that of the frame before. Errors: io (the durable part stays valid); out_of_range after one day: then no more
  /// frames are accepted.
  Status add(const Frames& batch);
  /// Adds a packet of sound. Left out are a packet before the first frame, where the recording begins, and one that
  /// does not follow the packet before it. Errors: io.
  Status add(const SoundPacket& sound);
  /// Adds a text, unless its first word is before the first frame. Errors: io.
  Status add(const SpeechText& text);
  Status flush();

  /// The durable part; add() changes it only when a chunk is full.
  [[nodiscard]] const RecordingProgress& durable() const { return durable_; }
  /// Media time of the first frame, durable or not.
  [[nodiscard]] std::optional<std::uint64_t> first_media_time() const {
    return last_sequence_ == 0 ? std::nullopt : std::optional(first_time_);
  }

 private:
  RecordingWriter(int descriptor, std::uint64_t bytes);
  void begin_at(std::uint64_t media_time);
  void drop_sound(std::size_t count);
  void drop_texts_before(std::uint64_t media_time);

  const int descriptor_;
  RecordingProgress durable_;
  std::vector<RecordingFrame> waiting_;
  std::vector<SoundPacket> waiting_sound_;  ///< before the first frame: those that may follow it
  std::size_t waiting_sound_bytes_ = 0;     ///< in a chunk
  std::uint64_t last_sound_time_ = 0;
  std::vector<SpeechText> waiting_texts_;  ///< likewise
  std::size_t waiting_text_bytes_ = 0;
  std::uint32_t lost_before_ = 0;    ///< frames lost before those that are not written yet
  std::uint64_t last_sequence_ = 0;  ///< of the last frame added
  std::uint64_t last_time_ = 0, first_time_ = 0;
  bool broken_ = false;
};

/// Truncates the file of a killed process after its last complete chunk; durable. Returns the progress of the result.
/// Errors: like RecordingReader::open; mismatch when more would be removed than is written at once: that is damage and
/// not a torn end, and the file is not changed.
Result<RecordingProgress> repair_recording(const std::filesystem::path& path);

}  // namespace semblante::recordings
