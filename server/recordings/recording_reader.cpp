#include "server/recordings/recording_reader.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace semblante::recordings {
namespace {

constexpr double alone_ms = 40.0;

Error at_byte(std::uint64_t offset, Error error) {
  error.where = "byte " + std::to_string(offset);
  return error;
}

Result<std::vector<std::uint8_t>> read_chunk(const ByteSource& from, std::uint64_t offset, const ChunkHead& head) {
  std::vector<std::uint8_t> bytes(chunk_head_bytes + head.bytes);
  if (!from.read(offset, bytes)) return at_byte(offset, {ErrorCode::io, "", "cannot be read"});
  return bytes;
}

Status check_chunk(const ByteSource& from, std::uint64_t offset, const ChunkHead& head) {
  const auto bytes = read_chunk(from, offset, head);
  if (!bytes) return bytes.error();
  if (!has_right_checksum(*bytes)) return Error{ErrorCode::mismatch, "", "the checksum of the chunk is wrong"};
  return Unit{};
}

}  // namespace

Result<RecordingReader> RecordingReader::open(std::shared_ptr<const ByteSource> bytes, Check check) {
  RecordingReader reader;
  reader.bytes_ = std::move(bytes);
  std::array<std::uint8_t, file_magic.size()> magic{};
  if (!reader.bytes_->read(0, magic)) return Error{ErrorCode::truncated, "byte 0", "too short for a recording"};
  if (!std::equal(magic.begin(), magic.end() - 1, file_magic.begin()))
    return Error{ErrorCode::malformed, "byte 0", "not a recording of Semblante"};
  if (magic.back() < 1 || magic.back() > file_magic.back())
    return Error{ErrorCode::unsupported, "byte 7", "a recording of version " + std::to_string(magic.back())};
  const auto first = reader.chunk_at(file_magic.size());
  if (!first) return Error{ErrorCode::truncated, "byte 8", "the chunk with the stream's header is not whole"};
  const auto chunk = read_chunk(*reader.bytes_, first->offset, first->head);
  if (!chunk) return chunk.error();
  auto header = read_header_chunk(*chunk);
  if (!header) return at_byte(first->offset, header.error());
  reader.header_ = std::move(*header);
  reader.begin_ = reader.end_ = reader.header_.media_time;
  reader.first_chunk_ = reader.whole_bytes_ = first->offset + chunk->size();
  if (const auto torn = reader.walk(check)) reader.torn_reason_ = torn->message;
  return reader;
}

std::optional<Error> RecordingReader::walk(Check check) {
  while (whole_bytes_ < bytes_->size()) {
    std::array<std::uint8_t, chunk_head_bytes> start{};
    if (!bytes_->read(whole_bytes_, start)) return Error{ErrorCode::truncated, "", "the head of a chunk is cut off"};
    const auto head = read_chunk_head(start);
    if (!head) return head.error();
    const Chunk chunk{whole_bytes_, *head};
    const std::uint64_t end = whole_bytes_ + chunk_head_bytes + head->bytes;
    if (end > bytes_->size()) return Error{ErrorCode::truncated, "", "the chunk is cut off"};
    // A chunk of another kind is checked too: one of frames with a damaged kind must not be skipped.
    const auto taken = head->kind == ChunkKind::frames  ? add_frames(chunk, check)
                       : head->kind == ChunkKind::sound ? add_sound(chunk, check)
                       : head->kind == ChunkKind::text  ? add_texts(chunk, check)
                                                        : check_chunk(*bytes_, chunk.offset, *head);
    if (!taken) return taken.error();
    whole_bytes_ = end;
  }
  return std::nullopt;
}

Status RecordingReader::add_frames(const Chunk& chunk, Check check) {
  const auto& head = chunk.head;
  const bool follows = frames_ == 0 || (head.begin >= end_ && head.sequence == last_sequence_ + 1 + head.lost);
  if (!follows) return Error{ErrorCode::malformed, "", "a chunk does not follow the one before it"};
  if (head.end - (frames_ == 0 ? head.begin : begin_) > max_recording_ms)
    return Error{ErrorCode::out_of_range, "", "longer than a day"};
  if (check == Check::everything) {
    if (const auto frames = read(chunk); !frames) return frames.error();
  }
  if (frames_ == 0) begin_ = head.begin;
  end_ = head.end;
  frames_ += head.frames;
  lost_ += head.lost;
  last_sequence_ = head.sequence + head.frames - 1;
  index_.add(chunk);
  return Unit{};
}

