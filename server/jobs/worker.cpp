#include "server/jobs/worker.h"

#include <csignal>
#include <iostream>
#include <iterator>
#include <new>
#include <unistd.h>
#include <utility>

#include <sys/prctl.h>
#include <sys/resource.h>

#include "server/jobs/isolation.h"
#include "server/log/thread_rank.h"
#include "server/store/store_error.h"

namespace semblante::jobs {
namespace {

void limit(int what, std::uint64_t value, std::uint64_t grace = 0) {
  if (value == 0) return;
  const rlimit limits{value, value + grace};
  setrlimit(static_cast<__rlimit_resource>(what), &limits);
}

/// Writes the whole line with one call: a line cut off by a crash must not look like another one.
void say(const WorkerLine& line) {
  const auto text = to_json_line(line);
  std::cout.write(text.data(), static_cast<std::streamsize>(text.size())).flush();
}

int report(http::Problem problem) {
  say(std::move(problem));
  return 2;
}

}  // namespace

void limit_this_process(const WorkerLimits& limits) {
  // The kernel kills the worker when its server is killed.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  log::set_thread_rank(log::ThreadRank::jobs);
  limit(RLIMIT_AS, limits.memory_bytes);
  // SIGXCPU tells the reason; at the hard limit the kernel sends SIGKILL, and would at once if both were equal.
  limit(RLIMIT_CPU, limits.cpu_seconds, 1);
  limit(RLIMIT_FSIZE, limits.file_bytes);
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
}

int run_worker(const RunJob& run_job) {
  const std::string text((std::istreambuf_iterator<char>(std::cin)), std::istreambuf_iterator<char>());
  const auto request = worker_request_from_json(text);
  if (!request) return report(http::make_problem("internal", "the worker cannot read its request"));
  const Progress progress = [](double share, std::string_view stage) {
    say(WorkerProgress{share, std::string(stage)});
    return true;
  };
  try {
    const InputFiles inputs(inputs_of(request->job));
    if (const auto isolated = isolate_this_process(request->output_directory); !isolated)
      return report(http::problem_from(isolated.error()));
    ResultFiles files(request->output_directory);
    auto outcome = run_job(request->job, inputs, files, progress);
    if (!outcome) return report(http::problem_from(outcome.error()));
    say(WorkerResult{std::move(*outcome), files.written()});
    return 0;
  } catch (const std::bad_alloc&) {
    return report(http::make_problem("worker-limit", "the model needs more memory than a job is given"));
  } catch (const store::DiskFull& fault) {
    return report(http::make_problem("insufficient-storage", fault.what()));
  } catch (const std::exception& fault) {
    return report(http::make_problem("worker-crashed", std::string("an internal error: ") + fault.what()));
  }
}

}  // namespace semblante::jobs
