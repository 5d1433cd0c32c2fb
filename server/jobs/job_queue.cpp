#include "server/jobs/job_queue.h"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <mutex>
#include <shared_mutex>
#include <system_error>
#include <utility>

#include "server/log/guard.h"
#include "server/log/log.h"

namespace semblante::jobs {

using store::JobKind;
using store::JobRecord;
using store::JobState;

JobQueue::JobQueue(store::Store& store, store::BlobStore& blobs, JobConfig config)
    : store_(store), blobs_(blobs), config_(std::move(config)) {}

JobQueue::~JobQueue() { stop(); }

void JobQueue::start() {
  for (auto& job : store_.unfinished_jobs()) {
    if (job.attempts >= config_.max_attempts) {
      fail(job, JobState::failed,
           http::make_problem("worker-crashed", "the server ended " + std::to_string(job.attempts) +
                                                    " times while this job ran; it is not tried again"));
      continue;
    }
    job.state = JobState::queued;
    job.progress = 0.0;
    job.stage.clear();
    store_.update_job(job);
    queue_.push_back(std::move(job));
  }
  for (unsigned i = 0; i < config_.concurrency; ++i)
    threads_.emplace_back([this] { log::keep_running("a job queue thread", [this] { work(); }); });
}

void JobQueue::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  for (auto& thread : threads_) thread.join();
  threads_.clear();
}

bool JobQueue::has_room() const {
  const std::lock_guard lock(mutex_);
  return queue_.size() < config_.max_queued;
}

std::size_t JobQueue::waiting() const {
  const std::lock_guard lock(mutex_);
  return queue_.size();
}

std::size_t JobQueue::running() const {
  const std::lock_guard lock(mutex_);
  return running_.size();
}

std::uint64_t JobQueue::ended(JobKind kind, JobState state) const {
  return ended_[static_cast<std::size_t>(kind) * states + static_cast<std::size_t>(state)];
}

void JobQueue::conclude(const JobRecord& job) {
  ++ended_[static_cast<std::size_t>(job.kind) * states + static_cast<std::size_t>(job.state)];
  publish(job);
  if (on_finished_) on_finished_(job);
}

void JobQueue::enqueue(const JobRecord& job) {
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back(job);
  }
  changed_.notify_all();
}

bool JobQueue::cancel(std::string_view id) {
  JobRecord job;
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = running_.find(id); found != running_.end()) {
      found->second->cancel = true;
      return true;
    }
    const auto waiting = std::find_if(queue_.begin(), queue_.end(), [&](const auto& item) { return item.id == id; });
    if (waiting == queue_.end()) return false;
    job = *waiting;
    queue_.erase(waiting);
  }
  fail(job, JobState::cancelled, http::make_problem("cancelled", "it was cancelled before it began"));
  conclude(job);
  return true;
}

void JobQueue::cancel_all_of(std::string_view model) {
  std::unique_lock lock(mutex_);
  std::erase_if(queue_, [&](const auto& job) { return job.model == model; });
  const auto runs = [&] {
    return std::any_of(running_.begin(), running_.end(), [&](const auto& item) {
      if (item.second->job.model != model) return false;
      item.second->cancel = true;
      return true;
    });
  };
  changed_.wait(lock, [&] { return !runs(); });
}

std::optional<JobRecord> JobQueue::find(std::string_view id) const {
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = running_.find(id); found != running_.end()) return found->second->job;
  }
  return store_.job(id);
}

std::uint64_t JobQueue::watch(std::string_view id, Watcher watcher) {
  const std::lock_guard lock(watch_mutex_);
  watchers_.emplace(next_watch_, std::make_pair(std::string(id), std::move(watcher)));
  return next_watch_++;
}

void JobQueue::unwatch(std::uint64_t watch) {
  const std::lock_guard lock(watch_mutex_);
  watchers_.erase(watch);
}

void JobQueue::publish(const JobRecord& job) {
  const std::lock_guard lock(watch_mutex_);
  for (const auto& [number, entry] : watchers_)
    if (entry.first == job.id) entry.second(job);
}

std::deque<JobRecord>::iterator JobQueue::next() {
  return std::find_if(queue_.begin(), queue_.end(), [&](const JobRecord& job) {
    return job.model.empty() || std::none_of(running_.begin(), running_.end(),
                                             [&](const auto& item) { return item.second->job.model == job.model; });
  });
}

void JobQueue::work() {
  while (true) {
    std::shared_ptr<Running> running;
    {
      std::unique_lock lock(mutex_);
      auto job = queue_.end();
      changed_.wait(lock, [&] { return stopping_ || (job = next()) != queue_.end(); });
      if (stopping_) return;
      running = std::make_shared<Running>();
      running->job = std::move(*job);
      queue_.erase(job);
      running_[running->job.id] = running;
    }
    // When the disk fails under us, the job stays unfinished in the store and is taken up at the next start.
    log::guarded("job " + running->job.id, [&] { run(running); });
    {
      const std::lock_guard lock(mutex_);
      running_.erase(running->job.id);
    }
    changed_.notify_all();
    if (store::is_final(running->job.state)) conclude(running->job);
  }
}

