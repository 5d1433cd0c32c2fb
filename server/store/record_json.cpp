#include "server/store/record_json.h"

#include <nlohmann/json.hpp>

#include "server/store/whole_number.h"

namespace semblante::store {

void to_json(nlohmann::json& json, const PartRecord& part) {
  json = {{"index", part.index},          {"name", part.name},         {"role", part.role},
          {"by_user", part.role_by_user}, {"vertices", part.vertices}, {"triangles", part.triangles},
          {"min", part.box_min},          {"max", part.box_max}};
}

void from_json(const nlohmann::json& json, PartRecord& part) {
  json.at("name").get_to(part.name);
  json.at("role").get_to(part.role);
  json.at("by_user").get_to(part.role_by_user);
  get_whole(json.at("vertices"), part.vertices);
  get_whole(json.at("triangles"), part.triangles);
  json.at("min").get_to(part.box_min);
  json.at("max").get_to(part.box_max);
  if (json.contains("index")) get_whole(json["index"], part.index);
}

void to_json(nlohmann::json& json, const MorphTargetRecord& target) {
  json = {{"name", target.name}, {"vertices", target.vertices}};
}

void from_json(const nlohmann::json& json, MorphTargetRecord& target) {
  target = {json.at("name"), whole_number<std::uint32_t>(json.at("vertices"))};
}

void to_json(nlohmann::json& json, const FindingCounts& counts) {
  json = {{"errors", counts.errors}, {"warnings", counts.warnings}, {"notes", counts.notes}};
}

void from_json(const nlohmann::json& json, FindingCounts& counts) {
  get_whole(json.at("errors"), counts.errors);
  get_whole(json.at("warnings"), counts.warnings);
  get_whole(json.at("notes"), counts.notes);
}

void to_json(nlohmann::json& json, const LevelRecord& level) {
  json = {{"vertices", level.vertices}, {"triangles", level.triangles}};
}

void from_json(const nlohmann::json& json, LevelRecord& level) {
  get_whole(json.at("vertices"), level.vertices);
  get_whole(json.at("triangles"), level.triangles);
}

void to_json(nlohmann::json& json, const ProposalRecord& proposal) {
  json = {
      {"method", proposal.method}, {"confidence", proposal.confidence}, {"expected_error", proposal.expected_error}};
  if (!proposal.remark.empty()) json["remark"] = proposal.remark;
}

void from_json(const nlohmann::json& json, ProposalRecord& proposal) {
  json.at("method").get_to(proposal.method);
  json.at("confidence").get_to(proposal.confidence);
  json.at("expected_error").get_to(proposal.expected_error);
  proposal.remark = json.value("remark", std::string());
}

void to_json(nlohmann::json& json, const FeaturePointRecord& point) {
  json = {{"id", point.id}};
  if (point.vertex) json["vertex"] = *point.vertex;
  if (point.position) json["position"] = *point.position;
  if (point.proposal) json["proposal"] = *point.proposal;
}

void from_json(const nlohmann::json& json, FeaturePointRecord& point) {
  json.at("id").get_to(point.id);
  if (json.contains("vertex")) point.vertex = whole_number<std::uint32_t>(json["vertex"]);
  if (json.contains("position")) point.position = json["position"].get<std::array<double, 3>>();
  if (json.contains("proposal")) point.proposal = json["proposal"].get<ProposalRecord>();
}

}  // namespace semblante::store
