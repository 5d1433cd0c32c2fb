#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/recordings/byte_source.h"
#include "server/recordings/recording_format.h"

namespace semblante::recordings {

/// Whether opening reads every byte or the heads of the chunks alone (what a checksum would say is then said on
/// reading).
enum class Check { heads, everything };

/// A recording, to be read from any moment on. Holds an index of at most `max_index` chunks, whatever the length: of
/// longer ones every second, fourth, ... chunk, and the others are found from their heads. Immutable: any thread.
class RecordingReader {
 public:
  static constexpr std::size_t max_index = 4096;

  /// Takes any bytes: what follows the last whole chunk is left out, see whole_bytes(). Errors: truncated, malformed,
  /// mismatch, unsupported (another version) where the very beginning cannot be read; io.
  static Result<RecordingReader> open(std::shared_ptr<const ByteSource> bytes, Check check);

  /// Of the stream, when the recording began.
  [[nodiscard]] const Header& header() const { return header_; }
  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  [[nodiscard]] std::uint64_t lost() const { return lost_; }
  /// Media time of the first frame; times in a recording are ms after it.
  [[nodiscard]] std::uint64_t begin() const { return begin_; }
  /// Time of the last frame.
  [[nodiscard]] std::uint32_t duration() const { return static_cast<std::uint32_t>(end_ - begin_); }
  /// Up to the end of the last whole chunk.
  [[nodiscard]] std::uint64_t whole_bytes() const { return whole_bytes_; }
  [[nodiscard]] std::uint64_t torn_bytes() const { return bytes_->size() - whole_bytes_; }
  /// Why the bytes after that are none of a chunk; empty when there are none.
  [[nodiscard]] const std::string& torn_reason() const { return torn_reason_; }

  /// Mean distance of two frames, ms; 40 for one alone.
  [[nodiscard]] double mean_interval() const;

  /// The newest frame at or before `ms`; nothing in an empty recording. Errors: a chunk that is damaged, by byte.
  [[nodiscard]] Result<std::optional<RecordingFrame>> at(std::uint32_t ms) const;

 private:
  friend class RecordingCursor;
  struct Entry {
    std::uint64_t offset = 0;
    std::uint64_t begin = 0;  ///< media time
  };
  struct Chunk {
    std::uint64_t offset = 0;
    ChunkHead head;
  };

  [[nodiscard]] std::optional<Chunk> chunk_at(std::uint64_t offset) const;
  [[nodiscard]] std::optional<Chunk> chunk_after(const Chunk& chunk) const;
  [[nodiscard]] Result<std::vector<RecordingFrame>> read(const Chunk& chunk) const;
  /// The offset of the last indexed chunk that begins before `media_time`, else of the first chunk.
  [[nodiscard]] std::uint64_t offset_before(std::uint64_t media_time) const;
  void add(const Chunk& chunk);
  std::optional<Error> walk(Check check);

  std::shared_ptr<const ByteSource> bytes_;
  Header header_;
  std::vector<Entry> index_;
  std::size_t stride_ = 1;  ///< chunks from one entry of the index to the next
  std::size_t chunks_ = 0;
  std::uint64_t first_chunk_ = 0;  ///< offset of what follows the header's chunk
  std::uint64_t frames_ = 0, lost_ = 0, begin_ = 0, end_ = 0, whole_bytes_ = 0, last_sequence_ = 0;
  std::string torn_reason_;
};

/// Walks through the frames of a recording in order; holds one chunk of them.
class RecordingCursor {
 public:
  /// To the first frame at or after `ms`.
  RecordingCursor(std::shared_ptr<const RecordingReader> reader, std::uint32_t ms);

  /// The frame at hand; null after the last, and where a chunk is damaged: then there is an error.
  [[nodiscard]] const RecordingFrame* frame() const;
  /// ms after the beginning, of the frame at hand.
  [[nodiscard]] std::uint32_t time() const;
  void advance();
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  void load(std::optional<RecordingReader::Chunk> chunk);

  std::shared_ptr<const RecordingReader> reader_;
  std::optional<RecordingReader::Chunk> chunk_;
  std::vector<RecordingFrame> frames_;
  std::size_t next_ = 0;
  std::optional<Error> error_;
};

}  // namespace semblante::recordings
