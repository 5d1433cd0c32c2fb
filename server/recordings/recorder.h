#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "server/recordings/recording_writer.h"
#include "server/store/database_facts.h"
#include "server/store/pending_writes.h"
#include "server/store/recording_store.h"
#include "server/streams/batch_listener.h"

namespace semblante::recordings {

struct RecorderLimits {
  std::size_t max_recordings = 1000;                         ///< number of stored recordings
  std::size_t max_running = 64;                              ///< number of recordings running at the same time
  std::uint64_t max_bytes = std::uint64_t{256} << 20U;       ///< size of one recording
  std::uint64_t max_total_bytes = std::uint64_t{16} << 30U;  ///< of all recordings together
  std::uint64_t disk_reserve = std::uint64_t{256} << 20U;    ///< bytes that recordings leave free on the disk
  std::size_t queued_frames = 8192;                          ///< per recording, waiting to be written; also packets
  std::chrono::milliseconds flush_interval{500};             ///< time until received frames are durable
};

/// Reasons for the end of a recording, as in RecordingRecord::ended.
namespace ended {
inline constexpr std::string_view stopped = "stopped";  ///< by a request
inline constexpr std::string_view stream_ended = "stream-ended";
inline constexpr std::string_view max_duration = "max-duration";  ///< the requested duration, or one day
inline constexpr std::string_view max_bytes = "max-bytes";
inline constexpr std::string_view max_total_bytes = "max-total-bytes";
inline constexpr std::string_view max_token_bytes = "max-token-bytes";  ///< of what the owner may store
inline constexpr std::string_view disk_full = "disk-full";              ///< the disk is full, nearly full, or failed
inline constexpr std::string_view server_stopped = "server-stopped";
inline constexpr std::string_view server_killed = "server-killed";  ///< the durable part is kept
inline constexpr std::string_view damaged = "damaged";              ///< found damaged at a start
}  // namespace ended

/// The current state of a recording.
struct RecordingStatus {
  store::RecordingRecord record;  ///< while the recording runs, with the counts of its durable part
  std::uint64_t dropped = 0;      ///< frames dropped because the disk was too slow
};

/// The parameters of a new recording.
struct RecordingStart {
  Header header;  ///< the stream's current header
  std::string name;
  std::optional<std::uint64_t> max_duration;  ///< ms
  std::string owner = {};                     ///< see store::Origin
  /// Asked before frames are made durable, on the recorder's thread; false ends the recording. Empty: always true.
  std::function<bool()> has_room = {};
};

struct RecorderCounts {
  std::uint64_t running = 0, frames = 0, dropped = 0, bytes = 0, failed = 0;
};

/// Records streams: listens to their batches and writes them on its own thread. Sources never wait: batches are queued,
/// and when the disk is too slow they are dropped, counted, and leave a gap in the recording; so is sound, uncounted.
/// Any thread; all calls except the listener's may wait for the disk.
class Recorder : public streams::BatchListener {
 public:
  /// Files are `folder`/<id>.srec. Recordings that an earlier process left running are truncated after their last
  /// complete chunk and finished; on a full disk, or without their folder, later. `store`, `facts` and `pending`
  /// outlive it.
  static std::shared_ptr<Recorder> open(store::RecordingStore& store, store::DatabaseFacts& facts,
                                        store::PendingWrites& pending, std::filesystem::path folder,
                                        RecorderLimits limits = {});
  ~Recorder() override;
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Starts a recording; durable when this returns, and every later batch is in it. Errors: too_large (a limit; the
  /// message names it), io. Throws DiskFull, also while the disk is nearly full, and StoreError.
  Result<store::RecordingRecord> start(RecordingStart start, std::optional<store::IdempotencyRecord> key);
  /// Ends a recording, and returns when all of it is durable. Does nothing when it has ended; nullopt when it does not
  /// exist. The state is still `recording` when its end cannot be stored yet and is a pending write.
  std::optional<store::RecordingRecord> stop(std::string_view id);
  /// Refuses new recordings from now on; a recording whose stream ends has ended because the server stops.
  void begin_closing();
  /// begin_closing(), ends all recordings and returns when they are durable; streams may still call the listener.
  void close();

  [[nodiscard]] std::optional<RecordingStatus> find(std::string_view id) const;
  /// Adds the current counts to a record from the store, if it runs.
  [[nodiscard]] RecordingStatus with_progress(store::RecordingRecord record) const;
  /// Ends and removes a recording. False when it does not exist. Throws StoreError.
  bool remove(std::string_view id);
  [[nodiscard]] std::filesystem::path path_of(std::string_view id) const;
  [[nodiscard]] RecorderCounts counts() const;
  /// Bytes of running recordings of an owner that the store does not know yet.
  [[nodiscard]] std::uint64_t unstored_bytes(std::string_view owner) const;
  [[nodiscard]] const RecorderLimits& limits() const { return limits_; }

  void taken(std::string_view stream, std::uint64_t epoch, const Frames& batch) override;
  void heard(std::string_view stream, std::uint64_t epoch, const SoundPacket& sound) override;
  void said(std::string_view stream, std::uint64_t epoch, const SpeechText& text) override;
  void ended(std::string_view stream) override;

 private:
  using Clock = std::chrono::steady_clock;
  /// What waits to be written.
  struct Queue {
    std::deque<std::shared_ptr<const Frames>> batches;
    std::vector<std::shared_ptr<const SoundPacket>> sound;
    std::vector<std::shared_ptr<const SpeechText>> texts;
    [[nodiscard]] bool empty() const { return batches.empty() && sound.empty() && texts.empty(); }
  };
  struct Running {
    store::RecordingRecord record;
    std::unique_ptr<RecordingWriter> writer;         ///< used only by the recorder's thread
    std::optional<Clock::time_point> waiting_since;  ///< thread only: since when frames are not durable
    std::optional<Clock::time_point> ends;
    std::function<bool()> has_room;  ///< thread only
    std::uint64_t stored_bytes = 0;  ///< in the store's record; never changes
    // Guarded by the mutex:
    Queue queue;
    std::size_t queued_frames = 0;
    std::uint64_t dropped = 0;
    std::string stop_reason;  ///< empty: running
    bool done = false;
  };

  Recorder(store::RecordingStore& store, store::DatabaseFacts& facts, store::PendingWrites& pending,
           std::filesystem::path folder, RecorderLimits limits);
  void repair();
  void repair(const std::string& id);
  void run();
  /// Writes the queued batches; returns the reason why the recording must end, or "".
  std::string_view write(Running& running, const Queue& queue, bool flush);
  /// Add what is queued to the file; return the reason as above.
  std::string_view write_sound(Running& running, const Queue& queue);
  std::string_view write_texts(Running& running, const Queue& queue);
  std::string_view write_batch(Running& running, const Frames& batch);
  static std::string_view write_failure(const Running& running, const Error& error);
  std::string_view beyond_a_limit(const Running& running) const;
  void finish(Running& running, std::string reason);
  /// Queues something that came beside the frames.
  template <class Message>
  void queue(std::string_view stream, std::uint64_t epoch, const Message& message,
             std::vector<std::shared_ptr<const Message>> Queue::*to);
  /// Keeps the record of a recording that has ended, which is shown as running until its end is durable.
  void keep_shown(store::RecordingRecord record);
  void forget_shown(const std::string& id);
  [[nodiscard]] std::optional<Error> refusal() const;
  void publish_progress(Running& running);

  store::RecordingStore& store_;
  store::DatabaseFacts& facts_;
  store::PendingWrites& pending_;
  const std::filesystem::path folder_;
  const RecorderLimits limits_;
  std::atomic<std::size_t> running_count_ = 0;  ///< lets streams without a recording skip the mutex
  std::atomic<std::uint64_t> total_bytes_ = 0;  ///< of all files
  std::atomic<std::uint64_t> frames_ = 0, dropped_ = 0, failed_ = 0;
  std::mutex starting_;  ///< serializes start(); locked before mutex_
  mutable std::mutex mutex_;
  std::condition_variable work_, done_;
  std::map<std::string, std::shared_ptr<Running>, std::less<>> running_;
  std::map<std::string, store::RecordingRecord, std::less<>> unrecorded_;  ///< ended, but not durable yet
  bool has_work_ = false;
  bool closing_ = false;   ///< refuses new recordings
  bool stopping_ = false;  ///< the thread ends when no recording runs
  std::thread thread_;
};

}  // namespace semblante::recordings
