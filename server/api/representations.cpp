#include "server/api/representations.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "server/store/frame_json.h"

namespace semblante::api {
namespace {

Json json_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json::parse(text, nullptr, false); }

Json box(const std::array<double, 3>& low, const std::array<double, 3>& high) { return {{"min", low}, {"max", high}}; }

constexpr auto package_names = std::to_array<std::string_view>({"mesh.drc", "weights", "rig.json", "face.glb"});

/// The artefacts of one level, by the name a client asks for.
Json artefacts_of_level(const store::ModelRecord& model, const std::vector<store::ArtefactRecord>& artefacts,
                        std::size_t lod) {
  Json json = Json::object();
  for (const auto name : package_names) {
    const auto kept_as = store::artefact_name(lod, name);
    const auto artefact =
        std::find_if(artefacts.begin(), artefacts.end(), [&](const auto& item) { return item.name == kept_as; });
    if (artefact == artefacts.end()) continue;
    auto href = "/v1/models/" + model.id + "/" + std::string(name);
    if (lod > 0) href += "?lod=" + std::to_string(lod);
    json[name] = {{"href", href},
                  {"sha256", artefact->sha256},
                  {"bytes", artefact->bytes},
                  {"content_type", artefact->content_type}};
  }
  return json;
}

Json represent_package(const store::ModelRecord& model, const std::vector<store::ArtefactRecord>& artefacts) {
  if (!model.package) return nullptr;
  Json json = {{"parametrization", model.package->parametrization},
               {"created", model.package->created},
               {"metric", model.package->metric},
               {"weights", model.package->weights},
               {"weight_bits", model.package->weight_bits},
               {"artefacts", artefacts_of_level(model, artefacts, 0)},
               {"levels", Json::array()}};
  const auto& levels = model.package->levels;
  for (std::size_t lod = 0; lod < levels.size(); ++lod)
    json["levels"].push_back({{"lod", lod},
                              {"vertices", levels[lod].vertices},
                              {"triangles", levels[lod].triangles},
                              {"artefacts", artefacts_of_level(model, artefacts, lod)}});
  return json;
}

}  // namespace

bool is_of_package(std::string_view name) {
  return std::find(package_names.begin(), package_names.end(), name) != package_names.end();
}

Json represent(const store::ModelRecord& model, const std::vector<store::ArtefactRecord>& artefacts) {
  const auto self = "/v1/models/" + model.id;
  Json json;
  json["id"] = model.id;
  json["name"] = model.name;
  json["state"] = std::string(store::to_string(model.state));
  json["problem"] = json_or_null(model.problem);
  json["created"] = model.created;
  json["updated"] = model.updated;
  json["source"] = {{"format", model.format.empty() ? Json(nullptr) : Json(model.format)},
                    {"file_name", model.file_name},
                    {"bytes", model.source_bytes},
                    {"sha256", model.source_sha256}};
  json["counts"] = {{"vertices", model.vertices}, {"triangles", model.triangles}, {"parts", model.parts.size()}};
  const bool imported = model.state == store::ModelState::ready || model.state == store::ModelState::parametrized;
  json["bounds"] = imported ? box(model.box_min, model.box_max) : Json(nullptr);
  auto& parts = json["parts"] = Json::array();
  for (std::size_t i = 0; i < model.parts.size(); ++i) {
    const auto& part = model.parts[i];
    parts.push_back({{"index", i},
                     {"name", part.name},
                     {"role", part.role},
                     {"role_by_user", part.role_by_user},
                     {"vertices", part.vertices},
                     {"triangles", part.triangles},
                     {"bounds", box(part.box_min, part.box_max)}});
  }
  json["frame"] = nullptr;
  if (model.frame) json["frame"] = store::frame_to_json(*model.frame, model.frame_wish);
  auto& targets = json["morph_targets"] = Json::array();
  for (const auto& target : model.morph_targets)
    targets.push_back({{"name", target.name}, {"vertices", target.vertices}});
  json["warnings"] = model.warnings;
  json["findings"] = nullptr;
  if (model.findings)
    json["findings"] = {
        {"errors", model.findings->errors}, {"warnings", model.findings->warnings}, {"notes", model.findings->notes}};
  json["feature_point_count"] = model.feature_point_count;
  json["package"] = represent_package(model, artefacts);
  auto& worn = json["expressions"] = Json::object();
  for (const auto& set : model.worn)
    worn[set.slot] = {{"expression", set.set}, {"name", set.name}, {"revision", set.revision}};
  json["links"] = {{"self", self},
                   {"feature_points", self + "/feature-points"},
                   {"preview", imported ? Json(self + "/preview.glb") : Json(nullptr)},
                   {"report", model.findings ? Json(self + "/report.json") : Json(nullptr)}};
  return json;
}

