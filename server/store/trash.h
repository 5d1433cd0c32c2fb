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

/// Files of the data folder that the database does not know, until their time of grace is over: a batch for each start
/// that found some, trash/<UTC time>/, in which they have the paths they had in the data folder. A file comes and goes
/// by one rename within a file system, so it is in one place or the other whenever the process ends. What is in the
/// trash and was not put there by a server (other names, links) is left alone. One thread at a time; counts() any.
class Trash {
 public:
  using Time = std::chrono::system_clock::time_point;
  struct Counts {
    std::uint64_t files = 0, bytes = 0;
  };

  /// Counts what is there; makes no folder. `grace`: 0 keeps files until the start after the one that moved them.
  Trash(std::filesystem::path data, std::chrono::seconds grace, Time now = std::chrono::system_clock::now());

  /// Moves a file of the data folder here. Errors: io, e.g. a data folder that spans file systems; it stays then.
  Status put(DataFileKind kind, std::string_view name);
  /// Moves a file back to the data folder, the newest of the name. False when there is none here, or the data folder
  /// has something in its place. Errors: io.
  Result<bool> put_back(DataFileKind kind, std::string_view name);
  /// Makes what was moved durable.
  Status sync();

  /// Removes the files whose grace is over; what was removed. A stopped purge goes on with the next.
  Counts purge(Time now, const std::stop_token& stop);

  [[nodiscard]] Counts counts() const { return {files_.load(), bytes_.load()}; }
  /// Where put() of this object moves files; empty before the first.
  [[nodiscard]] const std::filesystem::path& batch() const { return batch_; }
  [[nodiscard]] std::chrono::seconds grace() const { return grace_; }

 private:
  /// Folders of the trash that servers made, newest first.
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
