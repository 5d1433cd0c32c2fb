#include "server/store/facts_json.h"

#include <nlohmann/json.hpp>

namespace semblante::store {

std::string write_facts(const ModelRecord& model) {
  nlohmann::json json;
  json["min"] = model.box_min;
  json["max"] = model.box_max;
  json["warnings"] = model.warnings;
  if (model.findings)
    json["findings"] = {
        {"errors", model.findings->errors}, {"warnings", model.findings->warnings}, {"notes", model.findings->notes}};
  auto& parts = json["parts"] = nlohmann::json::array();
  for (const auto& part : model.parts)
    parts.push_back({{"name", part.name},
                     {"role", part.role},
                     {"by_user", part.role_by_user},
                     {"vertices", part.vertices},
                     {"triangles", part.triangles},
                     {"min", part.box_min},
                     {"max", part.box_max}});
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void read_facts(std::string_view text, ModelRecord& model) {
  try {
    const auto json = nlohmann::json::parse(text);
    model.box_min = json.at("min");
    model.box_max = json.at("max");
    model.warnings = json.at("warnings").get<std::vector<std::string>>();
    model.findings.reset();
    if (json.contains("findings")) {  // a store of before there was a doctor has none
      const auto& item = json["findings"];
      model.findings = FindingCounts{item.at("errors"), item.at("warnings"), item.at("notes")};
    }
    for (const auto& item : json.at("parts")) {
      PartRecord part;
      part.name = item.at("name");
      part.role = item.at("role");
      part.role_by_user = item.at("by_user");
      part.vertices = item.at("vertices");
      part.triangles = item.at("triangles");
      part.box_min = item.at("min");
      part.box_max = item.at("max");
      model.parts.push_back(std::move(part));
    }
  } catch (const nlohmann::json::exception&) {
    model.parts.clear();
    model.findings.reset();
    model.warnings.clear();
  }
}

}  // namespace semblante::store
