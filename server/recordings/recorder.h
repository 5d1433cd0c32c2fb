#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "server/recordings/recording_writer.h"
#include "server/store/pending_writes.h"
#include "server/store/store.h"
#include "server/streams/batch_listener.h"

namespace semblante::recordings {

struct RecorderLimits {
  std::size_t max_recordings = 1000;                         ///< kept
  std::size_t max_running = 64;                              ///< at a time
  std::uint64_t max_bytes = std::uint64_t{256} << 20U;       ///< of one
  std::uint64_t max_total_bytes = std::uint64_t{16} << 30U;  ///< of all together
  std::uint64_t disk_reserve = std::uint64_t{256} << 20U;    ///< free bytes that recordings leave on the disk
  std::size_t queued_frames = 8192;                          ///< of one, on their way to the disk
  std::chrono::milliseconds flush_interval{500};             ///< after which frames that came are on the disk
};

/// Why a recording has ended, as RecordingRecord::ended.
namespace ended {
inline constexpr std::string_view stopped = "stopped";  ///< somebody asked
inline constexpr std::string_view stream_ended = "stream-ended";
inline constexpr std::string_view max_duration = "max-duration";  ///< that was asked for, or a day
inline constexpr std::string_view max_bytes = "max-bytes";
inline constexpr std::string_view max_total_bytes = "max-total-bytes";
inline constexpr std::string_view disk_full = "disk-full";  ///< or nearly, or it failed
inline constexpr std::string_view server_stopped = "server-stopped";
inline constexpr std::string_view server_killed = "server-killed";  ///< what was durable is there
inline constexpr std::string_view damaged = "damaged";              ///< found at a start
}  // namespace ended

/// A recording as it is now.
struct RecordingStatus {
  store::RecordingRecord record;  ///< of one that runs: with what is durable by now
  std::uint64_t dropped = 0;      ///< frames that came faster than the disk took them
};

/// What a recording begins with.
struct RecordingStart {
  Header header;  ///< the stream now
  std::string name;
  std::optional<std::uint64_t> max_duration;  ///< ms
};

struct RecorderCounts {
  std::uint64_t running = 0, frames = 0, dropped = 0, bytes = 0, failed = 0;
};

/// Records streams: hears their batches, and a thread of its own writes them. Whoever brings frames waits for nothing:
/// batches are queued, and when the disk does not keep up they are dropped, counted, and a gap in the recording. Any
/// thread; all but the listener's calls may wait for the disk.
class Recorder : public streams::BatchListener {
 public:
  /// Files are `folder`/<id>.srec. Recordings that a process left running are cut off after their last whole chunk and
  /// finished, on a full disk when it has room. Errors: io. `store` and `pending` outlive it.
  static Result<std::shared_ptr<Recorder>> open(store::Store& store, store::PendingWrites& pending,
                                                std::filesystem::path folder, RecorderLimits limits = {});
  ~Recorder() override;
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Begins a recording; when this returns, it is on the disk, and every batch from now on is in it. Errors: too_large
  /// (a limit; the message says which), io. Throws DiskFull, also while the disk is nearly full, and StoreError.
  Result<store::RecordingRecord> start(RecordingStart start, std::optional<store::IdempotencyRecord> key);
  /// Ends it, and returns when all of it is on the disk. One that has ended stays as it is; nothing when there is none.
  /// Still `recording` when the end cannot be recorded now: it is a pending write.
  std::optional<store::RecordingRecord> stop(std::string_view id);
  /// Ends all and lets no more begin; does not wait.
  void stop_all(std::string_view reason);
  /// The same, and waits; streams may go on calling.
  void close();

  [[nodiscard]] std::optional<RecordingStatus> find(std::string_view id) const;
  /// Of a record from the store: with what is known of it if it runs.
  [[nodiscard]] RecordingStatus with_progress(store::RecordingRecord record) const;
  /// Ends and removes it. False when there is none. Throws StoreError.
  bool remove(std::string_view id);
  [[nodiscard]] std::filesystem::path path_of(std::string_view id) const;
  [[nodiscard]] RecorderCounts counts() const;
  [[nodiscard]] const RecorderLimits& limits() const { return limits_; }

  void taken(std::string_view stream, std::uint64_t epoch, const Frames& batch) override;
  void ended(std::string_view stream) override;

 private:
  using Clock = std::chrono::steady_clock;
  struct Running {
    store::RecordingRecord record;
    std::unique_ptr<RecordingWriter> writer;         ///< the thread's own
    std::optional<Clock::time_point> waiting_since;  ///< the thread's own: frames that are not durable
    std::optional<Clock::time_point> ends;
    // With the mutex held:
    std::deque<std::shared_ptr<const Frames>> queue;
    std::size_t queued_frames = 0;
    std::uint64_t dropped = 0;
    std::string stop_reason;  ///< empty: it goes on
    bool done = false;
  };

  Recorder(store::Store& store, store::PendingWrites& pending, std::filesystem::path folder, RecorderLimits limits);
  Status repair();
  void repair(const std::string& id);
  void run();
  /// Writes what came; why the recording has to end, or nothing.
  std::string_view write(Running& running, const std::deque<std::shared_ptr<const Frames>>& batches, bool flush);
  std::string_view beyond_a_limit(const Running& running) const;
  void finish(Running& running, std::string reason);
  /// How a recording is shown that has ended, until this is durable: as one that runs.
  void keep_shown(store::RecordingRecord record);
  void forget_shown(const std::string& id);
  [[nodiscard]] std::optional<Error> refusal() const;
  void publish_progress(Running& running);

  store::Store& store_;
  store::PendingWrites& pending_;
  const std::filesystem::path folder_;
  const RecorderLimits limits_;
  std::atomic<std::size_t> running_count_ = 0;  ///< so that streams nobody records pay nothing
  std::atomic<std::uint64_t> total_bytes_ = 0;  ///< of all files
  std::atomic<std::uint64_t> frames_ = 0, dropped_ = 0, failed_ = 0;
  std::mutex starting_;  ///< one begins at a time; taken before mutex_
  mutable std::mutex mutex_;
  std::condition_variable work_, done_;
  std::map<std::string, std::shared_ptr<Running>, std::less<>> running_;
  std::map<std::string, store::RecordingRecord, std::less<>> unrecorded_;  ///< ended, which is not durable yet
  bool has_work_ = false;
  bool closing_ = false;   ///< no more begin
  bool stopping_ = false;  ///< the thread ends when none runs
  std::thread thread_;
};

}  // namespace semblante::recordings
