#include "server/recordings/recording_format.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>
#include <zlib.h>

#include "protocol/cpp/byte_io.h"
#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/packed_codec.h"
#include "server/recordings/recording_version_1.h"

namespace semblante::recordings {
namespace {

using byte_io::get_u32;
using byte_io::put_u32;
using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t at_length = 4, at_crc = 8, at_kind = 12, at_frames = 16, at_lost = 20, at_sequence = 24,
                      at_begin = 32, at_end = 40;
constexpr std::uint64_t max_number = 9'007'199'254'740'991U;  ///< the same limit as in messages

void put_u64(std::uint8_t* to, std::uint64_t value) {
  put_u32(to, static_cast<std::uint32_t>(value));
  put_u32(to + 4, static_cast<std::uint32_t>(value >> 32U));
}
std::uint64_t get_u64(const std::uint8_t* from) {
  return get_u32(from) | static_cast<std::uint64_t>(get_u32(from + 4)) << 32U;
}

void append_message(std::vector<std::uint8_t>& to, const std::vector<std::uint8_t>& bytes) {
  byte_io::append_varint(to, bytes.size());
  to.insert(to.end(), bytes.begin(), bytes.end());
}

std::uint32_t checksum(Bytes chunk) {
  return static_cast<std::uint32_t>(crc32_z(0, chunk.data() + at_kind, chunk.size() - at_kind));
}

/// Writes the head of a chunk whose messages are complete.
void finish(std::vector<std::uint8_t>& chunk, const ChunkHead& head) {
  std::copy(chunk_magic.begin(), chunk_magic.end(), chunk.begin());
  put_u32(&chunk[at_length], static_cast<std::uint32_t>(chunk.size() - chunk_head_bytes));
  chunk[at_kind] = static_cast<std::uint8_t>(head.kind);
  put_u32(&chunk[at_frames], head.frames);
  put_u32(&chunk[at_lost], head.lost);
  put_u64(&chunk[at_sequence], head.sequence);
  put_u64(&chunk[at_begin], head.begin);
  put_u64(&chunk[at_end], head.end);
  put_u32(&chunk[at_crc], checksum(chunk));
  assert(chunk.size() - chunk_head_bytes <= max_chunk_bytes);
}

Error malformed(std::string message) { return {ErrorCode::malformed, "", std::move(message)}; }

/// The head of a complete chunk, after checking its length and checksum.
Result<ChunkHead> checked_head(Bytes bytes, ChunkKind kind) {
  auto head = read_chunk_head(bytes);
  if (!head) return head;
  if (bytes.size() - chunk_head_bytes < head->bytes) return Error{ErrorCode::truncated, "", "the chunk is cut off"};
  if (!has_right_checksum(bytes.first(chunk_head_bytes + head->bytes)))
    return Error{ErrorCode::mismatch, "", "the checksum of the chunk is wrong"};
  if (head->kind != kind) return malformed("unexpected kind of chunk");
  return head;
}

/// Reads messages with a length prefix.
class Messages {
 public:
  explicit Messages(Bytes bytes) : reader_(bytes) {}
  [[nodiscard]] bool empty() const { return reader_.remaining() == 0; }
  Result<Bytes> next() {
    const auto length = reader_.varint();
    const auto bytes = reader_.take(static_cast<std::size_t>(std::min<std::uint64_t>(length, max_chunk_bytes + 1U)));
    if (reader_.failed()) return Error{ErrorCode::truncated, "", "the chunk ends within a message"};
    if (bytes.empty()) return malformed("a message of a chunk is empty");
    return bytes;
  }

 private:
  byte_io::Reader reader_;
};

/// Reads the messages of one chunk of frames.
class FramesDecoder {
 public:
  Result<Keyframe> keyframe(Bytes message) {
    is_version_1_ = Version1Decoder::reads(message[0]);
    if (is_version_1_) return version_1_.keyframe(message);
    if (!is_keyframe(message[0])) return malformed("a chunk must begin with a keyframe");
    return read_packed_keyframe(message, state_);
  }
  Status frames(Bytes message, Frames& to) {
    if (is_version_1_) return version_1_.frames(message, to);
    if (!is_frames(message[0])) return malformed("after the keyframe of a chunk there must be frames");
    return read_packed_frames(message, state_, to);
  }

