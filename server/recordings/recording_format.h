#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/messages.h"

/// The byte format of a recording file; described in README.md.
namespace semblante::recordings {

/// "SEMBREC" and the version that is written; those from 1 on are read.
inline constexpr std::array<std::uint8_t, 8> file_magic = {'S', 'E', 'M', 'B', 'R', 'E', 'C', 2};
inline constexpr std::array<std::uint8_t, 4> chunk_magic = {'C', 'H', 'N', 'K'};
inline constexpr std::size_t chunk_head_bytes = 48;
/// Limit of the messages in a chunk: enough for a keyframe and the most frames of a message, with every FAP changed in
/// each.
inline constexpr std::uint32_t max_chunk_bytes = 512U << 10U;
inline constexpr std::size_t max_chunk_frames = max_frames_per_message;
/// Limit of the messages in a chunk of sound that is written; those up to max_chunk_bytes are read.
inline constexpr std::uint32_t max_sound_chunk_bytes = 64U << 10U;
/// Limit of the messages in a chunk of text that is written, likewise.
inline constexpr std::uint32_t max_text_chunk_bytes = 64U << 10U;
/// What is written at once at most: a chunk of frames, one of sound and one of text.
inline constexpr std::uint64_t max_written_at_once =
    3 * chunk_head_bytes + max_chunk_bytes + max_sound_chunk_bytes + max_text_chunk_bytes;
/// ms after the first frame: one day, like the frames of a message.
inline constexpr std::uint64_t max_recording_ms = max_frame_time;

enum class ChunkKind : std::uint8_t { header = 1, frames = 2, sound = 3, text = 4 };

/// The head of a chunk, before its messages. Media times in ms of the stream's clock.
struct ChunkHead {
  std::uint32_t bytes = 0;  ///< of the messages
  std::uint32_t crc = 0;
  ChunkKind kind = ChunkKind::frames;
  std::uint32_t frames = 0;  ///< or packets of sound, or texts
  std::uint32_t lost = 0;    ///< number of frames directly before these that were not recorded; 0 for others
  std::uint64_t sequence = 0;
  std::uint64_t begin = 0, end = 0;  ///< media times of the first frame or packet and the last; of texts the extremes

  friend bool operator==(const ChunkHead&, const ChunkHead&) = default;
};

/// One frame of a recording.
struct RecordingFrame {
  std::uint64_t sequence = 0;
  std::uint64_t media_time = 0;
  FaceFrame state;
  friend bool operator==(const RecordingFrame&, const RecordingFrame&) = default;
};

/// The beginning of a file: magic, and the chunk with the stream's header.
std::vector<std::uint8_t> encode_beginning(const Header& header);

/// A chunk of 1 to max_chunk_frames frames with consecutive sequence numbers and media times that never decrease.
std::vector<std::uint8_t> encode_chunk(std::span<const RecordingFrame> frames, std::uint32_t lost);

/// How much of max_sound_chunk_bytes a packet takes.
std::size_t sound_message_bytes(const SoundPacket& sound);
/// A chunk of 1 to max_chunk_frames packets whose media times never decrease, within max_sound_chunk_bytes.
std::vector<std::uint8_t> encode_sound_chunk(std::span<const SoundPacket> packets);

/// How much of max_text_chunk_bytes a text takes.
std::size_t text_message_bytes(const SpeechText& text);
/// A chunk of 1 to max_chunk_frames texts in the order in which they came, within max_text_chunk_bytes.
std::vector<std::uint8_t> encode_text_chunk(std::span<const SpeechText> texts);

/// The first chunk_head_bytes of a chunk. Errors: truncated, malformed (no chunk begins here), out_of_range.
Result<ChunkHead> read_chunk_head(std::span<const std::uint8_t> bytes);

/// Checks a complete chunk (head and messages).
bool has_right_checksum(std::span<const std::uint8_t> chunk);

/// The content of a complete chunk (head and messages). Errors: truncated, mismatch (wrong checksum), malformed.
Result<Header> read_header_chunk(std::span<const std::uint8_t> bytes);
Result<std::vector<RecordingFrame>> read_frames_chunk(std::span<const std::uint8_t> bytes);
Result<std::vector<SoundPacket>> read_sound_chunk(std::span<const std::uint8_t> bytes);
Result<std::vector<SpeechText>> read_text_chunk(std::span<const std::uint8_t> bytes);

}  // namespace semblante::recordings