Status RecordingReader::add_sound(const Chunk& chunk, Check check) {
  const auto& head = chunk.head;
  const bool follows = frames_ != 0 && head.begin >= begin_ && head.begin >= sound_end_;
  if (!follows) return Error{ErrorCode::malformed, "", "a chunk of sound does not follow those before it"};
  if (head.end - begin_ > max_recording_ms) return Error{ErrorCode::out_of_range, "", "longer than a day"};
  if (check == Check::everything) {
    if (const auto packets = read_sound(chunk); !packets) return packets.error();
  }
  sound_end_ = head.end;
  sound_packets_ += head.frames;
  sound_index_.add(chunk);
  return Unit{};
}

Status RecordingReader::add_texts(const Chunk& chunk, Check check) {
  if (frames_ == 0 || chunk.head.begin < begin_)
    return Error{ErrorCode::malformed, "", "a chunk of text is before the first frame"};
  if (check == Check::everything) {
    if (const auto texts = read_texts(chunk); !texts) return texts.error();
  }
  if (!first_texts_) first_texts_ = chunk;
  return Unit{};
}

void RecordingReader::Index::add(const Chunk& chunk) {
  if (chunks_++ % stride_ != 0) return;
  entries_.push_back({chunk.offset, chunk.head.begin});
  if (entries_.size() < max_index) return;
  for (std::size_t i = 0; 2 * i < entries_.size(); ++i) entries_[i] = entries_[2 * i];
  entries_.resize((entries_.size() + 1) / 2);
  stride_ *= 2;
}

double RecordingReader::mean_interval() const {
  return frames_ < 2 || end_ == begin_ ? alone_ms
                                       : static_cast<double>(end_ - begin_) / static_cast<double>(frames_ - 1);
}

std::optional<RecordingReader::Chunk> RecordingReader::chunk_at(std::uint64_t offset) const {
  std::array<std::uint8_t, chunk_head_bytes> start{};
  if (!bytes_->read(offset, start)) return std::nullopt;
  const auto head = read_chunk_head(start);
  if (!head || head->bytes > bytes_->size() - offset - chunk_head_bytes) return std::nullopt;
  return Chunk{offset, *head};
}

std::optional<RecordingReader::Chunk> RecordingReader::chunk_after(const Chunk& chunk) const {
  std::uint64_t offset = chunk.offset + chunk_head_bytes + chunk.head.bytes;
  while (offset < whole_bytes_) {
    const auto next = chunk_at(offset);
    if (!next || next->head.kind == chunk.head.kind) return next;
    offset += chunk_head_bytes + next->head.bytes;
  }
  return std::nullopt;
}

Result<std::vector<RecordingFrame>> RecordingReader::read(const Chunk& chunk) const {
  const auto bytes = read_chunk(*bytes_, chunk.offset, chunk.head);
  if (!bytes) return bytes.error();
  auto frames = read_frames_chunk(*bytes);
  if (!frames) return at_byte(chunk.offset, frames.error());
  return frames;
}

Result<std::vector<SoundPacket>> RecordingReader::read_sound(const Chunk& chunk) const {
  const auto bytes = read_chunk(*bytes_, chunk.offset, chunk.head);
  if (!bytes) return bytes.error();
  auto packets = read_sound_chunk(*bytes);
  if (!packets) return at_byte(chunk.offset, packets.error());
  return packets;
}

Result<std::vector<SpeechText>> RecordingReader::read_texts(const Chunk& chunk) const {
  const auto bytes = read_chunk(*bytes_, chunk.offset, chunk.head);
  if (!bytes) return bytes.error();
  auto texts = read_text_chunk(*bytes);
  if (!texts) return at_byte(chunk.offset, texts.error());
  return texts;
}

