#include "server/recordings/recorder.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "server/log/guard.h"
#include "server/log/log.h"
#include "server/store/data_files.h"

namespace semblante::recordings {
namespace {

constexpr std::size_t page = 200;

void take_over(store::RecordingRecord& record, const RecordingProgress& progress) {
  record.duration = progress.duration;
  record.frames = progress.frames;
  record.lost = progress.lost;
  record.bytes = progress.bytes;
  record.media_time = progress.media_time;
  record.sound_packets = progress.sound_packets;
}

}  // namespace

Recorder::Recorder(store::RecordingStore& store, store::DatabaseFacts& facts, store::PendingWrites& pending,
                   std::filesystem::path folder, RecorderLimits limits)
    : store_(store), facts_(facts), pending_(pending), folder_(std::move(folder)), limits_(limits) {}

std::shared_ptr<Recorder> Recorder::open(store::RecordingStore& store, store::DatabaseFacts& facts,
                                         store::PendingWrites& pending, std::filesystem::path folder,
                                         RecorderLimits limits) {
  std::shared_ptr<Recorder> recorder(new Recorder(store, facts, pending, std::move(folder), limits));
  pending.write(recorder.get(), "the folder of recordings", "the folder for recordings",
                [&path = recorder->folder_] { store::make_folder(path); });
  recorder->repair();
  recorder->thread_ = std::thread([&self = *recorder] { log::keep_running("the recorder", [&self] { self.run(); }); });
  return recorder;
}

Recorder::~Recorder() { close(); }

void Recorder::repair() {
  std::string after;
  while (true) {
    const auto records = store_.recordings("", after, page);
    if (!records || records->empty()) break;
    after = records->back().id;
    for (const auto& record : *records) {
      if (record.state == store::RecordingState::recording) {
        keep_shown(record);
        pending_.write(this, "recording " + record.id, "the repair of recording " + record.id,
                       [this, id = record.id] { repair(id); });
      }
      total_bytes_ += record.bytes;
    }
  }
}

void Recorder::repair(const std::string& id) {
  store::RecordingRecord record;
  {
    const std::lock_guard lock(mutex_);
    const auto found = unrecorded_.find(id);
    if (found == unrecorded_.end()) return;  // removed meanwhile
    record = found->second;
  }
  store::make_folder(folder_);  // without it the file is not missing, but behind what is in the folder's place
  const auto progress = repair_recording(path_of(id));
  if (progress) {
    total_bytes_ += progress->bytes - record.bytes;
    take_over(record, *progress);
    keep_shown(record);
    record.state = store::RecordingState::finished;
    record.ended = ended::server_killed;
  } else {
    record.state = store::RecordingState::broken;
    record.ended = ended::damaged;
  }
  store_.finish_recording(record);
  forget_shown(id);
  if (progress)
    log::info("recording " + record.id + ": finished with the " + std::to_string(record.frames) +
              " frames that were on the disk when the server was killed");
  else
    log::warning("recording " + record.id + " is damaged: " + progress.error().where + ": " + progress.error().message);
}

std::filesystem::path Recorder::path_of(std::string_view id) const { return folder_ / store::recording_file_name(id); }

std::optional<Error> Recorder::refusal() const {
  const auto full = [](std::string message) { return Error{ErrorCode::too_large, "", std::move(message)}; };
  if (store_.recording_count() >= limits_.max_recordings)
    return full("the server has reached its limit of " + std::to_string(limits_.max_recordings) +
                " recordings: delete some");
  if (running_count_ >= limits_.max_running)
    return full("the server has reached its limit of " + std::to_string(limits_.max_running) +
                " recordings at the same time");
  if (total_bytes_ >= limits_.max_total_bytes)
    return full("the recordings have reached their limit of " + std::to_string(limits_.max_total_bytes) + " bytes");
  if (store::free_bytes(folder_) < limits_.disk_reserve)
    throw store::NotEnoughRoom("the disk has less free than the " + std::to_string(limits_.disk_reserve) +
                               " bytes that recordings leave");
  return std::nullopt;
}

Result<store::RecordingRecord> Recorder::start(RecordingStart start, std::optional<store::IdempotencyRecord> key) {
  const std::lock_guard one_at_a_time(starting_);
  if (auto error = refusal()) return *error;
  auto running = std::make_shared<Running>();
  auto& record = running->record;
  record.id = store::random_id();
  record.stream = start.header.stream;
  record.name = std::move(start.name);
  record.model = start.header.model;
  record.created = store::timestamp_now();
  record.epoch = start.header.epoch;
  record.max_duration = start.max_duration;
  if (record.max_duration) running->ends = Clock::now() + std::chrono::milliseconds(*record.max_duration);
  auto writer = RecordingWriter::create(path_of(record.id), start.header);
  if (!writer) return writer.error();
  running->writer = std::move(*writer);
  take_over(record, running->writer->durable());
  record.owner = std::move(start.owner);
  running->has_room = std::move(start.has_room);
  running->stored_bytes = record.bytes;
  if (key) key->resource = record.id;
  // The file is made first, so that a record never refers to a missing file. The next start moves a file without a
  // record into the trash.
  const auto path = path_of(record.id);
  std::error_code ignored;
  try {
    store_.create_recording(record, key);
  } catch (...) {
    std::filesystem::remove(path, ignored);
    throw;
  }
  const std::lock_guard lock(mutex_);
  if (closing_) {
    // If this fails too, the next start reports a recording without a file as damaged.
    std::filesystem::remove(path, ignored);
    store_.remove_recording(record.id);
    return Error{ErrorCode::io, "", "the server is shutting down"};
  }
  total_bytes_ += record.bytes;
  running_.emplace(record.id, running);
  ++running_count_;
  has_work_ = true;
  work_.notify_one();
  return record;
}

std::optional<store::RecordingRecord> Recorder::stop(std::string_view id) {
  {
    std::unique_lock lock(mutex_);
    if (const auto found = running_.find(id); found != running_.end()) {
      const auto running = found->second;
      if (running->stop_reason.empty()) running->stop_reason = ended::stopped;
      has_work_ = true;
      work_.notify_one();
      done_.wait(lock, [&] { return running->done; });
    }
  }
  auto recording = find(id);
  if (!recording) return std::nullopt;
  return std::move(recording->record);
}

void Recorder::begin_closing() {
  const std::lock_guard lock(mutex_);
  closing_ = true;
}

void Recorder::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = stopping_ = has_work_ = true;
    for (const auto& [id, running] : running_)
      if (running->stop_reason.empty()) running->stop_reason = ended::server_stopped;
  }
  work_.notify_one();
  if (thread_.joinable()) thread_.join();
  pending_.release(this);
}