Json represent(const store::JobRecord& job) {
  return {{"id", job.id},
          {"kind", job.kind},
          {"model", job.model.empty() ? Json(nullptr) : Json(job.model)},
          {"state", std::string(store::to_string(job.state))},
          {"progress", job.progress},
          {"stage", job.stage},
          {"created", job.created},
          {"updated", job.updated},
          {"problem", json_or_null(job.problem)},
          {"result", json_or_null(job.result)}};
}

namespace {

Json by_coding(const streams::StreamInfo& stream) {
  Json json = Json::object();
  for (std::size_t i = 0; i < streams::coding_count; ++i)
    json[std::string(streams::coding_names[i])] = stream.subscribers_by_coding[i];
  return json;
}

/// ms: the bound of the bucket that the hundredth part of all is above; null before anything was sent, and beyond the
/// last bound.
Json lateness_p99(const metrics::LatenessValues& lateness) {
  const auto count = lateness.count();
  if (count == 0) return nullptr;
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < metrics::lateness_bounds.upper.size(); ++i) {
    below += lateness.buckets[i];
    if (static_cast<double>(below) >= 0.99 * static_cast<double>(count))
      return metrics::lateness_bounds.upper[i] * 1000.0;
  }
  return nullptr;
}

}  // namespace

Json represent(const streams::StreamInfo& stream) {
  Json json = {{"id", stream.id}};
  settings::write_stream_settings(json, stream.settings);
  json.update({{"created", stream.created},
               {"epoch", stream.epoch},
               {"sequence", stream.sequence},
               {"subscribers", stream.subscribers},
               {"publishers", stream.publishers},
               {"source", stream.source},
               {"active_source", stream.active_source
                                     ? Json(streams::source_names[static_cast<std::size_t>(*stream.active_source)])
                                     : Json(nullptr)},
               {"subscribers_by_coding", by_coding(stream)},
               {"bytes_sent", stream.counts.bytes_sent},
               {"messages_coalesced", stream.counts.messages_replaced},
               {"lateness_p99", lateness_p99(stream.counts.lateness)},
               {"clamped_values", stream.clamped_values},
               {"playing", stream.playing ? represent(*stream.playing) : Json(nullptr)}});
  return json;
}

Json represent(const streams::PlayStatus& playing) {
  return {{"id", playing.id},
          {"kind", playing.kind},
          {"name", playing.name},
          {"duration", playing.duration > 0.0 ? Json(playing.duration) : Json(nullptr)},
          {"position", std::round(playing.position)},
          {"fps", playing.rate},
          {"loop", playing.loop}};
}

Json represent(const store::SetRecord& set) {
  return {{"id", set.id},
          {"name", set.name},
          {"kind", set.kind},
          {"built_in", false},
          {"revision", set.revision},
          {"created", set.created},
          {"updated", set.updated},
          {"source", json_or_null(set.source)},
          {"href", "/v1/expressions/" + set.id}};
}

std::string set_etag(const store::SetRecord& set) { return "\"set-" + std::to_string(set.revision) + "\""; }

std::string model_etag(const store::ModelRecord& model) { return "\"model-" + std::to_string(model.revision) + "\""; }

std::string points_etag(const store::ModelRecord& model) {
  return "\"points-" + std::to_string(model.feature_points_revision) + "\"";
}

http::Response json_response(int status, const Json& json) {
  http::Response response;
  response.status = status;
  response.headers["Content-Type"] = "application/json";
  response.headers["Cache-Control"] = "no-cache";
  response.body = json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  return response;
}

}  // namespace semblante::api
