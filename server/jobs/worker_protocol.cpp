#include "server/jobs/worker_protocol.h"

#include <nlohmann/json.hpp>

#include "core/json/read_json.h"
#include "server/store/frame_json.h"
#include "server/store/record_json.h"

namespace semblante::jobs {
namespace {

using nlohmann::json;

template <class T, class Make>
std::vector<T> list_from(const json& values, Make make) {
  std::vector<T> list;
  for (const auto& value : values) list.push_back(make(value));
  return list;
}

json to_value(const WorkerResult& result) {
  json value = {{"format", result.format}, {"vertices", result.vertices}, {"triangles", result.triangles},
                {"min", result.box_min},   {"max", result.box_max},       {"warnings", result.warnings},
                {"parts", result.parts},   {"artefacts", json::array()}};
  if (result.findings) value["findings"] = *result.findings;
  if (!result.proposals.empty()) value["proposals"] = result.proposals;
  for (const auto& [id, reason] : result.not_proposed) value["not_proposed"].push_back({id, reason});
  if (result.frame) value["frame"] = store::frame_to_json(*result.frame, {});
  if (result.turn) value["turn"] = *result.turn;
  value["morph_targets"] = result.morph_targets;
  value["levels"] = result.levels;
  if (!result.displacements.empty()) value["displacements"] = result.displacements;
  if (!result.taken.empty()) value["taken"] = result.taken;
  for (const auto& artefact : result.artefacts)
    value["artefacts"].push_back({{"name", artefact.name}, {"content_type", artefact.content_type}});
  return value;
}

WorkerResult result_from(const json& value) {
  WorkerResult result;
  result.format = value.at("format");
  result.vertices = value.at("vertices");
  result.triangles = value.at("triangles");
  result.box_min = value.at("min");
  result.box_max = value.at("max");
  result.warnings = value.at("warnings").get<std::vector<std::string>>();
  if (value.contains("findings")) result.findings = value["findings"].get<store::FindingCounts>();
  value.at("parts").get_to(result.parts);
  if (value.contains("frame")) result.frame = store::frame_from_json(value["frame"]);
  if (value.contains("turn")) result.turn = value["turn"].get<store::Turn>();
  value.at("morph_targets").get_to(result.morph_targets);
  value.at("levels").get_to(result.levels);
  result.artefacts = list_from<store::ArtefactRecord>(value.at("artefacts"), [](const json& item) {
    return store::ArtefactRecord{item.at("name"), "", 0, item.at("content_type")};
  });
  if (value.contains("proposals")) value["proposals"].get_to(result.proposals);
  if (value.contains("not_proposed")) value["not_proposed"].get_to(result.not_proposed);
  result.displacements = value.value("displacements", "");
  result.taken = value.value("taken", "");
  return result;
}

/// Answers copy `taken` in its own order; searching ordered members is linear, so they must be few.
Status check_taken(const std::string& taken) {
  if (taken.empty()) return Unit{};
  const auto document = read_json_object(taken, {.max_bytes = 1U << 20U, .max_depth = 8, .max_values = 2'000});
  if (!document) return document.error();
  return Unit{};
}

std::string dump(const json& value) { return value.dump(-1, ' ', false, json::error_handler_t::replace); }

}  // namespace

std::string proposal_result(const WorkerResult& result) {
  json value = {{"proposed", result.proposals.size()}, {"not_proposed", json::object()}};
  for (const auto& [id, reason] : result.not_proposed) value["not_proposed"][id] = reason;
  return dump(value);
}

std::string extraction_result(const std::string& set, const WorkerResult& result) {
  nlohmann::ordered_json value = {{"expression", set}, {"href", "/v1/expressions/" + set}};
  value.update(nlohmann::ordered_json::parse(result.taken));
  return value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string extraction_source(const store::JobRecord& job, const WorkerResult& result) {
  const auto or_null = [](const std::string& text) {
    return text.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(text);
  };
  const store::ExtractionRecord& wish = *job.extraction;
  nlohmann::ordered_json value = {{"model", or_null(job.model)},
                                  {"neutral_file", or_null(wish.neutral_file)},
                                  {"expression_file", or_null(wish.expression_file)},
                                  {"target", or_null(wish.target)},
                                  {"from", or_null(wish.from)},
                                  {"align", wish.align},
                                  {"least", wish.least},
                                  {"strength", wish.strength}};
  value.update(nlohmann::ordered_json::parse(result.taken));
  return value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string to_json(const WorkerRequest& request) {
  json value = {{"kind", std::string(store::to_string(request.kind))},
                {"source", request.source},
                {"file_name", request.file_name},
                {"name", request.name},
                {"output_directory", request.output_directory},
                {"metric", request.metric},
                {"weights", request.weights},
                {"weight_bits", request.weight_bits},
                {"frame_wish", store::wish_to_json(request.frame_wish)},
                {"points", request.points},
                {"parts", request.parts}};
  if (request.frame) value["frame"] = store::frame_to_json(*request.frame, {});
  value["lods"] = request.lods;
  value["worn"] = request.worn;
  if (request.extraction) value["extraction"] = *request.extraction;
  value["expression_source"] = request.expression_source;
  return dump(value);
}

Result<WorkerRequest> worker_request_from_json(std::string_view text) {
  const auto document = read_json_object(text);
  if (!document) return document.error();
  try {
    const auto& value = *document;
    WorkerRequest request;
    const auto kind = store::parse_job_kind(value.at("kind").get<std::string>());
    if (!kind) return Error{ErrorCode::malformed, "/kind", "there is no such job"};
    request.kind = *kind;
    request.source = value.at("source");
    request.file_name = value.at("file_name");
    request.name = value.at("name");
    request.output_directory = value.at("output_directory");
    request.metric = value.at("metric");
    request.weights = value.at("weights");
    request.weight_bits = value.at("weight_bits");
    if (value.contains("frame")) request.frame = store::frame_from_json(value["frame"]);
    request.frame_wish = store::wish_from_json(value.at("frame_wish"));
    value.at("lods").get_to(request.lods);
    value.at("worn").get_to(request.worn);
    if (value.contains("extraction")) request.extraction = value["extraction"].get<store::ExtractionRecord>();
    request.expression_source = value.at("expression_source");
    value.at("points").get_to(request.points);
    value.at("parts").get_to(request.parts);
    return request;
  } catch (const json::exception& fault) {
    return Error{ErrorCode::malformed, "", fault.what()};
  }
}

std::string to_json_line(const WorkerLine& line) {
  switch (line.kind) {
    case WorkerLine::Kind::progress:
      return dump({{"progress", line.progress}, {"stage", line.stage}}) + "\n";
    case WorkerLine::Kind::done:
      return dump({{"done", to_value(line.result)}}) + "\n";
    case WorkerLine::Kind::problem:
      return "{\"problem\":" + http::to_json(line.problem) + "}\n";
  }
  return {};
}

Result<WorkerLine> worker_line_from_json(std::string_view text) {
  const auto document = read_json_object(text);
  if (!document) return document.error();
  try {
    const auto& value = *document;
    WorkerLine line;
    if (value.contains("done")) {
      line.kind = WorkerLine::Kind::done;
      line.result = result_from(value["done"]);
      if (const auto status = check_taken(line.result.taken); !status) return status.error();
    } else if (value.contains("problem")) {
      line.kind = WorkerLine::Kind::problem;
      line.problem = http::problem_from_json(dump(value["problem"]));
    } else {
      line.progress = value.at("progress");
      line.stage = value.at("stage");
    }
    return line;
  } catch (const json::exception& fault) {
    return Error{ErrorCode::malformed, "", fault.what()};
  }
}

}  // namespace semblante::jobs
