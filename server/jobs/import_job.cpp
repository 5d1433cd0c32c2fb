#include "server/jobs/import_job.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "core/anatomy/part_roles.h"
#include "core/doctor/examine.h"
#include "core/materials/painted_eyes.h"
#include "server/jobs/request_head.h"
#include "server/jobs/result_facts.h"
#include "server/jobs/result_files.h"
#include "server/store/frame_json.h"
#include "server/store/record_json.h"
#include "server/store/whole_number.h"

namespace semblante::jobs {

Result<ImportJob::Request> ImportJob::request(const store::JobRecord& job, const JobSources& sources) const {
  const auto model = model_of(job, sources);
  if (!model) return model.error();
  return Request{source_of(*model, sources)};
}

Result<ImportJob::Outcome> ImportJob::run(const Request& request, const InputFiles& inputs, ResultFiles& files,
                                          const Progress& progress) {
  auto imported = import_source(request.model, inputs, part_of(progress, 0.05, 0.5));
  if (!imported) return imported.error();
  auto head = stand_head(std::move(*imported), {request.model.frame_wish, {}, {}}, part_of(progress, 0.5, 0.6));
  if (!head) return head.error();

  Outcome outcome;
  outcome.format = head->model.format;
  outcome.vertices = static_cast<std::uint32_t>(head->model.positions.size());
  outcome.triangles = static_cast<std::uint32_t>(head->model.triangles.size());
  std::tie(outcome.box_min, outcome.box_max) = box_of(head->model);
  outcome.warnings = head->warnings.all();
  outcome.frame = head->frame;
  // The store turns the positions that were marked in the earlier orientation.
  if (request.model.frame && turn_upright(*request.model.frame) != turn_upright(head->frame))
    outcome.turn = rows_of(turn_between(*request.model.frame, head->frame));
  const auto parts = describe_parts(head->model, head->surface, {}, {});
  outcome.parts = records_of(parts);
  outcome.part_count = static_cast<std::uint32_t>(parts.size());
  constexpr std::size_t most_listed = 512;
  for (const Example& example : head->model.examples) {
    if (outcome.morph_targets.size() == most_listed) break;
    outcome.morph_targets.push_back({example.name, static_cast<std::uint32_t>(example.vertices.size())});
  }

  if (auto told = report_progress(progress, 0.6, "report"); !told) return told.error();
  const auto report = examine_mesh(head->model, head->surface, parts);
  outcome.findings = counts_of(report);
  if (auto written = files.write_report(report, head->frame, request.model.frame_wish); !written)
    return written.error();
  if (auto told = report_progress(progress, 0.7, "preview"); !told) return told.error();
  paint_eyes(head->model, head->surface, parts, guessed_eyes(parts));
  if (auto written = files.write_preview(*head, parts); !written) return written.error();
  return outcome;
}

std::vector<std::string> ImportJob::finish(store::JobRecord& job, Outcome outcome,
                                           const std::vector<store::ArtefactRecord>& artefacts,
                                           store::JobStore& store) const {
  store::ModelRecord facts;
  facts.format = std::move(outcome.format);
  facts.vertices = outcome.vertices;
  facts.triangles = outcome.triangles;
  facts.box_min = outcome.box_min;
  facts.box_max = outcome.box_max;
  facts.parts = std::move(outcome.parts);
  facts.part_count = outcome.part_count;
  facts.warnings = std::move(outcome.warnings);
  facts.findings = outcome.findings;
  facts.frame = std::move(outcome.frame);
  facts.morph_targets = std::move(outcome.morph_targets);
  return store.finish_import(job, facts, artefacts, outcome.turn).value_or(std::vector<std::string>{});
}

std::vector<std::string> ImportJob::finish_without_outcome(const store::JobRecord& job, store::JobStore& store) {
  return store.finish_failed_import(job);
}

void to_json(nlohmann::json& json, const ImportJob& /*job*/) { json = nlohmann::json::object(); }
void from_json(const nlohmann::json& /*json*/, ImportJob& /*job*/) {}

void to_json(nlohmann::json& json, const ImportJob::Request& request) { json = {{"model", request.model}}; }

void from_json(const nlohmann::json& json, ImportJob::Request& request) { json.at("model").get_to(request.model); }

void to_json(nlohmann::json& json, const ImportJob::Outcome& outcome) {
  json = {{"format", outcome.format},
          {"vertices", outcome.vertices},
          {"triangles", outcome.triangles},
          {"min", outcome.box_min},
          {"max", outcome.box_max},
          {"parts", outcome.parts},
          {"warnings", outcome.warnings},
          {"findings", outcome.findings},
          {"frame", store::frame_to_json(outcome.frame, {})},
          {"morph_targets", outcome.morph_targets},
          {"part_count", outcome.part_count}};
  if (outcome.turn) json["turn"] = *outcome.turn;
}

void from_json(const nlohmann::json& json, ImportJob::Outcome& outcome) {
  json.at("format").get_to(outcome.format);
  store::get_whole(json.at("vertices"), outcome.vertices);
  store::get_whole(json.at("triangles"), outcome.triangles);
  json.at("min").get_to(outcome.box_min);
  json.at("max").get_to(outcome.box_max);
  json.at("parts").get_to(outcome.parts);
  json.at("warnings").get_to(outcome.warnings);
  json.at("findings").get_to(outcome.findings);
  outcome.frame = store::frame_from_json(json.at("frame"));
  json.at("morph_targets").get_to(outcome.morph_targets);
  store::get_whole(json.at("part_count"), outcome.part_count);
  if (json.contains("turn")) outcome.turn = json["turn"].get<store::Turn>();
}

}  // namespace semblante::jobs
