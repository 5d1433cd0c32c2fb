#include "server/jobs/worker.h"

#include <csignal>
#include <iostream>
#include <iterator>
#include <new>
#include <unistd.h>

#include <sys/prctl.h>
#include <sys/resource.h>

#include "server/jobs/worker_tasks.h"
#include "server/store/store_error.h"

namespace semblante::jobs {
namespace {

void limit(int what, std::uint64_t value) {
  if (value == 0) return;
  const rlimit limits{value, value};
  setrlimit(static_cast<__rlimit_resource>(what), &limits);
}

/// The whole line at once: a line that is cut by a crash must not look like another.
void say(const WorkerLine& line) {
  const auto text = to_json_line(line);
  std::cout.write(text.data(), static_cast<std::streamsize>(text.size())).flush();
}

Result<WorkerResult> run(const WorkerRequest& request, const Progress& progress) {
  switch (request.kind) {
    case store::JobKind::import:
      return run_import(request, progress);
    case store::JobKind::parametrize:
      return run_parametrize(request, progress);
    case store::JobKind::propose:
      return run_propose(request, progress);
    case store::JobKind::extract:
      return run_extract(request, progress);
  }
  return Error{ErrorCode::internal, "", "there is no such job"};
}

int report(http::Problem problem) {
  WorkerLine line;
  line.kind = WorkerLine::Kind::problem;
  line.problem = std::move(problem);
  say(line);
  return 2;
}

}  // namespace

void limit_this_process(const WorkerLimits& limits) {
  // A server that is killed cannot stop its workers: the kernel does it.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  limit(RLIMIT_AS, limits.memory_bytes);
  limit(RLIMIT_CPU, limits.cpu_seconds);
  limit(RLIMIT_FSIZE, limits.file_bytes);
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
}

int run_worker() {
  const std::string text((std::istreambuf_iterator<char>(std::cin)), std::istreambuf_iterator<char>());
  const auto request = worker_request_from_json(text);
  if (!request) return report(http::make_problem("internal", "the worker was asked nothing it knows"));
  const Progress progress = [](double share, std::string_view stage) {
    WorkerLine line;
    line.progress = share;
    line.stage = std::string(stage);
    say(line);
    return true;
  };
  try {
    auto result = run(*request, progress);
    if (!result) return report(http::problem_from(result.error()));
    WorkerLine line;
    line.kind = WorkerLine::Kind::done;
    line.result = std::move(*result);
    say(line);
    return 0;
  } catch (const std::bad_alloc&) {
    return report(http::make_problem("worker-limit", "the model needs more memory than a job is given"));
  } catch (const store::DiskFull& fault) {
    return report(http::make_problem("insufficient-storage", fault.what()));
  } catch (const std::exception& fault) {
    return report(http::make_problem("worker-crashed", std::string("a fault of the program: ") + fault.what()));
  }
}

}  // namespace semblante::jobs
