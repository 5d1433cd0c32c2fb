#include "server/recordings/recording_writer.h"

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <limits>
#include <string>
#include <unistd.h>
#include <utility>

#include "server/recordings/recording_reader.h"
#include "server/store/descriptor.h"
#include "server/store/store_error.h"

namespace semblante::recordings {
namespace {

Error io_error(const std::string& what) { return {ErrorCode::io, "", what + ": " + std::strerror(errno)}; }

Status write_at(int descriptor, std::uint64_t offset, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const auto wrote = ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) return io_error("a recording cannot be written");
    offset += static_cast<std::uint64_t>(wrote);
    bytes = bytes.subspan(static_cast<std::size_t>(wrote));
  }
  return Unit{};
}

}  // namespace

RecordingWriter::RecordingWriter(int descriptor, std::uint64_t bytes) : descriptor_(descriptor) {
  durable_.bytes = bytes;
}

RecordingWriter::~RecordingWriter() { ::close(descriptor_); }

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::create(const std::filesystem::path& path,
                                                                 const Header& header) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0) {
    store::throw_if_disk_full(path, errno);
    return io_error(path.string());
  }
  const auto beginning = encode_beginning(header);
  std::unique_ptr<RecordingWriter> writer(new RecordingWriter(descriptor, beginning.size()));
  auto status = write_at(descriptor, 0, beginning);
  if (status && ::fsync(descriptor) != 0) status = io_error(path.string());
  if (status && !store::sync_folder(path.parent_path())) status = io_error(path.parent_path().string());
  if (!status) {
    const int error_number = errno;
    ::unlink(path.c_str());
    store::throw_if_disk_full(path, error_number);
    return status.error();
  }
  return Result<std::unique_ptr<RecordingWriter>>(std::move(writer));
}

Status RecordingWriter::add(const Frames& batch) {
  std::uint64_t sequence = batch.sequence;
  for (const auto& frame : batch.frames) {
    const bool is_first = last_sequence_ == 0;
    if (!is_first && sequence <= last_sequence_) {
      assert(false && "the numbers of a stream rise within an epoch");
      ++sequence;
      continue;
    }
    const std::uint64_t missing = is_first ? 0 : sequence - last_sequence_ - 1;
    if (missing != 0 || waiting_.size() == max_chunk_frames) {
      if (auto status = flush(); !status) return status;
      lost_before_ = static_cast<std::uint32_t>(std::min<std::uint64_t>(missing, UINT32_MAX));
    }
    const std::uint64_t time = std::max(last_time_, batch.media_time + frame.time);
    if (is_first) begin_at(time);
    if (time - first_time_ > max_recording_ms)
      return Error{ErrorCode::out_of_range, "", "a recording is limited to one day"};
    waiting_.push_back({sequence, time, frame.state});
    last_sequence_ = sequence++;
    last_time_ = time;
  }
  return Unit{};
}

void RecordingWriter::begin_at(std::uint64_t media_time) {
  first_time_ = media_time;
  const auto first = std::find_if(waiting_sound_.begin(), waiting_sound_.end(),
                                  [&](const SoundPacket& sound) { return sound.media_time >= media_time; });
  drop_sound(static_cast<std::size_t>(first - waiting_sound_.begin()));
  drop_texts_before(media_time);
}

void RecordingWriter::drop_texts_before(std::uint64_t media_time) {
  std::erase_if(waiting_texts_, [&](const SpeechText& text) { return text.media_time < media_time; });
  waiting_text_bytes_ = 0;
  for (const auto& text : waiting_texts_) waiting_text_bytes_ += text_message_bytes(text);
}

void RecordingWriter::drop_sound(std::size_t count) {
  const auto end = waiting_sound_.begin() + static_cast<std::ptrdiff_t>(count);
  for (auto one = waiting_sound_.begin(); one != end; ++one) waiting_sound_bytes_ -= sound_message_bytes(*one);
  waiting_sound_.erase(waiting_sound_.begin(), end);
}

