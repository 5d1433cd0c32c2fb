#include "server/jobs/job_run.h"

#include <csignal>
#include <cstring>
#include <mutex>
#include <shared_mutex>
#include <system_error>
#include <unordered_set>
#include <utility>

#include "server/jobs/next_state.h"
#include "server/log/log.h"
#include "server/store/data_files.h"

namespace semblante::jobs {
namespace {

using store::JobRecord;
using store::JobState;

/// The folder for a worker's files; removed by the destructor.
class OutputFolder {
 public:
  explicit OutputFolder(const std::filesystem::path& path) : path_(path) {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
    std::filesystem::create_directories(path_, error);
    if (error) store::throw_if_disk_full(path_, error.value());
  }
  ~OutputFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
    std::filesystem::remove(error_file(), ignored);
  }
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  [[nodiscard]] std::filesystem::path error_file() const { return path_.string() + ".stderr"; }
  [[nodiscard]] std::uint64_t bytes() const {
    std::uint64_t sum = 0;
    std::error_code error;
    for (const auto& file : std::filesystem::directory_iterator(path_, error)) {
      const auto size = file.file_size(error);
      if (!error) sum += size;
    }
    return sum;
  }

 private:
  const std::filesystem::path path_;
};

/// Sets the state of a successful job.
void set_done(JobRecord& job) {
  job.state = JobState::done;
  job.progress = 1.0;
  job.stage = "done";
  job.updated = store::timestamp_now();
}

}  // namespace

std::optional<JobRecord> JobRun::run(const JobRecord& job, const OnProgress& on_progress,
                                     const std::function<Wish()>& wish) {
  has_begun_ = true;
  std::optional<JobRequest> asked;
  try {
    auto made = make_request(job, {stores_.models, blobs_});
    if (!made) return ended_job(job, JobState::failed, http::problem_from(made.error()));
    asked = std::move(*made);
  } catch (const store::DamagedBlob& fault) {
    return ended_job(job, JobState::failed, http::make_problem("damaged-data", fault.what()));
  }
  const WorkerRequest request{(blobs_.temporary() / ("job-" + job.id)).string(), std::move(*asked)};
  const OutputFolder folder(request.output_directory);
  try {
    return work(job, request, on_progress, wish);
  } catch (const store::DiskFull&) {
    // It may have stopped anywhere: the bytes it wrote are a lower bound of what it needs.
    room_needed_ = 2 * (folder.bytes() + adopted_bytes_) + least_room;
    throw;
  }
}

std::optional<JobRecord> JobRun::work(const JobRecord& job, const WorkerRequest& request, const OnProgress& on_progress,
                                      const std::function<Wish()>& wish) {
  std::optional<WorkerLine> last_line;
  const auto on_line = [&](std::string_view text) {
    auto line = worker_line_from_json(text);
    if (!line) return;
    if (const auto* progress = std::get_if<WorkerProgress>(&*line))
      on_progress(*progress);
    else
      last_line = std::move(*line);
  };
  auto command = config_.worker_command;
  command.push_back("--memory=" + std::to_string(config_.limits.memory_bytes));
  command.push_back("--cpu-seconds=" + std::to_string(config_.limits.cpu_seconds));
  command.push_back("--file-bytes=" + std::to_string(config_.limits.file_bytes));
  const auto exit = run_worker_process(command, to_json(request), request.output_directory + ".stderr",
                                       config_.wall_limit, on_line, wish);
  if (!exit) return ended_job(job, JobState::failed, http::make_problem("internal", exit.error().message));
  if (exit->kind == WorkerExit::Kind::stopped) return std::nullopt;
  if (exit->kind == WorkerExit::Kind::exited && last_line) {
    if (const auto* problem = std::get_if<http::Problem>(&*last_line)) {
      if (problem->slug == "insufficient-storage") throw store::DiskFull(problem->detail);
      return ended_job(job, JobState::failed, *problem);
    }
    if (exit->code == 0) return keep_result(job, request, std::get<WorkerResult>(std::move(*last_line)));
  }
  const bool cancelled = exit->kind == WorkerExit::Kind::cancelled;
  if (!cancelled && !exit->last_words.empty())
    log::warning("the worker of job " + job.id + " wrote: " + exit->last_words);
  return ended_job(job, cancelled ? JobState::cancelled : JobState::failed, problem_of(*exit));
}

