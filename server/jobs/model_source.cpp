#include "server/jobs/model_source.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "server/store/frame_json.h"
#include "server/store/record_json.h"

namespace semblante::jobs {

std::string path_of(const store::BlobStore& blobs, const std::string& sha256, const std::string& what,
                    std::optional<std::uint64_t> bytes) {
  try {
    return blobs.whole(sha256, bytes).string();
  } catch (const store::DamagedBlob& fault) {
    throw store::DamagedBlob(what + ": " + fault.what());
  }
}

Result<store::ModelRecord> model_of(const store::JobRecord& job, const JobSources& sources) {
  auto model = sources.store.model(job.model);
  if (!model) return Error{ErrorCode::missing, "", "the model of this job is gone"};
  return std::move(*model);
}

ModelSource source_of(const store::ModelRecord& model, const JobSources& sources) {
  return ModelSource{path_of(sources.blobs, model.source_sha256, "the model", model.source_bytes), model.file_name,
                     model.frame, model.frame_wish};
}

MarkedSource marked_source_of(const store::ModelRecord& model, const JobSources& sources) {
  return MarkedSource{source_of(model, sources), sources.store.feature_points(model.id), model.parts, model.fapu};
}

void to_json(nlohmann::json& json, const ModelSource& source) {
  json = {
      {"path", source.path}, {"file_name", source.file_name}, {"frame_wish", store::wish_to_json(source.frame_wish)}};
  if (source.frame) json["frame"] = store::frame_to_json(*source.frame, {});
}

void from_json(const nlohmann::json& json, ModelSource& source) {
  json.at("path").get_to(source.path);
  json.at("file_name").get_to(source.file_name);
  source.frame_wish = store::wish_from_json(json.at("frame_wish"));
  if (json.contains("frame")) source.frame = store::frame_from_json(json["frame"]);
}

void to_json(nlohmann::json& json, const MarkedSource& source) {
  json = {{"model", source.model}, {"points", source.points}, {"parts", source.parts}};
  if (!source.fapu.empty()) json["fapu"] = source.fapu;
}

void from_json(const nlohmann::json& json, MarkedSource& source) {
  json.at("model").get_to(source.model);
  json.at("points").get_to(source.points);
  json.at("parts").get_to(source.parts);
  if (json.contains("fapu")) json["fapu"].get_to(source.fapu);
}

}  // namespace semblante::jobs