 private:
  bool is_version_1_ = false;
  Version1Decoder version_1_;
  PackedState state_;
};

/// A chunk without its head: the messages.
template <class M>
std::vector<std::uint8_t> chunk_of(std::span<const M> messages) {
  assert(!messages.empty() && messages.size() <= max_chunk_frames);
  std::vector<std::uint8_t> chunk(chunk_head_bytes);
  std::vector<std::uint8_t> bytes;
  for (const M& message : messages) {
    bytes.clear();
    encode_message(message, bytes);
    append_message(chunk, bytes);
  }
  return chunk;
}

/// The messages of a complete chunk that has one kind of them.
template <class M>
Result<std::vector<M>> messages_of(Bytes bytes, const ChunkHead& head) {
  Messages messages(bytes.subspan(chunk_head_bytes, head.bytes));
  std::vector<M> read;
  while (!messages.empty() && read.size() < head.frames) {
    const auto bytes_of_one = messages.next();
    if (!bytes_of_one) return bytes_of_one.error();
    auto message = FrameDecoder().decode(*bytes_of_one);
    if (!message) return message.error();
    auto* one = std::get_if<M>(&*message);
    if (one == nullptr) return malformed("a message of a chunk is not of its kind");
    read.push_back(std::move(*one));
  }
  return read;
}

std::pair<std::uint64_t, std::uint64_t> extremes(std::span<const SpeechText> texts) {
  const auto earlier = [](const SpeechText& a, const SpeechText& b) { return a.media_time < b.media_time; };
  const auto [first, last] = std::minmax_element(texts.begin(), texts.end(), earlier);
  return {first->media_time, last->media_time};
}

}  // namespace

std::vector<std::uint8_t> encode_beginning(const Header& header) {
  std::vector<std::uint8_t> chunk(chunk_head_bytes);
  std::vector<std::uint8_t> message;
  encode_message(header, message);
  append_message(chunk, message);
  finish(chunk, {.kind = ChunkKind::header,
                 .frames = 0,
                 .sequence = header.sequence,
                 .begin = header.media_time,
                 .end = header.media_time});
  chunk.insert(chunk.begin(), file_magic.begin(), file_magic.end());
  return chunk;
}

std::vector<std::uint8_t> encode_chunk(std::span<const RecordingFrame> frames, std::uint32_t lost) {
  assert(!frames.empty() && frames.size() <= max_chunk_frames);
  const auto& first = frames.front();
  std::vector<std::uint8_t> chunk(chunk_head_bytes);
  PackedEncoder encoder(Keyframe{first.sequence, first.media_time, first.state});
  append_message(chunk, encoder.keyframe());
  if (frames.size() > 1) {
    Frames rest;
    rest.sequence = first.sequence + 1;
    rest.media_time = first.media_time;
    for (const auto& frame : frames.subspan(1)) {
      assert(frame.sequence == first.sequence + rest.frames.size() + 1 && "no gap within a chunk");
      rest.frames.push_back({static_cast<std::uint32_t>(frame.media_time - first.media_time), frame.state});
    }
    append_message(chunk, encoder.encode(rest));
  }
  finish(chunk, {.frames = static_cast<std::uint32_t>(frames.size()),
                 .lost = lost,
                 .sequence = first.sequence,
                 .begin = first.media_time,
                 .end = frames.back().media_time});
  return chunk;
}

std::size_t sound_message_bytes(const SoundPacket& sound) {
  // The most that the varints of length, media time and packet size, and the type, take.
  constexpr std::size_t around_packet = 3 + 1 + 8 + 2;
  return sound.packet.size() + around_packet;
}

std::vector<std::uint8_t> encode_sound_chunk(std::span<const SoundPacket> packets) {
  auto chunk = chunk_of(packets);
  finish(chunk, {.kind = ChunkKind::sound,
                 .frames = static_cast<std::uint32_t>(packets.size()),
                 .begin = packets.front().media_time,
                 .end = packets.back().media_time});
  return chunk;
}

std::size_t text_message_bytes(const SpeechText& text) {
  // The most that the varints of length, number, time and sizes, and the type, take.
  constexpr std::size_t around = 3 + 1 + 8 + 8 + 1 + 2 + 2;
  return text.language.size() + text.text.size() + text.score.size() + around;
}

std::vector<std::uint8_t> encode_text_chunk(std::span<const SpeechText> texts) {
  auto chunk = chunk_of(texts);
  const auto [begin, end] = extremes(texts);
  finish(chunk,
         {.kind = ChunkKind::text, .frames = static_cast<std::uint32_t>(texts.size()), .begin = begin, .end = end});
  return chunk;
}

Result<ChunkHead> read_chunk_head(Bytes bytes) {
  if (bytes.size() < chunk_head_bytes) return Error{ErrorCode::truncated, "", "the head of a chunk is cut off"};
  if (!std::equal(chunk_magic.begin(), chunk_magic.end(), bytes.begin())) return malformed("no chunk begins here");
  ChunkHead head;
  head.bytes = get_u32(&bytes[at_length]);
  head.crc = get_u32(&bytes[at_crc]);
  head.kind = static_cast<ChunkKind>(bytes[at_kind]);
  head.frames = get_u32(&bytes[at_frames]);
  head.lost = get_u32(&bytes[at_lost]);
  head.sequence = get_u64(&bytes[at_sequence]);
  head.begin = get_u64(&bytes[at_begin]);
  head.end = get_u64(&bytes[at_end]);
  if (head.bytes > max_chunk_bytes) return Error{ErrorCode::too_large, "", "the chunk's length is over the limit"};
  if (head.kind < ChunkKind::frames || head.kind > ChunkKind::text) return head;
  const bool in_range = head.frames >= 1 && head.frames <= max_chunk_frames && head.sequence <= max_number &&
                        head.end <= max_number && head.begin <= head.end &&
                        (head.kind == ChunkKind::frames || (head.sequence == 0 && head.lost == 0));
  if (!in_range) return Error{ErrorCode::out_of_range, "", "the head of a chunk has impossible values"};
  return head;
}

bool has_right_checksum(Bytes chunk) {
  assert(chunk.size() >= chunk_head_bytes);
  return checksum(chunk) == get_u32(&chunk[at_crc]);
}

Result<Header> read_header_chunk(Bytes bytes) {
  const auto head = checked_head(bytes, ChunkKind::header);
  if (!head) return head.error();
  Messages messages(bytes.subspan(chunk_head_bytes, head->bytes));
  const auto only = messages.next();
  if (!only) return only.error();
  auto message = FrameDecoder().decode(*only);
  if (!message) return message.error();
  if (auto* header = std::get_if<Header>(&*message)) return std::move(*header);
  return malformed("the first chunk has no header");
}

Result<std::vector<RecordingFrame>> read_frames_chunk(Bytes bytes) {
  const auto head = checked_head(bytes, ChunkKind::frames);
  if (!head) return head.error();
  Messages messages(bytes.subspan(chunk_head_bytes, head->bytes));
  const auto first = messages.next();
  if (!first) return first.error();
  FramesDecoder decoder;
  const auto key = decoder.keyframe(*first);
  if (!key) return key.error();
  std::vector<RecordingFrame> frames = {{key->sequence, key->media_time, key->state}};
  Frames batch;
  while (!messages.empty() && frames.size() < head->frames) {
    const auto message = messages.next();
    if (!message) return message.error();
    if (const auto status = decoder.frames(*message, batch); !status) return status.error();
    for (const auto& frame : batch.frames)
      frames.push_back({batch.sequence++, batch.media_time + frame.time, frame.state});
  }
  const bool as_said = frames.size() == head->frames && frames.front().sequence == head->sequence &&
                       frames.front().media_time == head->begin && frames.back().media_time == head->end;
  const bool in_order =
      std::is_sorted(frames.begin(), frames.end(),
                     [](const RecordingFrame& a, const RecordingFrame& b) { return a.media_time < b.media_time; });
  if (!as_said || !in_order) return malformed("the frames of a chunk do not match its head");
  return frames;
}

Result<std::vector<SoundPacket>> read_sound_chunk(Bytes bytes) {
  const auto head = checked_head(bytes, ChunkKind::sound);
  if (!head) return head.error();
  auto packets = messages_of<SoundPacket>(bytes, *head);
  if (!packets) return packets;
  const bool in_order =
      std::is_sorted(packets->begin(), packets->end(),
                     [](const SoundPacket& a, const SoundPacket& b) { return a.media_time < b.media_time; });
  if (!in_order) return malformed("the packets of a chunk are not in the order of their times");
  const bool as_said = packets->size() == head->frames && packets->front().media_time == head->begin &&
                       packets->back().media_time == head->end;
  if (!as_said) return malformed("the packets of a chunk do not match its head");
  return packets;
}

Result<std::vector<SpeechText>> read_text_chunk(Bytes bytes) {
  const auto head = checked_head(bytes, ChunkKind::text);
  if (!head) return head.error();
  auto texts = messages_of<SpeechText>(bytes, *head);
  if (!texts) return texts;
  const bool as_said = texts->size() == head->frames && extremes(*texts) == std::pair(head->begin, head->end);
  if (!as_said) return malformed("the texts of a chunk do not match its head");
  return texts;
}

}  // namespace semblante::recordings