Result<std::vector<SpeechText>> RecordingReader::texts() const {
  std::vector<SpeechText> said;
  for (auto chunk = first_texts_; chunk; chunk = chunk_after(*chunk)) {
    auto texts = read_texts(*chunk);
    if (!texts) return texts;
    for (auto& text : *texts) {
      // Texts came a second before they were said; the end of a speech may have come before that.
      while (!said.empty() && said.back().media_time >= text.media_time) said.pop_back();
      said.push_back(std::move(text));
    }
  }
  std::erase_if(said, [this](const SpeechText& text) { return text.media_time > end_; });
  for (auto& text : said) text.media_time -= begin_;
  return said;
}

std::uint64_t RecordingReader::Index::offset_before(std::uint64_t media_time) const {
  const auto after = std::lower_bound(entries_.begin(), entries_.end(), media_time,
                                      [](const Entry& entry, std::uint64_t time) { return entry.begin < time; });
  return after == entries_.begin() ? entries_.front().offset : (after - 1)->offset;
}

Result<std::optional<RecordingFrame>> RecordingReader::at(std::uint32_t ms) const {
  if (frames_ == 0) return std::optional<RecordingFrame>();
  const std::uint64_t time = begin_ + ms;
  auto chunk = chunk_at(index_.offset_before(time));
  while (chunk) {
    const auto next = chunk_after(*chunk);
    if (!next || next->head.begin > time) break;
    chunk = next;
  }
  if (!chunk) return Error{ErrorCode::io, "", "the recording cannot be read any more"};
  const auto frames = read(*chunk);
  if (!frames) return frames.error();
  const auto after = std::upper_bound(frames->begin(), frames->end(), time,
                                      [](std::uint64_t t, const RecordingFrame& f) { return t < f.media_time; });
  assert(after != frames->begin() && "the chunk begins at or before the time");
  return std::optional<RecordingFrame>(*(after - 1));
}

RecordingCursor::RecordingCursor(std::shared_ptr<const RecordingReader> reader, std::uint32_t ms)
    : reader_(std::move(reader)) {
  if (reader_->frames() == 0) return;
  const std::uint64_t time = reader_->begin() + ms;
  auto chunk = reader_->chunk_at(reader_->index_.offset_before(time));
  while (chunk && chunk->head.end < time) chunk = reader_->chunk_after(*chunk);
  load(chunk);
  while (frame() != nullptr && frame()->media_time < time) ++next_;
}

void RecordingCursor::load(std::optional<RecordingReader::Chunk> chunk) {
  chunk_ = chunk;
  next_ = 0;
  frames_.clear();
  if (!chunk_) return;
  auto frames = reader_->read(*chunk_);
  if (frames)
    frames_ = std::move(*frames);
  else
    error_ = std::move(frames).error();
}

const RecordingFrame* RecordingCursor::frame() const { return next_ < frames_.size() ? &frames_[next_] : nullptr; }

std::uint32_t RecordingCursor::time() const {
  assert(frame() != nullptr);
  return static_cast<std::uint32_t>(frame()->media_time - reader_->begin());
}

void RecordingCursor::advance() {
  if (frame() == nullptr) return;
  if (++next_ == frames_.size()) load(reader_->chunk_after(*chunk_));
}

RecordingSoundCursor::RecordingSoundCursor(std::shared_ptr<const RecordingReader> reader, std::uint32_t ms)
    : reader_(std::move(reader)) {
  if (reader_->sound_index_.empty()) return;
  const std::uint64_t time = reader_->begin() + ms;
  auto chunk = reader_->chunk_at(reader_->sound_index_.offset_before(time));
  while (chunk && chunk->head.end < time) chunk = reader_->chunk_after(*chunk);
  load(chunk);
  while (packet() != nullptr && packet()->media_time < ms) ++next_;
}

void RecordingSoundCursor::load(std::optional<RecordingReader::Chunk> chunk) {
  chunk_ = chunk;
  next_ = 0;
  packets_.clear();
  if (!chunk_) return;
  auto packets = reader_->read_sound(*chunk_);
  if (!packets) {
    error_ = std::move(packets).error();
    return;
  }
  packets_ = std::move(*packets);
  for (auto& packet : packets_) packet.media_time -= reader_->begin();
}

const SoundPacket* RecordingSoundCursor::packet() const { return next_ < packets_.size() ? &packets_[next_] : nullptr; }

void RecordingSoundCursor::advance() {
  if (packet() == nullptr) return;
  if (++next_ == packets_.size()) load(reader_->chunk_after(*chunk_));
}

}  // namespace semblante::recordings
