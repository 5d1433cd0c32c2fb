#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "core/types/result.h"
#include "server/jobs/process_limits.h"

namespace semblante::jobs {

/// How a worker process ended.
struct WorkerExit {
  enum class Kind {
    exited,     ///< exited with `code`
    signalled,  ///< by signal number `code`
    cancelled,  ///< killed, because the poll returned cancel
    timed_out,  ///< killed at the limit of elapsed time
    stopped     ///< killed, because the poll returned stop
  } kind = Kind::exited;
  int code = 0;
  std::string last_words;  ///< the end of its standard error
};

/// The caller's decision about the running worker, polled a few times per second.
enum class Wish { go_on, cancel, stop };

/// Runs `arguments[0]` with these arguments, `input` on its standard input, and passes on each line of its standard
/// output as it arrives. Blocks until the process has ended. Cancel is SIGTERM, and SIGKILL two seconds later; stop is
/// SIGKILL immediately. The process has its own group, so that a Ctrl-C at the terminal reaches only the server.
/// `limits`: of a program that does not limit itself, in force before it gets its input. A process that cannot be
/// started for want of descriptors, processes or memory is tried again until `wall_limit`. Error `io` when it cannot be
/// started.
Result<WorkerExit> run_worker_process(const std::vector<std::string>& arguments, std::string_view input,
                                      const std::filesystem::path& error_file, std::chrono::seconds wall_limit,
                                      const std::function<void(std::string_view line)>& on_line,
                                      const std::function<Wish()>& poll_wish,
                                      const std::optional<WorkerLimits>& limits = std::nullopt);

/// This program as it runs, to start it again as a worker: also when an update has put another file in its place, whose
/// workers could understand jobs otherwise.
inline constexpr const char* running_program = "/proc/self/exe";

/// Where the file of this program is, and what is installed beside it.
std::string own_executable();

}  // namespace semblante::jobs
