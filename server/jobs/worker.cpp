#include "server/jobs/worker.h"

#include <iostream>
#include <iterator>
#include <new>
#include <unistd.h>
#include <utility>

#include "server/jobs/isolation.h"
#include "server/store/store_error.h"

namespace semblante::jobs {
namespace {

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