RecordingStatus Recorder::with_progress(store::RecordingRecord record) const {
  const std::lock_guard lock(mutex_);
  if (const auto found = running_.find(record.id); found != running_.end())
    return {found->second->record, found->second->dropped};
  if (const auto found = unrecorded_.find(record.id); found != unrecorded_.end()) return {found->second, 0};
  return {std::move(record), 0};
}

std::optional<RecordingStatus> Recorder::find(std::string_view id) const {
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = running_.find(id); found != running_.end())
      return RecordingStatus{found->second->record, found->second->dropped};
    if (const auto found = unrecorded_.find(id); found != unrecorded_.end()) return RecordingStatus{found->second, 0};
  }
  auto record = store_.recording(id);
  if (!record) return std::nullopt;
  return RecordingStatus{std::move(*record), 0};
}

bool Recorder::remove(std::string_view id) {
  if (!find(id)) return false;
  pending_.with_reserve([&] { facts_.check_writable(); });  // checks the disk before the recording is ended
  const auto record = stop(id);
  if (!record || !pending_.with_reserve([&] { return store_.remove_recording(id); })) return false;
  forget_shown(std::string(id));
  std::error_code ignored;
  std::filesystem::remove(path_of(id), ignored);
  total_bytes_ -= record->bytes;
  return true;
}

RecorderCounts Recorder::counts() const {
  return {running_count_.load(), frames_.load(), dropped_.load(), total_bytes_.load(), failed_.load()};
}

std::uint64_t Recorder::unstored_bytes(std::string_view owner) const {
  const std::lock_guard lock(mutex_);
  std::uint64_t bytes = 0;
  for (const auto& [id, running] : running_)
    if (running->record.owner == owner) bytes += running->record.bytes - running->stored_bytes;
  return bytes;
}

