#include "server/jobs/job_run.h"

#include <csignal>
#include <cstring>
#include <mutex>
#include <shared_mutex>
#include <system_error>
#include <unordered_set>
#include <utility>

#include "server/log/log.h"

namespace semblante::jobs {
namespace {

using store::JobKind;
using store::JobRecord;
using store::JobState;

/// Where a worker puts its files; goes with the object.
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

/// The end of a job that did what it was asked.
void set_done(JobRecord& job) {
  job.state = JobState::done;
  job.progress = 1.0;
  job.stage = "done";
  job.updated = store::timestamp_now();
}

}  // namespace

JobRecord ended_job(JobRecord job, JobState state, const http::Problem& problem) {
  job.state = state;
  job.problem = http::to_json(problem);
  job.updated = store::timestamp_now();
  return job;
}

Result<WorkerRequest> JobRun::make_request(const JobRecord& job) const {
  WorkerRequest request;
  request.kind = job.kind;
  request.output_directory = (blobs_.temporary() / ("job-" + job.id)).string();
  request.extraction = job.extraction;
  if (job.extraction && !job.extraction->expression_sha256.empty()) {
    const auto expression = blobs_.find(job.extraction->expression_sha256);
    if (!expression) return Error{ErrorCode::io, "", "the bytes of the expression are not in the data folder any more"};
    request.expression_source = expression->string();
  }
  if (job.extraction && job.model.empty()) {
    const auto neutral = blobs_.find(job.extraction->neutral_sha256);
    if (!neutral) return Error{ErrorCode::io, "", "the bytes of the neutral head are not in the data folder any more"};
    request.source = neutral->string();
    request.file_name = job.extraction->neutral_file;
    request.points = job.extraction->points;
    return request;
  }
  const auto model = store_.model(job.model);
  if (!model) return Error{ErrorCode::missing, "", "the model of this job is gone"};
  const auto source = blobs_.find(model->source_sha256);
  if (!source) return Error{ErrorCode::io, "", "the bytes of the model are not in the data folder any more"};
  request.source = source->string();
  request.file_name = model->file_name;
  request.name = model->name;
  request.metric = job.metric;
  request.weights = job.weights;
  request.weight_bits = job.weight_bits;
  request.frame = model->frame;
  request.frame_wish = model->frame_wish;
  request.lods = job.lods;
  if (job.kind != JobKind::import) {
    request.points = store_.feature_points(job.model);
    request.parts = model->parts;
  }
  if (job.kind == JobKind::parametrize) request.worn = store_.worn_sets(job.model);
  if (job.kind == JobKind::propose)
    std::erase_if(request.points, [](const auto& point) { return point.proposal.has_value(); });
  return request;
}

std::optional<JobRecord> JobRun::run(const JobRecord& job, const OnProgress& on_progress,
                                     const std::function<Wish()>& wish) {
  has_begun_ = true;
  const auto request = make_request(job);
  if (!request) return ended_job(job, JobState::failed, http::problem_from(request.error()));
  const OutputFolder folder(request->output_directory);
  try {
    return work(job, *request, on_progress, wish);
  } catch (const store::DiskFull&) {
    // It may have been cut short anywhere: what it wrote is the least it needs.
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
    if (line->kind == WorkerLine::Kind::progress)
      on_progress(*line);
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
  if (exit->kind == WorkerExit::Kind::exited && last_line && last_line->kind == WorkerLine::Kind::problem) {
    if (last_line->problem.slug == "insufficient-storage") throw store::DiskFull(last_line->problem.detail);
    return ended_job(job, JobState::failed, last_line->problem);
  }
  if (exit->kind == WorkerExit::Kind::exited && exit->code == 0 && last_line)
    return job.kind == JobKind::extract ? keep_set(job, last_line->result)
                                        : keep_result(job, request, std::move(last_line->result));
  const bool cancelled = exit->kind == WorkerExit::Kind::cancelled;
  if (!cancelled && !exit->last_words.empty())
    log::warning("the worker of job " + job.id + " said: " + exit->last_words);
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
            "worker-limit", "it used up its " + std::to_string(limits.cpu_seconds) + " s of processor time (SIGXCPU)");
      if (exit.code == SIGXFSZ)
        return http::make_problem(
            "worker-limit", "it wrote a file of more than " + std::to_string(limits.file_bytes) + " bytes (SIGXFSZ)");
      if (exit.code == SIGKILL)
        return http::make_problem("worker-limit", "the system killed its worker (SIGKILL), most likely for its memory");
      return http::make_problem("worker-crashed", "its worker ended by signal " + std::to_string(exit.code) + " (" +
                                                      sigabbrev_np(exit.code) + ")");
    case WorkerExit::Kind::exited:
    case WorkerExit::Kind::stopped:
      break;
  }
  return http::make_problem("worker-crashed",
                            "its worker ended with code " + std::to_string(exit.code) + " and without a result");
}

