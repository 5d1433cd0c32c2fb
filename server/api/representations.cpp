#include "server/api/representations.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "server/store/frame_json.h"

namespace semblante::api {
namespace {

constexpr auto package_names = std::to_array<std::string_view>({"mesh.drc", "weights", "rig.json", "face.glb"});

/// The artefacts of one level, by the names in URLs.
answer::Members<answer::Artefact> artefacts_of_level(const store::ModelRecord& model,
                                                     const std::vector<store::ArtefactRecord>& artefacts,
                                                     std::size_t lod) {
  answer::Members<answer::Artefact> level;
  for (const auto name : package_names) {
    const auto kept_as = store::artefact_name(lod, name);
    const auto artefact =
        std::find_if(artefacts.begin(), artefacts.end(), [&](const auto& item) { return item.name == kept_as; });
    if (artefact == artefacts.end()) continue;
    auto href = "/v1/models/" + model.id + "/" + std::string(name);
    if (lod > 0) href += "?lod=" + std::to_string(lod);
    level.emplace_back(name, answer::Artefact{.href = std::move(href),
                                              .sha256 = artefact->sha256,
                                              .bytes = artefact->bytes,
                                              .content_type = artefact->content_type});
  }
  return level;
}

std::optional<answer::Model::Package> represent_package(const store::ModelRecord& model,
                                                        const std::vector<store::ArtefactRecord>& artefacts) {
  if (!model.package) return std::nullopt;
  std::vector<answer::Level> levels;
  for (const auto& level : model.package->levels) {
    const auto lod = levels.size();
    levels.push_back({.lod = lod,
                      .vertices = level.vertices,
                      .triangles = level.triangles,
                      .artefacts = artefacts_of_level(model, artefacts, lod)});
  }
  return answer::Model::Package{.parametrization = model.package->parametrization,
                                .created = model.package->created,
                                .metric = model.package->metric,
                                .weights = model.package->weights,
                                .weight_bits = static_cast<std::uint64_t>(model.package->weight_bits),
                                .artefacts = artefacts_of_level(model, artefacts, 0),
                                .levels = std::move(levels)};
}

std::vector<answer::Part> represent_parts(const store::ModelRecord& model) {
  std::vector<answer::Part> parts;
  for (const auto& part : model.parts)
    parts.push_back({.index = part.index,
                     .name = part.name,
                     .role = part.role,
                     .role_by_user = part.role_by_user,
                     .vertices = part.vertices,
                     .triangles = part.triangles,
                     .bounds = {.min = part.box_min, .max = part.box_max}});
  return parts;
}

answer::Model::Links links_of(const store::ModelRecord& model, bool imported) {
  const auto self = "/v1/models/" + model.id;
  return {.self = self,
          .feature_points = self + "/feature-points",
          .preview = imported ? std::optional(self + "/preview.glb") : std::nullopt,
          .report = model.findings ? std::optional(self + "/report.json") : std::nullopt};
}

}  // namespace

bool is_of_package(std::string_view name) {
  return std::find(package_names.begin(), package_names.end(), name) != package_names.end();
}

answer::Model represent(const store::ModelRecord& model, const std::vector<store::ArtefactRecord>& artefacts) {
  const bool imported = model.state == store::ModelState::ready || model.state == store::ModelState::parametrized;
  std::optional<answer::Bounds> bounds;
  if (imported) bounds = {.min = model.box_min, .max = model.box_max};
  std::optional<answer::JsonText> frame;
  if (model.frame)
    frame = answer::JsonText{
        store::frame_to_json(*model.frame, model.frame_wish).dump(-1, ' ', false, JsonBody::error_handler_t::replace)};
  std::optional<answer::FindingCounts> findings;
  if (model.findings)
    findings = {.errors = model.findings->errors, .warnings = model.findings->warnings, .notes = model.findings->notes};
  std::vector<answer::Model::MorphTargetsItem> targets;
  for (const auto& target : model.morph_targets) targets.push_back({.name = target.name, .vertices = target.vertices});
  answer::Members<answer::Model::ExpressionsValue> worn;
  for (const auto& set : model.worn)
    worn.emplace_back(
        set.slot, answer::Model::ExpressionsValue{.expression = set.set, .name = set.name, .revision = set.revision});
  return {.id = model.id,
          .name = model.name,
          .state = store::to_string(model.state),
          .problem = json_or_null(model.problem),
          .created = model.created,
          .updated = model.updated,
          .source = {.format = text_or_null(model.format),
                     .file_name = model.file_name,
                     .bytes = model.source_bytes,
                     .sha256 = model.source_sha256},
          .counts = {.vertices = model.vertices, .triangles = model.triangles, .parts = model.part_count},
          .bounds = bounds,
          .parts = represent_parts(model),
          .frame = std::move(frame),
          .expressions = std::move(worn),
          .morph_targets = std::move(targets),
          .warnings = model.warnings,
          .findings = findings,
          .feature_point_count = model.feature_point_count,
          .package = represent_package(model, artefacts),
          .links = links_of(model, imported)};
}

answer::Job represent(const store::JobRecord& job) {
  return {.id = job.id,
          .kind = job.kind,
          .model = text_or_null(job.model),
          .state = store::to_string(job.state),
          .progress = job.progress,
          .stage = job.stage,
          .created = job.created,
          .updated = job.updated,
          .problem = json_or_null(job.problem),
          .result = json_or_null(job.result)};
}

namespace {

answer::Stream::SubscribersByCoding by_coding(const streams::StreamInfo& stream) {
  const auto of = [&](streams::Coding coding) {
    return stream.subscribers_by_coding[static_cast<std::size_t>(coding)];
  };
  return {.packed = of(streams::Coding::packed), .json = of(streams::Coding::json)};
}

/// The p99 of the lateness, ms: the upper bound of its bucket; null before anything was sent, and above the last bound.
std::optional<double> lateness_p99(const metrics::LatenessValues& lateness) {
  const auto count = lateness.count();
  if (count == 0) return std::nullopt;
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < metrics::lateness_bounds.upper.size(); ++i) {
    below += lateness.buckets[i];
    if (static_cast<double>(below) >= 0.99 * static_cast<double>(count))
      return metrics::lateness_bounds.upper[i] * 1000.0;
  }
  return std::nullopt;
}

}  // namespace