http::Problem JobRun::problem_of(const WorkerExit& exit) const {
  const auto& limits = config_.limits;
  switch (exit.kind) {
    case WorkerExit::Kind::cancelled:
      return http::make_problem("cancelled", "it was cancelled while it ran");
    case WorkerExit::Kind::timed_out:
      return http::make_problem("worker-limit",
                                "it took longer than " + std::to_string(config_.wall_limit.count()) + " s");
    case WorkerExit::Kind::signalled:
      if (exit.code == SIGXCPU)
        return http::make_problem(
            "worker-limit", "it exceeded its " + std::to_string(limits.cpu_seconds) + " s of processor time (SIGXCPU)");
      if (exit.code == SIGXFSZ)
        return http::make_problem(
            "worker-limit", "it wrote a file of more than " + std::to_string(limits.file_bytes) + " bytes (SIGXFSZ)");
      if (exit.code == SIGKILL)
        return http::make_problem("worker-limit", "the system killed its worker (SIGKILL), most likely for its memory");
      if (exit.code == SIGSYS)
        return http::make_problem("worker-crashed",
                                  "its worker was stopped at a system call that no job needs (SIGSYS): the model may "
                                  "be made to attack the server");
      return http::make_problem("worker-crashed", "its worker ended by signal " + std::to_string(exit.code) + " (" +
                                                      sigabbrev_np(exit.code) + ")");
    case WorkerExit::Kind::exited:
    case WorkerExit::Kind::stopped:
      break;
  }
  return http::make_problem("worker-crashed",
                            "its worker ended with code " + std::to_string(exit.code) + " and without a result");
}

JobRecord JobRun::keep_result(const JobRecord& job, const WorkerRequest& request, WorkerResult result) {
  try {
    // Blobs that only the earlier result refers to are removed after this commit.
    const std::unique_lock alone(blobs_.references());
    if (const auto problem = adopt_artefacts(request, result)) return ended_job(job, JobState::failed, *problem);
    JobRecord done = job;
    set_done(done);
    const auto hashes = finish(done, std::move(result.outcome), result.artefacts, stores_.jobs);
    if (!hashes) return ended_job(job, JobState::failed, http::problem_from(hashes.error()));
    for (const auto& hash : *hashes) blobs_.remove(hash);
    return done;
  } catch (const store::StoreError&) {
    discard(result);
    throw;
  }
}

std::optional<http::Problem> JobRun::adopt_artefacts(const WorkerRequest& request, WorkerResult& result) {
  for (auto& artefact : result.artefacts) {
    // A name must be a file in the output folder, not a path to elsewhere.
    const std::filesystem::path name(artefact.name);
    if (name.filename() != name || !store::is_real_file(request.output_directory / name))
      return http::make_problem("internal", "its worker did not write a result that it names");
    auto blob = blobs_.adopt(request.output_directory / name);
    // Its message has a path of this machine: for the log, not for the job.
    if (!blob) throw store::StoreError(blob.error().message);
    artefact.sha256 = blob->sha256;
    artefact.bytes = blob->bytes;
    adopted_bytes_ += blob->bytes;
  }
  return std::nullopt;
}

void JobRun::discard(const WorkerResult& result) const {
  if (result.artefacts.empty()) return;
  const std::unique_lock alone(blobs_.references());
  try {
    const auto list = stores_.artefacts.referenced_hashes();
    const std::unordered_set<std::string> used(list.begin(), list.end());
    for (const auto& artefact : result.artefacts)
      if (!artefact.sha256.empty() && !used.contains(artefact.sha256)) blobs_.remove(artefact.sha256);
  } catch (const store::StoreError&) {  // the next start moves them into the trash
  }
}

}  // namespace semblante::jobs
