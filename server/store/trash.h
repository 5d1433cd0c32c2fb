#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <set>
#include <stop_token>
#include <string_view>
#include <vector>

#include "core/types/result.h"
#include "server/store/data_files.h"

namespace semblante::store {

/// Files of the data folder that the database does not know, kept for a grace period. Each start that finds some makes
/// a batch, trash/<UTC time>/, in which the files keep their paths. A file is moved by one rename within a file system,
/// so a crash leaves it in one of the two places. Files that a server did not put into the trash (other names, links)
/// are not touched. One thread at a time; counts() any thread.
class Trash {
 public:
  using Time = std::chrono::system_clock::time_point;
  struct Counts {
    std::uint64_t files = 0, bytes = 0;
  };

  /// Counts the files in the trash; makes no folder. `grace` 0 keeps files until the start after the one that moved
  /// them.
  Trash(std::filesystem::path data, std::chrono::seconds grace, Time now = std::chrono::system_clock::now());

  /// Moves a file of the data folder into the trash. Errors: io, e.g. when the data folder spans file systems; the file
  /// is left in place then.
  Status put(DataFileKind kind, std::string_view name);
  /// Moves the newest file of this name back to the data folder. False when the trash has none, or the data folder has
  /// something in its place. Errors: io.
  Result<bool> put_back(DataFileKind kind, std::string_view name);
  /// Makes the moves durable.
  Status sync();

  /// Removes the files whose grace period is over and returns their counts. The next call continues a stopped purge.
  Counts purge(Time now, const std::stop_token& stop);

  [[nodiscard]] Counts counts() const { return {files_.load(), bytes_.load()}; }
  /// The batch into which put() moves files; empty before the first call.
  [[nodiscard]] const std::filesystem::path& batch() const { return batch_; }
  [[nodiscard]] std::chrono::seconds grace() const { return grace_; }

 private:
  /// The batches in the trash, newest first.
  [[nodiscard]] std::vector<std::filesystem::path> batches() const;
  Status make_batch();
  /// Renames and remembers the folders for sync().
  Status move(const std::filesystem::path& from, const std::filesystem::path& to);
  [[nodiscard]] bool is_over(const std::filesystem::path& batch, Time now) const;

  const std::filesystem::path data_;
  const std::chrono::seconds grace_;
  const Time start_;
  std::filesystem::path batch_;
  std::set<std::filesystem::path> touched_;
  std::atomic<std::uint64_t> files_ = 0, bytes_ = 0;
};

}  // namespace semblante::store