Result<WorkerRequest> JobQueue::make_request(const JobRecord& job) const {
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

void JobQueue::run(const std::shared_ptr<Running>& running) {
  {
    const std::lock_guard lock(mutex_);
    running->job.state = JobState::running;
    running->job.stage = "starting";
    running->job.updated = store::timestamp_now();
    ++running->job.attempts;
  }
  store_.update_job(running->job);
  publish(running->job);
  auto request = make_request(running->job);
  if (!request) {
    fail(running->job, JobState::failed, http::problem_from(request.error()));
    return;
  }
  std::error_code ignored;
  std::filesystem::remove_all(request->output_directory, ignored);
  std::filesystem::create_directories(request->output_directory, ignored);

  std::optional<WorkerLine> last_line;
  const auto on_line = [&](std::string_view text) {
    auto line = worker_line_from_json(text);
    if (!line) return;
    if (line->kind != WorkerLine::Kind::progress) {
      last_line = std::move(*line);
      return;
    }
    JobRecord copy;
    {
      const std::lock_guard lock(mutex_);
      running->job.progress = std::clamp(line->progress, running->job.progress, 1.0);
      running->job.stage = line->stage;
      running->job.updated = store::timestamp_now();
      copy = running->job;
    }
    publish(copy);
  };
  const auto wish = [&] {
    const std::lock_guard lock(mutex_);
    return stopping_ ? Wish::stop : running->cancel ? Wish::cancel : Wish::go_on;
  };
  auto command = config_.worker_command;
  command.push_back("--memory=" + std::to_string(config_.limits.memory_bytes));
  command.push_back("--cpu-seconds=" + std::to_string(config_.limits.cpu_seconds));
  command.push_back("--file-bytes=" + std::to_string(config_.limits.file_bytes));
  const auto exit = run_worker_process(command, to_json(*request), request->output_directory + ".stderr",
                                       config_.wall_limit, on_line, wish);
  finish(running, *request, std::move(last_line), exit);
  std::filesystem::remove_all(request->output_directory, ignored);
  std::filesystem::remove(request->output_directory + ".stderr", ignored);
}

http::Problem JobQueue::problem_of(const WorkerExit& exit) const {
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

void JobQueue::finish(const std::shared_ptr<Running>& running, const WorkerRequest& request,
                      std::optional<WorkerLine> last_line, const Result<WorkerExit>& exit) {
  // Finished on a copy: readers see the running record until the end is durable.
  JobRecord job = running->job;
  if (!exit) {
    fail(job, JobState::failed, http::make_problem("internal", exit.error().message));
  } else if (exit->kind == WorkerExit::Kind::stopped) {
    return;
  } else if (exit->kind == WorkerExit::Kind::exited && last_line && last_line->kind == WorkerLine::Kind::problem) {
    fail(job, JobState::failed, last_line->problem);
  } else if (exit->kind == WorkerExit::Kind::exited && exit->code == 0 && last_line) {
    finish_with_result(job, request, std::move(last_line->result));
  } else {
    const bool cancelled = exit->kind == WorkerExit::Kind::cancelled;
    if (!cancelled && !exit->last_words.empty())
      log::warning("the worker of job " + job.id + " said: " + exit->last_words);
    fail(job, cancelled ? JobState::cancelled : JobState::failed, problem_of(*exit));
  }
  const std::lock_guard lock(mutex_);
  running->job = job;
}

void JobQueue::remove_orphans(const std::optional<std::vector<std::string>>& hashes) const {
  if (!hashes) return;
  for (const auto& hash : *hashes) blobs_.remove(hash);
}

void JobQueue::finish_with_result(JobRecord& job, const WorkerRequest& request, WorkerResult result) {
  if (job.kind == JobKind::extract) {
    finish_extraction(job, result);
    return;
  }
  // Alone where something goes with the same commit: what the result before it used, and no one else.
  std::shared_lock shared(blobs_.references(), std::defer_lock);
  std::unique_lock alone(blobs_.references(), std::defer_lock);
  if (job.kind == JobKind::propose)
    shared.lock();
  else
    alone.lock();
  for (auto& artefact : result.artefacts) {
    // A name is a file of the output folder, never a path out of it.
    const std::filesystem::path name(artefact.name);
    auto blob = name.filename() == name ? blobs_.adopt(request.output_directory / name)
                                        : Result<store::Blob>(Error{ErrorCode::internal, "", "a path for a name"});
    if (!blob) {
      fail(job, JobState::failed,
           http::make_problem("internal", "a result could not be kept: " + blob.error().message));
      return;
    }
    artefact.sha256 = blob->sha256;
    artefact.bytes = blob->bytes;
  }
  job.state = JobState::done;
  job.progress = 1.0;
  job.stage = "done";
  job.updated = store::timestamp_now();
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
    remove_orphans(store_.finish_import(job, facts, result.artefacts, result.turn));
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
  remove_orphans(store_.finish_parametrization(job, package, result.parts, result.warnings, result.findings,
                                               result.artefacts, frame));
}

void JobQueue::finish_extraction(JobRecord& job, const WorkerResult& result) {
  const store::ExtractionRecord& wish = *job.extraction;
  store::SetRecord set;
  set.id = store::random_id();
  set.name = wish.name;
  set.kind = wish.kind;
  set.created = set.updated = store::timestamp_now();
  set.displacements = result.displacements;
  set.source = extraction_source(job, result);
  job.state = JobState::done;
  job.progress = 1.0;
  job.stage = "done";
  job.updated = set.created;
  job.result = extraction_result(set.id, result);
  store_.finish_extraction(job, set);
  release_files(job);
}

void JobQueue::release_files(const JobRecord& job) {
  if (!job.extraction) return;
  const std::unique_lock alone(blobs_.references());
  for (const auto& hash : store_.release_job_files(job.id)) blobs_.remove(hash);
}

void JobQueue::fail(JobRecord& job, JobState state, const http::Problem& problem) {
  job.state = state;
  job.problem = http::to_json(problem);
  job.updated = store::timestamp_now();
  store_.finish_without_result(job);
  release_files(job);
  log::info("job " + job.id + " (" + std::string(store::to_string(job.kind)) + " of " + job.model + ") " +
            std::string(store::to_string(state)) + ": " + problem.detail);
}

}  // namespace semblante::jobs