// ---- the streams' side ------------------------------------------------------------------------------------------

void Recorder::taken(std::string_view stream, std::uint64_t epoch, const Frames& batch) {
  if (running_count_ == 0) return;
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const Frames> copy;
  for (const auto& [id, running] : running_) {
    if (running->record.stream != stream || running->record.epoch != epoch || !running->stop_reason.empty()) continue;
    if (running->queued_frames + batch.frames.size() > limits_.queued_frames) {
      running->dropped += batch.frames.size();
      dropped_ += batch.frames.size();
      continue;
    }
    if (!copy) copy = std::make_shared<const Frames>(batch);
    running->queue.batches.push_back(copy);
    running->queued_frames += batch.frames.size();
  }
  if (!copy || has_work_) return;
  has_work_ = true;
  work_.notify_one();
}

template <class Message>
void Recorder::queue(std::string_view stream, std::uint64_t epoch, const Message& message,
                     std::vector<std::shared_ptr<const Message>> Queue::*to) {
  if (running_count_ == 0) return;
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const Message> copy;
  for (const auto& [id, running] : running_) {
    if (running->record.stream != stream || running->record.epoch != epoch || !running->stop_reason.empty()) continue;
    auto& waiting = running->queue.*to;
    if (waiting.size() >= limits_.queued_frames) continue;
    if (!copy) copy = std::make_shared<const Message>(message);
    waiting.push_back(copy);
  }
  if (!copy || has_work_) return;
  has_work_ = true;
  work_.notify_one();
}

void Recorder::heard(std::string_view stream, std::uint64_t epoch, const SoundPacket& sound) {
  queue(stream, epoch, sound, &Queue::sound);
}

void Recorder::said(std::string_view stream, std::uint64_t epoch, const SpeechText& text) {
  queue(stream, epoch, text, &Queue::texts);
}

void Recorder::ended(std::string_view stream) {
  if (running_count_ == 0) return;
  const std::lock_guard lock(mutex_);
  for (const auto& [id, running] : running_)
    if (running->record.stream == stream && running->stop_reason.empty())
      running->stop_reason = closing_ ? ended::server_stopped : ended::stream_ended;
  has_work_ = true;
  work_.notify_one();
}

// ---- the thread -------------------------------------------------------------------------------------------------

void Recorder::run() {
  std::unique_lock lock(mutex_);
  auto next_flush = Clock::now();
  while (true) {
    work_.wait_until(lock, next_flush, [this] { return has_work_ || stopping_; });
    if (stopping_ && running_.empty()) return;
    has_work_ = false;
    std::vector<std::shared_ptr<Running>> all;
    for (const auto& [id, running] : running_) all.push_back(running);
    for (const auto& running : all) {
      const Queue queue = std::exchange(running->queue, {});
      running->queued_frames = 0;
      std::string reason = running->stop_reason;
      lock.unlock();
      const auto now = Clock::now();
      if (!running->waiting_since && !queue.empty()) running->waiting_since = now;
      if (reason.empty() && running->ends && now >= *running->ends) reason = ended::max_duration;
      const bool flush =
          !reason.empty() || (running->waiting_since && now - *running->waiting_since >= limits_.flush_interval);
      std::string_view must_end = ended::disk_full;  // replaced if the write succeeds
      log::guarded("recording " + running->record.id, [&] { must_end = write(*running, queue, flush); });
      if (!must_end.empty() && (reason.empty() || must_end == ended::disk_full)) reason = must_end;
      if (!reason.empty()) log::guarded("recording " + running->record.id, [&] { finish(*running, reason); });
      lock.lock();
      if (!reason.empty()) {
        running->done = true;
        running_.erase(running->record.id);
        --running_count_;
        done_.notify_all();
      }
    }
    next_flush = Clock::now() + (running_.empty() ? std::chrono::hours(1) : limits_.flush_interval / 2);
  }
}

