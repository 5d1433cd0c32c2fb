#include "server/jobs/worker_protocol.h"

#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/json/read_json.h"

namespace semblante::jobs {
namespace {

using nlohmann::json;

std::string dump(const json& value) { return value.dump(-1, ' ', false, json::error_handler_t::replace); }

std::string kind_name(std::size_t kind) { return std::string(job_kinds[kind].name); }

std::size_t kind_from(const json& value) {
  const auto kind = find_job_kind(value.at("kind").get<std::string>());
  if (!kind) throw std::invalid_argument("/kind: there is no such kind of job");
  return *kind;
}

json value_of(const WorkerProgress& progress) { return {{"progress", progress.progress}, {"stage", progress.stage}}; }

json value_of(const WorkerResult& result) {
  json done = {
      {"kind", kind_name(result.outcome.index())}, {"outcome", to_value(result.outcome)}, {"artefacts", json::array()}};
  for (const auto& artefact : result.artefacts)
    done["artefacts"].push_back({{"name", artefact.name}, {"content_type", artefact.content_type}});
  return {{"done", std::move(done)}};
}

json value_of(const http::Problem& problem) { return {{"problem", json::parse(http::to_json(problem))}}; }

WorkerResult result_from(const json& done) {
  WorkerResult result{outcome_from(kind_from(done), done.at("outcome")), {}};
  for (const auto& item : done.at("artefacts"))
    result.artefacts.push_back({item.at("name"), "", 0, item.at("content_type")});
  return result;
}

/// Reads a value from a JSON text.
template <class T, class Read>
Result<T> read_as(std::string_view text, Read read) {
  const auto document = read_json_object(text);
  if (!document) return document.error();
  try {
    return read(*document);
  } catch (const json::exception& fault) {
    return Error{ErrorCode::malformed, "", fault.what()};
  } catch (const std::invalid_argument& fault) {
    return Error{ErrorCode::malformed, "", fault.what()};
  }
}

}  // namespace

std::string to_json(const WorkerRequest& request) {
  return dump({{"kind", kind_name(request.job.index())},
               {"output_directory", request.output_directory},
               {"request", to_value(request.job)}});
}

Result<WorkerRequest> worker_request_from_json(std::string_view text) {
  return read_as<WorkerRequest>(text, [](const json& value) {
    return WorkerRequest{value.at("output_directory"), request_from(kind_from(value), value.at("request"))};
  });
}

std::string to_json_line(const WorkerLine& line) {
  return std::visit([](const auto& said) { return dump(value_of(said)); }, line) + "\n";
}

Result<WorkerLine> worker_line_from_json(std::string_view text) {
  return read_as<WorkerLine>(text, [](const json& value) -> WorkerLine {
    if (value.contains("done")) return result_from(value["done"]);
    if (value.contains("problem")) return http::problem_from_json(dump(value["problem"]));
    return WorkerProgress{value.at("progress"), value.at("stage")};
  });
}

}  // namespace semblante::jobs