JobRecord JobRun::keep_result(JobRecord job, const WorkerRequest& request, WorkerResult result) {
  try {
    // Alone where something goes with the same commit: what the result before it used, and no one else.
    std::shared_lock shared(blobs_.references(), std::defer_lock);
    std::unique_lock alone(blobs_.references(), std::defer_lock);
    if (job.kind == JobKind::propose)
      shared.lock();
    else
      alone.lock();
    if (const auto problem = adopt_artefacts(request, result)) return ended_job(job, JobState::failed, *problem);
    commit(job, result);
    return job;
  } catch (const store::StoreError&) {
    discard(result);
    throw;
  }
}

std::optional<http::Problem> JobRun::adopt_artefacts(const WorkerRequest& request, WorkerResult& result) {
  for (auto& artefact : result.artefacts) {
    // A name is a file of the output folder, never a path out of it.
    const std::filesystem::path name(artefact.name);
    auto blob = name.filename() == name ? blobs_.adopt(request.output_directory / name)
                                        : Result<store::Blob>(Error{ErrorCode::internal, "", "a path for a name"});
    if (!blob) return http::make_problem("internal", "a result could not be kept: " + blob.error().message);
    artefact.sha256 = blob->sha256;
    artefact.bytes = blob->bytes;
    adopted_bytes_ += blob->bytes;
  }
  return std::nullopt;
}

void JobRun::commit(JobRecord& job, WorkerResult& result) {
  set_done(job);
  if (job.kind == JobKind::import) {
    store::ModelRecord facts;
    facts.format = result.format;
    facts.vertices = result.vertices;
    facts.triangles = result.triangles;
    facts.box_min = result.box_min;
    facts.box_max = result.box_max;
    facts.parts = std::move(result.parts);
    facts.warnings = std::move(result.warnings);
    facts.findings = result.findings;
    facts.frame = std::move(result.frame);
    facts.morph_targets = std::move(result.morph_targets);
    remove(store_.finish_import(job, facts, result.artefacts, result.turn));
    return;
  }
  if (job.kind == JobKind::propose) {
    job.result = proposal_result(result);
    store_.finish_proposal(job, result.proposals);
    return;
  }
  const store::PackageRecord package{job.id,      store::timestamp_now(), job.metric,
                                     job.weights, job.weight_bits,        result.levels};
  const store::FrameUpdate frame{std::move(result.frame), result.turn, result.box_min, result.box_max};
  remove(store_.finish_parametrization(job, package, result.parts, result.warnings, result.findings, result.artefacts,
                                       frame));
}

JobRecord JobRun::keep_set(JobRecord job, const WorkerResult& result) {
  const store::ExtractionRecord& wish = *job.extraction;
  store::SetRecord set;
  set.id = store::random_id();
  set.name = wish.name;
  set.kind = wish.kind;
  set.created = set.updated = store::timestamp_now();
  set.displacements = result.displacements;
  set_done(job);
  set.source = extraction_source(job, result);
  job.result = extraction_result(set.id, result);
  const std::unique_lock alone(blobs_.references());
  remove(store_.finish_extraction(job, set));
  return job;
}

void JobRun::remove(const std::optional<std::vector<std::string>>& hashes) const {
  if (!hashes) return;
  for (const auto& hash : *hashes) blobs_.remove(hash);
}

void JobRun::discard(const WorkerResult& result) const {
  const std::unique_lock alone(blobs_.references());
  try {
    const auto list = store_.referenced_hashes();
    const std::unordered_set<std::string> used(list.begin(), list.end());
    for (const auto& artefact : result.artefacts)
      if (!artefact.sha256.empty() && !used.contains(artefact.sha256)) blobs_.remove(artefact.sha256);
  } catch (const store::StoreError&) {  // the sweep of the next start removes them
  }
}

}  // namespace semblante::jobs