std::string_view Recorder::write(Running& running, const Queue& queue, bool flush) {
  auto& writer = *running.writer;
  // Sound first: a chunk of frames that is full is written with the sound of its time. But a recording begins with its
  // first frame, from which the duration of the sound counts too.
  const bool has_begun = writer.first_media_time().has_value();
  std::string_view reason = has_begun ? write_sound(running, queue) : std::string_view();
  for (const auto& batch : queue.batches) {
    if (!reason.empty()) break;
    reason = write_batch(running, *batch);
  }
  if (!has_begun && reason.empty()) reason = write_sound(running, queue);
  if (reason.empty()) reason = write_texts(running, queue);
  if (flush || !reason.empty()) {
    running.waiting_since.reset();
    if (reason.empty() && running.has_room && !running.has_room()) reason = ended::max_token_bytes;
    if (const auto flushed = writer.flush(); !flushed) reason = write_failure(running, flushed.error());
    if (reason.empty() && store::free_bytes(folder_) < limits_.disk_reserve) reason = ended::disk_full;
  }
  publish_progress(running);
  return reason;
}

std::string_view Recorder::write_sound(Running& running, const Queue& queue) {
  auto& writer = *running.writer;
  for (const auto& sound : queue.sound) {
    if (const auto reason = beyond_a_limit(running); !reason.empty()) return reason;
    const auto first = writer.first_media_time();
    if (first && sound->media_time > *first + running.record.max_duration.value_or(max_recording_ms)) continue;
    if (const auto added = writer.add(*sound); !added) return write_failure(running, added.error());
  }
  return {};
}

std::string_view Recorder::write_texts(Running& running, const Queue& queue) {
  for (const auto& text : queue.texts) {
    if (const auto reason = beyond_a_limit(running); !reason.empty()) return reason;
    if (const auto added = running.writer->add(*text); !added) return write_failure(running, added.error());
  }
  return {};
}

std::string_view Recorder::write_batch(Running& running, const Frames& batch) {
  auto& writer = *running.writer;
  if (const auto reason = beyond_a_limit(running); !reason.empty()) return reason;
  const auto first = writer.first_media_time().value_or(batch.media_time);
  const auto last_time = first + running.record.max_duration.value_or(max_recording_ms);
  if (batch.media_time + batch.frames.back().time <= last_time) {
    const auto added = writer.add(batch);
    return added ? std::string_view() : write_failure(running, added.error());
  }
  Frames part = batch;
  std::erase_if(part.frames, [&](const TimedFrame& frame) { return batch.media_time + frame.time > last_time; });
  if (!part.frames.empty()) {
    if (const auto added = writer.add(part); !added) return write_failure(running, added.error());
  }
  return ended::max_duration;
}

std::string_view Recorder::write_failure(const Running& running, const Error& error) {
  if (error.code != ErrorCode::io) return ended::max_duration;
  log::error("recording " + running.record.id + ": " + error.message);
  return ended::disk_full;
}

std::string_view Recorder::beyond_a_limit(const Running& running) const {
  // What is written at once must fit, so that no limit is ever exceeded.
  if (running.writer->durable().bytes + max_written_at_once > limits_.max_bytes) return ended::max_bytes;
  if (total_bytes_ + max_written_at_once > limits_.max_total_bytes) return ended::max_total_bytes;
  return {};
}

void Recorder::publish_progress(Running& running) {
  const auto& progress = running.writer->durable();
  const std::lock_guard lock(mutex_);
  total_bytes_ += progress.bytes - running.record.bytes;
  frames_ += progress.frames - running.record.frames;
  take_over(running.record, progress);
}

void Recorder::finish(Running& running, std::string reason) {
  auto record = running.record;
  record.state = store::RecordingState::finished;
  record.ended = std::move(reason);
  if (record.ended == ended::disk_full) ++failed_;
  {
    const std::lock_guard lock(mutex_);
    record.lost = std::max(record.lost, running.dropped);  // frames dropped at the end are not counted in the file
  }
  auto shown = record;
  shown.state = store::RecordingState::recording;
  shown.ended.clear();
  keep_shown(std::move(shown));
  pending_.write(this, "recording " + record.id, "the end of recording " + record.id, [this, record] {
    store_.finish_recording(record);
    forget_shown(record.id);
  });
}

void Recorder::keep_shown(store::RecordingRecord record) {
  const std::lock_guard lock(mutex_);
  unrecorded_[record.id] = std::move(record);
}

void Recorder::forget_shown(const std::string& id) {
  const std::lock_guard lock(mutex_);
  unrecorded_.erase(id);
}

}  // namespace semblante::recordings
