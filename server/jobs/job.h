#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "server/jobs/job_types.h"

// The operations on a job of any type, dispatched by the list of types in job_types.h.
namespace semblante::jobs {

/// The requirements for a type of job. Its members are the stored options of the job. The type, its Request (the input
/// of a worker) and its Outcome (the output of a worker) have to_json() and from_json() in their namespace.
template <class T>
concept JobType = requires(const T& job, store::JobRecord& record, const JobSources& sources, store::JobStore& store,
                           const typename T::Request& request, typename T::Outcome outcome, const InputFiles& inputs,
                           ResultFiles& files, const std::vector<store::ArtefactRecord>& artefacts,
                           const Progress& progress) {
  /// Used in the store, in answers and in metrics.
  { T::kind_name } -> std::convertible_to<std::string_view>;
  /// Whether the frame of the model must not change until such a job has ended.
  { T::needs_frame_to_stay } -> std::convertible_to<bool>;
  /// Called in the server, when the job starts.
  { job.request(record, sources) } -> std::same_as<Result<typename T::Request>>;
  /// Called in the worker process, which opens these files before it isolates itself.
  { request.inputs() } -> std::same_as<std::vector<std::string>>;
  /// Called in the isolated worker process.
  { T::run(request, inputs, files, progress) } -> std::same_as<Result<typename T::Outcome>>;
  /// Called in the server: stores the finished job with its outcome in one transaction, and sets `record.result`, which
  /// is shown in answers. Returns the hashes of blobs that are no longer referred to.
  { job.finish(record, std::move(outcome), artefacts, store) } -> std::same_as<std::vector<std::string>>;
};

/// A type may also have finish_without_outcome(record, store), if a failed or cancelled job changes more than its own
/// record. It returns hashes like finish().
template <class T>
concept HasFinishWithoutOutcome = requires(const store::JobRecord& record, store::JobStore& store) {
  { T::finish_without_outcome(record, store) } -> std::same_as<std::vector<std::string>>;
};

struct JobKind {
  std::string_view name;
  bool needs_frame_to_stay;
};

template <class>
struct JobList;
template <JobType... Types>
struct JobList<std::variant<Types...>> {
  using Request = std::variant<typename Types::Request...>;
  using Outcome = std::variant<typename Types::Outcome...>;
  static constexpr std::array<JobKind, sizeof...(Types)> kinds = {
      JobKind{Types::kind_name, Types::needs_frame_to_stay}...};
};

/// Variants over the types of jobs, with the same indices as Job.
using JobRequest = JobList<Job>::Request;
using JobOutcome = JobList<Job>::Outcome;

/// The kinds of jobs, by the index of their type in Job.
inline constexpr auto& job_kinds = JobList<Job>::kinds;
std::optional<std::size_t> find_job_kind(std::string_view name);

/// A new record for this job, not stored yet; `model` is empty for a job without a model.
store::JobRecord new_record(const Job& job, std::string model, store::Origin origin = {});
/// Reads the job of a record. Error `internal`: a kind or a form that this program does not write.
Result<Job> read_job(const store::JobRecord& record);
/// The same if it has this type.
template <JobType T>
std::optional<T> read_job_as(const store::JobRecord& record) {
  auto job = read_job(record);
  if (!job || !std::holds_alternative<T>(*job)) return std::nullopt;
  return std::get<T>(std::move(*job));
}

/// T::request() of the job's type. Error also as read_job(). Throws store::DamagedBlob and store::StoreError.
Result<JobRequest> make_request(const store::JobRecord& record, const JobSources& sources);
/// Request::inputs() of the request's type.
std::vector<std::string> inputs_of(const JobRequest& request);
/// T::run() of the request's type.
Result<JobOutcome> run(const JobRequest& request, const InputFiles& inputs, ResultFiles& files,
                       const Progress& progress);
/// T::finish() of the job's type. Error `internal`: as read_job(), or the outcome is of another type.
Result<std::vector<std::string>> finish(store::JobRecord& record, JobOutcome outcome,
                                        const std::vector<store::ArtefactRecord>& artefacts, store::JobStore& store);
/// Stores the end of a job that failed or was cancelled. Hashes as T::finish().
std::vector<std::string> finish_without_outcome(const store::JobRecord& record, store::JobStore& store);

/// The members of the request or the outcome, without its type.
nlohmann::json to_value(const JobRequest& request);
nlohmann::json to_value(const JobOutcome& outcome);
/// The reverse, for the type with this index. Throws nlohmann::json::exception and std::invalid_argument.
JobRequest request_from(std::size_t kind, const nlohmann::json& value);
JobOutcome outcome_from(std::size_t kind, const nlohmann::json& value);

}  // namespace semblante::jobs
