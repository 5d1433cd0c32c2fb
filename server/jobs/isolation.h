#pragma once

#include <filesystem>
#include <string>

#include "core/types/result.h"
#include "server/jobs/landlock.h"

namespace semblante::jobs {

/// What holds a process to its job, beside the limits of memory, time and files.
struct Isolation {
  bool system_calls = false;  ///< the filter of system calls is in force: no sockets, processes, reading of other files
  int landlock = 0;           ///< version in force: no files outside the job's folder; 0: none

  [[nodiscard]] bool is_whole() const { return system_calls && landlock > 0; }
  bool operator==(const Isolation&) const = default;
};

/// The means to use; tests use them one by one.
struct IsolationMeans {
  bool system_calls = true;
  int highest_landlock = newest_landlock;  ///< 0: none
};

/// Takes from this process, for good, all that a job does not need: privileges by execve, the network, other processes,
/// every file except new ones in `folder` and open descriptors. A means that the system lacks or forbids is left out.
/// To be called in a process with one thread, when its input is open and before a byte of it is interpreted.
///
/// Builds with a sanitizer use none of the means: its runtime starts threads and reads files of /proc.
///
/// Errors: `internal`, `io`: a means that the system offers could not be used.
Result<Isolation> isolate_this_process(const std::filesystem::path& folder, IsolationMeans means = {});

/// Which means work on this system: a child process isolates itself as a worker does, and ends. To be called while this
/// process has one thread.
Isolation available_isolation(const std::filesystem::path& folder);

/// What is missing and what that means, as a sentence; empty if nothing is.
std::string missing_isolation(const Isolation& isolation);

}  // namespace semblante::jobs