answer::Stream represent(const streams::StreamInfo& stream) {
  const auto& settings = stream.settings;
  std::optional<answer::Stream::ActiveSource> active;
  if (stream.active_source) active = streams::source_names[static_cast<std::size_t>(*stream.active_source)];
  return {.id = stream.id,
          .title = settings.title,
          .model = text_or_null(settings.model),
          .created = stream.created,
          .epoch = stream.epoch,
          .sequence = stream.sequence,
          .subscribers = stream.subscribers,
          .publishers = stream.publishers,
          .source = stream.source,
          .active_source = std::move(active),
          .batch_interval = settings.batch_interval,
          .quantizer_scale = settings.quantizer_scale,
          .is_public = settings.is_public,
          .subscribers_by_coding = by_coding(stream),
          .bytes_sent = stream.counts.bytes_sent,
          .messages_coalesced = stream.counts.messages_replaced,
          .lateness_p99 = lateness_p99(stream.counts.lateness),
          .clamped_values = stream.clamped_values,
          .viseme_share = settings.viseme_share,
          .playing = stream.playing ? std::optional(represent(*stream.playing)) : std::nullopt,
          .failed = stream.failed ? std::optional(represent(*stream.failed)) : std::nullopt};
}

answer::Playing represent(const streams::PlayStatus& playing) {
  return {.id = playing.id,
          .kind = playing.kind,
          .name = playing.name,
          .duration = playing.duration > 0.0 ? std::optional(playing.duration) : std::nullopt,
          .position = std::round(playing.position),
          .fps = playing.rate,
          .loop = playing.loop,
          .complete = playing.making.complete,
          .failure = playing.making.failure.empty() ? std::nullopt : std::optional(playing.making.failure)};
}

answer::Expression represent(const store::SetRecord& set) {
  return {.id = set.id,
          .name = set.name,
          .kind = set.kind,
          .built_in = false,
          .revision = set.revision,
          .created = set.created,
          .updated = set.updated,
          .source = json_or_null(set.source),
          .href = "/v1/expressions/" + set.id};
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
