#include "server/store/record_json.h"

#include <nlohmann/json.hpp>

namespace semblante::store {

void to_json(nlohmann::json& json, const PartRecord& part) {
  json = {{"name", part.name},         {"role", part.role},           {"by_user", part.role_by_user},
          {"vertices", part.vertices}, {"triangles", part.triangles}, {"min", part.box_min},
          {"max", part.box_max}};
}

void from_json(const nlohmann::json& json, PartRecord& part) {
  json.at("name").get_to(part.name);
  json.at("role").get_to(part.role);
  json.at("by_user").get_to(part.role_by_user);
  json.at("vertices").get_to(part.vertices);
  json.at("triangles").get_to(part.triangles);
  json.at("min").get_to(part.box_min);
  json.at("max").get_to(part.box_max);
}

void to_json(nlohmann::json& json, const MorphTargetRecord& target) {
  json = {{"name", target.name}, {"vertices", target.vertices}};
}

void from_json(const nlohmann::json& json, MorphTargetRecord& target) {
  target = {json.at("name"), json.at("vertices")};
}

void to_json(nlohmann::json& json, const FindingCounts& counts) {
  json = {{"errors", counts.errors}, {"warnings", counts.warnings}, {"notes", counts.notes}};
}

void from_json(const nlohmann::json& json, FindingCounts& counts) {
  json.at("errors").get_to(counts.errors);
  json.at("warnings").get_to(counts.warnings);
  json.at("notes").get_to(counts.notes);
}

void to_json(nlohmann::json& json, const ExtractionRecord& e) {
  json = {{"name", e.name},
          {"kind", e.kind},
          {"align", e.align},
          {"least", e.least},
          {"strength", e.strength},
          {"target", e.target},
          {"from", e.from},
          {"expression_file", e.expression_file},
          {"expression_sha256", e.expression_sha256},
          {"neutral_file", e.neutral_file},
          {"neutral_sha256", e.neutral_sha256},
          {"points", e.points}};
}

void from_json(const nlohmann::json& json, ExtractionRecord& e) {
  json.at("name").get_to(e.name);
  json.at("kind").get_to(e.kind);
  json.at("align").get_to(e.align);
  json.at("least").get_to(e.least);
  json.at("strength").get_to(e.strength);
  json.at("target").get_to(e.target);
  json.at("from").get_to(e.from);
  json.at("expression_file").get_to(e.expression_file);
  json.at("expression_sha256").get_to(e.expression_sha256);
  json.at("neutral_file").get_to(e.neutral_file);
  json.at("neutral_sha256").get_to(e.neutral_sha256);
  json.at("points").get_to(e.points);
}

void to_json(nlohmann::json& json, const WornSet& worn) {
  json = {{"slot", worn.slot},
          {"set", worn.set},
          {"name", worn.name},
          {"revision", worn.revision},
          {"displacements", worn.displacements}};
}

void from_json(const nlohmann::json& json, WornSet& worn) {
  json.at("slot").get_to(worn.slot);
  json.at("set").get_to(worn.set);
  json.at("name").get_to(worn.name);
  json.at("revision").get_to(worn.revision);
  json.at("displacements").get_to(worn.displacements);
}

void to_json(nlohmann::json& json, const LevelRecord& level) {
  json = {{"vertices", level.vertices}, {"triangles", level.triangles}};
}

void from_json(const nlohmann::json& json, LevelRecord& level) {
  json.at("vertices").get_to(level.vertices);
  json.at("triangles").get_to(level.triangles);
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
  if (json.contains("vertex")) point.vertex = json["vertex"].get<std::uint32_t>();
  if (json.contains("position")) point.position = json["position"].get<std::array<double, 3>>();
  if (json.contains("proposal")) point.proposal = json["proposal"].get<ProposalRecord>();
}

}  // namespace semblante::store
