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

// Whatever is done with a job of any type, by the list of types in job_types.h.
namespace semblante::jobs {

/// What a type of job must have. Its members are what is asked for, as the store keeps it. It, its Request (what a
/// worker is told) and its Outcome (what a worker found) have to_json() and from_json(), found beside the type.
template <class T>
concept JobType = requires(const T& job, store::JobRecord& record, const JobSources& sources, store::JobStore& store,
                           const typename T::Request& request, typename T::Outcome outcome, ResultFiles& files,
                           const std::vector<store::ArtefactRecord>& artefacts, const Progress& progress) {
  /// In the store, in answers and in metrics.
  { T::kind_name } -> std::convertible_to<std::string_view>;
  /// Whether the frame of the model may not be changed while such a job has not ended.
  { T::needs_frame_to_stay } -> std::convertible_to<bool>;
  /// In the server, when the job begins.
  { job.request(record, sources) } -> std::same_as<Result<typename T::Request>>;
  /// In the worker process.
  { T::run(request, files, progress) } -> std::same_as<Result<typename T::Outcome>>;
  /// In the server: stores the job, which is done, with what it brought, in one step; `record.result` is what its
  /// answers show beside that. Gives the hashes of blobs that nothing refers to any more.
  { job.finish(record, std::move(outcome), artefacts, store) } -> std::same_as<std::vector<std::string>>;
};

/// A type may also have finish_without_outcome(record, store), where a job that failed or was cancelled changes more
/// than itself. It gives hashes as finish().
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

/// Of one type of job each, with the index that the type has in Job.
using JobRequest = JobList<Job>::Request;
using JobOutcome = JobList<Job>::Outcome;

/// The kinds of jobs, by the index of their type in Job.
inline constexpr auto& job_kinds = JobList<Job>::kinds;
std::optional<std::size_t> find_job_kind(std::string_view name);

/// A job of this type as it is before it is stored; `model` is empty where it is of none.
store::JobRecord new_record(const Job& job, std::string model);
/// What was asked for. Error `internal`: a kind or a form that this program does not write.
Result<Job> read_job(const store::JobRecord& record);
/// The same where it is of this type.
template <JobType T>
std::optional<T> read_job_as(const store::JobRecord& record) {
  auto job = read_job(record);
  if (!job || !std::holds_alternative<T>(*job)) return std::nullopt;
  return std::get<T>(std::move(*job));
}

/// T::request() of the job's type. Error also as read_job().
Result<JobRequest> make_request(const store::JobRecord& record, const JobSources& sources);
/// T::run() of the request's type.
Result<JobOutcome> run(const JobRequest& request, ResultFiles& files, const Progress& progress);
/// T::finish() of the job's type. Error `internal`: as read_job(), or the outcome is of another type.
Result<std::vector<std::string>> finish(store::JobRecord& record, JobOutcome outcome,
                                        const std::vector<store::ArtefactRecord>& artefacts, store::JobStore& store);
/// Stores the end of a job that failed or was cancelled. Hashes as T::finish().
std::vector<std::string> finish_without_outcome(const store::JobRecord& record, store::JobStore& store);

/// The members of the request or the outcome; which type it is of is not among them.
nlohmann::json to_value(const JobRequest& request);
nlohmann::json to_value(const JobOutcome& outcome);
/// The reverse, of the type with this index. Throw nlohmann::json::exception and std::invalid_argument.
JobRequest request_from(std::size_t kind, const nlohmann::json& value);
JobOutcome outcome_from(std::size_t kind, const nlohmann::json& value);

}  // namespace semblante::jobs
