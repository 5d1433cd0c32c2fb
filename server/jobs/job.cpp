#include "server/jobs/job.h"

#include <algorithm>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "core/json/read_json.h"

namespace semblante::jobs {
namespace {

using nlohmann::json;

/// The alternative with this index, read from JSON.
template <class Variant, std::size_t index = 0>
Variant alternative_from(std::size_t wanted, const json& value) {
  if constexpr (index < std::variant_size_v<Variant>) {
    if (wanted != index) return alternative_from<Variant, index + 1>(wanted, value);
    return Variant(std::in_place_index<index>, value.get<std::variant_alternative_t<index, Variant>>());
  } else {
    throw std::invalid_argument("there is no such kind of job");
  }
}

template <class Variant>
json value_of(const Variant& variant) {
  return std::visit([](const auto& alternative) { return json(alternative); }, variant);
}

}  // namespace

std::optional<std::size_t> find_job_kind(std::string_view name) {
  const auto* const found =
      std::find_if(job_kinds.begin(), job_kinds.end(), [&](const JobKind& kind) { return kind.name == name; });
  if (found == job_kinds.end()) return std::nullopt;
  return static_cast<std::size_t>(found - job_kinds.begin());
}

store::JobRecord new_record(const Job& job, std::string model, store::Origin origin) {
  store::JobRecord record;
  record.id = store::random_id();
  record.model = std::move(model);
  record.kind = std::string(job_kinds[job.index()].name);
  record.created = record.updated = store::timestamp_now();
  record.request = value_of(job).dump(-1, ' ', false, json::error_handler_t::replace);
  record.origin = std::move(origin);
  return record;
}

Result<Job> read_job(const store::JobRecord& record) {
  const auto kind = find_job_kind(record.kind);
  if (!kind) return Error{ErrorCode::internal, "", "there is no kind of job " + record.kind};
  const auto document = read_json_object(record.request);
  if (!document) return Error{ErrorCode::internal, document.error().where, "the stored job cannot be read"};
  try {
    return alternative_from<Job>(*kind, *document);
  } catch (const json::exception& fault) {
    return Error{ErrorCode::internal, "", std::string("the stored job cannot be read: ") + fault.what()};
  }
}

Result<JobRequest> make_request(const store::JobRecord& record, const JobSources& sources) {
  const auto job = read_job(record);
  if (!job) return job.error();
  return std::visit(
      [&](const auto& asked) -> Result<JobRequest> {
        auto request = asked.request(record, sources);
        if (!request) return request.error();
        return JobRequest(std::move(*request));
      },
      *job);
}

namespace {

/// The type of job whose request is the alternative `index`.
template <std::size_t index = 0>
Result<JobOutcome> run_alternative(const JobRequest& request, const InputFiles& inputs, ResultFiles& files,
                                   const Progress& progress) {
  if constexpr (index < std::variant_size_v<Job>) {
    if (request.index() != index) return run_alternative<index + 1>(request, inputs, files, progress);
    auto outcome = std::variant_alternative_t<index, Job>::run(std::get<index>(request), inputs, files, progress);
    if (!outcome) return outcome.error();
    return JobOutcome(std::in_place_index<index>, std::move(*outcome));
  } else {
    return Error{ErrorCode::internal, "", "there is no such kind of job"};
  }
}

template <std::size_t index = 0>
std::vector<std::string> finish_alternative_without_outcome(std::size_t kind, const store::JobRecord& record,
                                                            store::JobStore& store) {
  if constexpr (index < std::variant_size_v<Job>) {
    if (kind != index) return finish_alternative_without_outcome<index + 1>(kind, record, store);
    using Type = std::variant_alternative_t<index, Job>;
    if constexpr (HasFinishWithoutOutcome<Type>) return Type::finish_without_outcome(record, store);
  }
  return store.finish_job(record);
}

}  // namespace

std::vector<std::string> inputs_of(const JobRequest& request) {
  return std::visit([](const auto& asked) { return asked.inputs(); }, request);
}

Result<JobOutcome> run(const JobRequest& request, const InputFiles& inputs, ResultFiles& files,
                       const Progress& progress) {
  return run_alternative(request, inputs, files, progress);
}

Result<std::vector<std::string>> finish(store::JobRecord& record, JobOutcome outcome,
                                        const std::vector<store::ArtefactRecord>& artefacts, store::JobStore& store) {
  const auto job = read_job(record);
  if (!job) return job.error();
  return std::visit(
      [&](const auto& asked) -> Result<std::vector<std::string>> {
        using Outcome = typename std::remove_cvref_t<decltype(asked)>::Outcome;
        auto* const found = std::get_if<Outcome>(&outcome);
        if (found == nullptr)
          return Error{ErrorCode::internal, "", "the worker returned the outcome of another kind of job"};
        return asked.finish(record, std::move(*found), artefacts, store);
      },
      *job);
}

std::vector<std::string> finish_without_outcome(const store::JobRecord& record, store::JobStore& store) {
  return finish_alternative_without_outcome(find_job_kind(record.kind).value_or(job_kinds.size()), record, store);
}

json to_value(const JobRequest& request) { return value_of(request); }
json to_value(const JobOutcome& outcome) { return value_of(outcome); }
JobRequest request_from(std::size_t kind, const json& value) { return alternative_from<JobRequest>(kind, value); }
JobOutcome outcome_from(std::size_t kind, const json& value) { return alternative_from<JobOutcome>(kind, value); }

}  // namespace semblante::jobs
