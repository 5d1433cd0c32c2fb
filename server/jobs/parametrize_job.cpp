#include "server/jobs/parametrize_job.h"

#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/doctor/examine.h"
#include "core/extract/own_sets.h"
#include "core/extract/set_file.h"
#include "core/pipeline/levelled.h"
#include "protocol/package/pack_head.h"
#include "server/jobs/request_head.h"
#include "server/jobs/result_facts.h"
#include "server/jobs/result_files.h"
#include "server/report/articulation_json.h"
#include "server/report/fit_json.h"
#include "server/report/levels_json.h"
#include "server/store/frame_json.h"
#include "server/store/record_json.h"
#include "server/store/whole_number.h"

namespace semblante::jobs {
namespace {

Result<RigRequest> rig_request(const ParametrizeJob& options) {
  const auto weights = parse_weight_method(options.weights);
  if (!weights)
    return Error{ErrorCode::invalid_argument, "/weights", "there are no weights \"" + options.weights + "\""};
  const auto metric = parse_distance_metric(options.metric);
  if (!metric) return Error{ErrorCode::invalid_argument, "/metric", "there is no metric \"" + options.metric + "\""};
  return RigRequest{*weights, *metric, options.articulation};
}

/// The sets were checked before they were stored: one that cannot be read is an internal error.
Result<std::vector<NamedSet>> sets_of(const std::vector<store::WornSet>& worn) {
  std::vector<NamedSet> sets;
  for (const auto& record : worn) {
    auto displacements = parse_set_displacements(record.displacements);
    if (!displacements) return Error{ErrorCode::internal, displacements.error().where, displacements.error().message};
    NamedSet set;
    set.name = record.slot;
    set.displacements = std::move(*displacements);
    sets.push_back(std::move(set));
  }
  return sets;
}

Result<LevelledHead> make_head(const ParametrizeJob::Request& request, const InputFiles& inputs, const RigRequest& rig,
                               const Progress& progress, Report& report) {
  auto imported = import_source(request.head.model, inputs, part_of(progress, 0.02, 0.06));
  if (!imported) return imported.error();
  auto marked = mark_source(std::move(*imported), request.head, part_of(progress, 0.06, 0.08));
  if (!marked) return marked.error();
  auto rigged = rig_head(std::move(*marked), rig, part_of(progress, 0.08, 0.72));
  if (!rigged) return rigged.error();
  if (auto told = report_progress(progress, 0.72, "report"); !told) return told.error();
  report = examine(rigged->model, rigged->surface, rigged->rig, rig.weights);
  return level_head(std::move(*rigged), request.options.lods, part_of(progress, 0.74, 0.82));
}

/// The preview of a head that its points turned. It has the vertices of the file alone, by which users mark points, so
/// where the points have vertices of their own the file is read again.
Status write_turned_preview(const LevelledHead& head, const ParametrizeJob::Request& request, const InputFiles& inputs,
                            ResultFiles& files) {
  if (head.inserted.empty()) return files.write_preview(head, head.rig.parts);
  auto imported = import_source(request.head.model, inputs, {});
  if (!imported) return imported.error();
  const auto standing = stand_head(std::move(*imported), {request.head.model.frame_wish, head.frame, {}});
  if (!standing) return standing.error();
  return files.write_preview(*standing, head.rig.parts);
}

}  // namespace

Result<ParametrizeJob::Request> ParametrizeJob::request(const store::JobRecord& job, const JobSources& sources) const {
  const auto model = model_of(job, sources);
  if (!model) return model.error();
  auto head = marked_source_of(*model, sources);
  auto worn = sets_of(sources.store.worn_sets(model->id));
  if (!worn) return worn.error();
  return Request{model->name, std::move(head), *this, std::move(*worn)};
}

Result<ParametrizeJob::Outcome> ParametrizeJob::run(const Request& request, const InputFiles& inputs,
                                                    ResultFiles& files, const Progress& progress) {
  const auto rig = rig_request(request.options);
  if (!rig) return rig.error();
  Report report;
  const auto head = make_head(request, inputs, *rig, progress, report);
  if (!head) return head.error();
  std::vector<NamedSet> worn = request.worn;
  std::vector<std::string> own_words;
  if (request.options.expressions == "own") {
    auto own = own_sets(head->model, head->points, head->rig.fapu);
    if (!own) return own.error();
    wear_own(worn, std::move(own->sets));
    own_words = std::move(own->words);
  }
  const auto errors = measure_levels(*head, part_of(progress, 0.82, 0.86));
  if (!errors) return errors.error();
  const auto packages = pack_head(*head, {request.model_name, request.options.weight_bits, std::move(worn)},
                                  part_of(progress, 0.86, 0.96));
  if (!packages) return packages.error();

  if (auto told = report_progress(progress, 0.96, "writing"); !told) return told.error();
  Outcome outcome;
  outcome.parts = records_of(head->rig.parts);
  outcome.warnings = head->warnings.all();
  outcome.warnings.insert(outcome.warnings.end(), own_words.begin(), own_words.end());
  outcome.findings = counts_of(report);
  outcome.frame.frame = head->frame;
  std::tie(outcome.frame.box_min, outcome.frame.box_max) = box_of(head->model);
  for (const FacePackage& package : *packages) outcome.levels.push_back({package.vertices, package.triangles});
  if (auto written = files.write_packages(*packages); !written) return written.error();
  const double eye_separation = 1024.0 * head->rig.fapu[FapuUnit::es].value_or(0.0);
  auto levels = levels_of_detail_json(head->levels, *errors, head->poses, eye_separation, head->missed);
  std::vector<ReportSection> sections = {{"levels_of_detail", std::move(levels)}};
  sections.push_back({"articulation", articulation_json({head->rig.articulation, head->articulation_reason})});
  if (head->rig.fit) sections.push_back({"weight_fit", weight_fit_json(*head->rig.fit)});
  if (auto written = files.write_report(report, head->frame, request.head.model.frame_wish, std::move(sections));
      !written)
    return written.error();
  if (head->turn) {
    outcome.frame.turn = rows_of(*head->turn);
    if (auto written = write_turned_preview(*head, request, inputs, files); !written) return written.error();
  }
  return outcome;
}

std::vector<std::string> ParametrizeJob::finish(store::JobRecord& job, Outcome outcome,
                                                const std::vector<store::ArtefactRecord>& artefacts,
                                                store::JobStore& store) const {
  const store::PackageRecord package{job.id,      store::timestamp_now(),   metric, weights,
                                     weight_bits, std::move(outcome.levels)};
  return store
      .finish_parametrization(job, package, outcome.parts, outcome.warnings, outcome.findings, artefacts, outcome.frame)
      .value_or(std::vector<std::string>{});
}

void to_json(nlohmann::json& json, const ParametrizeJob& job) {
  json = {{"metric", job.metric}, {"weights", job.weights}, {"weight_bits", job.weight_bits}, {"lods", job.lods}};
  if (job.expressions != "library") json["expressions"] = job.expressions;
  if (job.articulation) json["articulation"] = *job.articulation;
}

void from_json(const nlohmann::json& json, ParametrizeJob& job) {
  json.at("metric").get_to(job.metric);
  json.at("weights").get_to(job.weights);
  store::get_whole(json.at("weight_bits"), job.weight_bits);
  if (json.contains("articulation")) job.articulation = json["articulation"].get<double>();
  job.lods.clear();
  for (const auto& budget : json.at("lods")) job.lods.push_back(store::whole_number<std::uint32_t>(budget));
  job.expressions = json.value("expressions", "library");
}

void to_json(nlohmann::json& json, const ParametrizeJob::Request& request) {
  json = {{"name", request.model_name},
          {"head", request.head},
          {"options", request.options},
          {"worn", nlohmann::json::object()}};
  for (const auto& set : request.worn) json["worn"][set.name] = displacements_to_json(set.displacements);
}

void from_json(const nlohmann::json& json, ParametrizeJob::Request& request) {
  json.at("name").get_to(request.model_name);
  json.at("head").get_to(request.head);
  json.at("options").get_to(request.options);
  for (const auto& [slot, value] : json.at("worn").items()) {
    auto displacements = displacements_from_json(value);
    if (!displacements) throw std::invalid_argument("/worn/" + slot + ": " + displacements.error().message);
    NamedSet set;
    set.name = slot;
    set.displacements = std::move(*displacements);
    request.worn.push_back(std::move(set));
  }
}

void to_json(nlohmann::json& json, const ParametrizeJob::Outcome& outcome) {
  json = {{"parts", outcome.parts},       {"warnings", outcome.warnings}, {"findings", outcome.findings},
          {"min", outcome.frame.box_min}, {"max", outcome.frame.box_max}, {"levels", outcome.levels}};
  if (outcome.frame.frame) json["frame"] = store::frame_to_json(*outcome.frame.frame, {});
  if (outcome.frame.turn) json["turn"] = *outcome.frame.turn;
}

void from_json(const nlohmann::json& json, ParametrizeJob::Outcome& outcome) {
  json.at("parts").get_to(outcome.parts);
  json.at("warnings").get_to(outcome.warnings);
  json.at("findings").get_to(outcome.findings);
  json.at("min").get_to(outcome.frame.box_min);
  json.at("max").get_to(outcome.frame.box_max);
  json.at("levels").get_to(outcome.levels);
  if (json.contains("frame")) outcome.frame.frame = store::frame_from_json(json["frame"]);
  if (json.contains("turn")) outcome.frame.turn = json["turn"].get<store::Turn>();
}

}  // namespace semblante::jobs