Status RecordingWriter::add(const SoundPacket& sound) {
  const bool has_begun = last_sequence_ != 0;
  const auto earliest = has_begun ? std::max(first_time_, last_sound_time_) : last_sound_time_;
  if (sound.media_time < earliest) return Unit{};
  if (has_begun && sound.media_time - first_time_ > max_recording_ms) return Unit{};  // the frames end the recording
  if (waiting_sound_.size() == max_chunk_frames ||
      waiting_sound_bytes_ + sound_message_bytes(sound) > max_sound_chunk_bytes) {
    if (!has_begun)
      drop_sound(waiting_sound_.size() / 2 + 1);
    else if (auto status = flush(); !status)
      return status;
  }
  waiting_sound_.push_back(sound);
  waiting_sound_bytes_ += sound_message_bytes(sound);
  last_sound_time_ = sound.media_time;
  return Unit{};
}

Status RecordingWriter::add(const SpeechText& text) {
  const bool has_begun = last_sequence_ != 0;
  if (has_begun && (text.media_time < first_time_ || text.media_time - first_time_ > max_recording_ms)) return Unit{};
  if (waiting_texts_.size() == max_chunk_frames ||
      waiting_text_bytes_ + text_message_bytes(text) > max_text_chunk_bytes) {
    if (!has_begun) {
      waiting_texts_.clear();  // a recording of a stream without frames
      waiting_text_bytes_ = 0;
    } else if (auto status = flush(); !status) {
      return status;
    }
  }
  waiting_texts_.push_back(text);
  waiting_text_bytes_ += text_message_bytes(text);
  return Unit{};
}

Status RecordingWriter::flush() {
  if (broken_) return Error{ErrorCode::io, "", "the recording cannot be written any more"};
  if (last_sequence_ == 0 || (waiting_.empty() && waiting_sound_.empty() && waiting_texts_.empty())) return Unit{};
  std::vector<std::uint8_t> chunks;
  if (!waiting_.empty()) chunks = encode_chunk(waiting_, lost_before_);
  if (!waiting_sound_.empty()) {
    const auto sound = encode_sound_chunk(waiting_sound_);
    chunks.insert(chunks.end(), sound.begin(), sound.end());
  }
  if (!waiting_texts_.empty()) {
    const auto texts = encode_text_chunk(waiting_texts_);
    chunks.insert(chunks.end(), texts.begin(), texts.end());
  }
  auto status = write_at(descriptor_, durable_.bytes, chunks);
  if (status && ::fdatasync(descriptor_) != 0) status = io_error("a recording cannot be made durable");
  if (!status) {
    // After a failed sync it is unknown what is durable: only what was durable before counts.
    broken_ = true;
    if (::ftruncate(descriptor_, static_cast<off_t>(durable_.bytes)) == 0) ::fdatasync(descriptor_);
    return status;
  }
  durable_.bytes += chunks.size();
  durable_.sound_packets += waiting_sound_.size();
  drop_sound(waiting_sound_.size());
  waiting_texts_.clear();
  waiting_text_bytes_ = 0;
  if (waiting_.empty()) return Unit{};
  durable_.frames += waiting_.size();
  durable_.lost += lost_before_;
  durable_.media_time = first_time_;
  durable_.duration = static_cast<std::uint32_t>(waiting_.back().media_time - first_time_);
  durable_.sequence = waiting_.back().sequence;
  waiting_.clear();
  lost_before_ = 0;
  return Unit{};
}

Result<RecordingProgress> repair_recording(const std::filesystem::path& path) {
  auto bytes = open_bytes(path);
  if (!bytes) return bytes.error();
  const auto reader = RecordingReader::open(*bytes, Check::everything);
  if (!reader) return reader.error();
  if (reader->torn_bytes() > max_written_at_once)
    return Error{ErrorCode::mismatch, "byte " + std::to_string(reader->whole_bytes()),
                 reader->torn_reason() + ", and more follows"};
  if (reader->torn_bytes() > 0) {
    const store::Descriptor file(path, O_RDWR);
    const bool cut = file.ok() && ::ftruncate(file.get(), static_cast<off_t>(reader->whole_bytes())) == 0 &&
                     ::fsync(file.get()) == 0;
    if (!cut) {
      store::throw_if_disk_full(path, errno);
      return store::io_error(path);
    }
  }
  RecordingProgress progress;
  progress.frames = reader->frames();
  progress.lost = reader->lost();
  progress.bytes = reader->whole_bytes();
  progress.sound_packets = reader->sound_packets();
  progress.media_time = reader->begin();
  progress.duration = reader->duration();
  if (const auto last = reader->at(reader->duration()); last && *last) progress.sequence = (*last)->sequence;
  return progress;
}

}  // namespace semblante::recordings
