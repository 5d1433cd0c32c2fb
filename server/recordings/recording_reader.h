#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/recordings/byte_source.h"
#include "server/recordings/recording_format.h"

namespace semblante::recordings {

/// Whether opening reads every byte, or only the heads of the chunks (then checksums are verified when frames are
/// read).
enum class Check { heads, everything };

/// A recording, readable from any time on. Keeps an index of at most `max_index` chunks for any length: of a longer
/// recording every second, fourth, ... chunk; the others are found by reading heads. Immutable: any thread.
class RecordingReader {
 public:
  static constexpr std::size_t max_index = 4096;

  /// Accepts any bytes and ignores those after the last complete chunk, see whole_bytes(). Errors: truncated,
  /// malformed, mismatch, unsupported (another version) when the beginning cannot be read; io.
  static Result<RecordingReader> open(std::shared_ptr<const ByteSource> bytes, Check check);

  /// The stream's header at the beginning of the recording.
  [[nodiscard]] const Header& header() const { return header_; }
  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  [[nodiscard]] std::uint64_t lost() const { return lost_; }
  /// Packets of sound.
  [[nodiscard]] std::uint64_t sound_packets() const { return sound_packets_; }
  /// What was said, in order of time; `media_time` in ms after the beginning of the recording. A text without letters
  /// ends the one before it; those that would begin after it or after the last frame are left out. Errors: a damaged
  /// chunk, with its byte.
  [[nodiscard]] Result<std::vector<SpeechText>> texts() const;
  /// Media time of the first frame; times in a recording are ms after it.
  [[nodiscard]] std::uint64_t begin() const { return begin_; }
  /// Time of the last frame.
  [[nodiscard]] std::uint32_t duration() const { return static_cast<std::uint32_t>(end_ - begin_); }
  /// Offset of the end of the last complete chunk.
  [[nodiscard]] std::uint64_t whole_bytes() const { return whole_bytes_; }
  [[nodiscard]] std::uint64_t torn_bytes() const { return bytes_->size() - whole_bytes_; }
  /// Why the bytes after that are not a chunk; empty when there are none.
  [[nodiscard]] const std::string& torn_reason() const { return torn_reason_; }

  /// Mean interval between frames, ms; 40 for a single frame.
  [[nodiscard]] double mean_interval() const;

  /// The newest frame at or before `ms`; nullopt in an empty recording. Errors: a damaged chunk, with its byte.
  [[nodiscard]] Result<std::optional<RecordingFrame>> at(std::uint32_t ms) const;

 private:
  friend class RecordingCursor;
  friend class RecordingSoundCursor;
  struct Chunk {
    std::uint64_t offset = 0;
    ChunkHead head;
  };
  /// Where the chunks of one kind are.
  class Index {
   public:
    void add(const Chunk& chunk);
    [[nodiscard]] bool empty() const { return entries_.empty(); }
    /// The offset of the last indexed chunk that begins before `media_time`, else of the first chunk.
    [[nodiscard]] std::uint64_t offset_before(std::uint64_t media_time) const;

   private:
    struct Entry {
      std::uint64_t offset = 0;
      std::uint64_t begin = 0;  ///< media time
    };
    std::vector<Entry> entries_;
    std::size_t stride_ = 1;  ///< chunks per entry
    std::size_t chunks_ = 0;
  };

  [[nodiscard]] std::optional<Chunk> chunk_at(std::uint64_t offset) const;
  /// The next chunk of the same kind.
  [[nodiscard]] std::optional<Chunk> chunk_after(const Chunk& chunk) const;
  [[nodiscard]] Result<std::vector<RecordingFrame>> read(const Chunk& chunk) const;
  [[nodiscard]] Result<std::vector<SoundPacket>> read_sound(const Chunk& chunk) const;
  [[nodiscard]] Result<std::vector<SpeechText>> read_texts(const Chunk& chunk) const;
  /// Checks that a chunk follows those before it, and takes it into the index.
  Status add_frames(const Chunk& chunk, Check check);
  Status add_sound(const Chunk& chunk, Check check);
  Status add_texts(const Chunk& chunk, Check check);
  std::optional<Error> walk(Check check);

  std::shared_ptr<const ByteSource> bytes_;
  Header header_;
  Index index_, sound_index_;
  std::optional<Chunk> first_texts_;
  std::uint64_t first_chunk_ = 0;  ///< offset after the header's chunk
  std::uint64_t frames_ = 0, lost_ = 0, begin_ = 0, end_ = 0, whole_bytes_ = 0, last_sequence_ = 0;
  std::uint64_t sound_packets_ = 0, sound_end_ = 0;  ///< sound_end_: media time of the last packet
  std::string torn_reason_;
};

/// Iterates over the frames of a recording in order; keeps one chunk in memory.
class RecordingCursor {
 public:
  /// Begins at the first frame at or after `ms`.
  RecordingCursor(std::shared_ptr<const RecordingReader> reader, std::uint32_t ms);

  /// The current frame; null after the last one, and at a damaged chunk: then error() is set.
  [[nodiscard]] const RecordingFrame* frame() const;
  /// Time of the current frame, ms after the beginning.
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

/// Iterates over the packets of sound in order; keeps one chunk in memory.
class RecordingSoundCursor {
 public:
  /// Begins at the first packet at or after `ms`.
  RecordingSoundCursor(std::shared_ptr<const RecordingReader> reader, std::uint32_t ms);

  /// The current packet, with its time in ms after the beginning of the recording; null after the last one, and at a
  /// damaged chunk: then error() is set.
  [[nodiscard]] const SoundPacket* packet() const;
  void advance();
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  void load(std::optional<RecordingReader::Chunk> chunk);

  std::shared_ptr<const RecordingReader> reader_;
  std::optional<RecordingReader::Chunk> chunk_;
  std::vector<SoundPacket> packets_;
  std::size_t next_ = 0;
  std::optional<Error> error_;
};

}  // namespace semblante::recordings
