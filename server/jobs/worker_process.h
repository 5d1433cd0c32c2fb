#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "core/types/result.h"

namespace semblante::jobs {

/// How a worker process ended.
struct WorkerExit {
  enum class Kind {
    exited,     ///< by itself, with `code`
    signalled,  ///< by signal number `code`
    cancelled,  ///< by us, because the poll said cancel
    timed_out,  ///< by us, because the wall clock limit was over
    stopped     ///< by us, because the poll said stop
  } kind = Kind::exited;
  int code = 0;
  std::string last_words;  ///< the end of its standard error
};

/// What the caller wants of the running worker, asked a few times a second.
enum class Wish { go_on, cancel, stop };

/// Runs `arguments[0]` with these arguments, `input` on its standard input, and hands over each line of its standard
/// output as it comes. Blocks until the process is gone. Cancel is SIGTERM, and SIGKILL two seconds later; stop is
/// SIGKILL at once. The process has its own group, so that a Ctrl-C at the terminal reaches the server alone. Error
/// `io` when it cannot be started.
Result<WorkerExit> run_worker_process(const std::vector<std::string>& arguments, std::string_view input,
                                      const std::filesystem::path& error_file, std::chrono::seconds wall_limit,
                                      const std::function<void(std::string_view line)>& on_line,
                                      const std::function<Wish()>& poll_wish);

/// Path of this program, to start it again as a worker.
std::string own_executable();

}  // namespace semblante::jobs
