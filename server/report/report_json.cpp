#include "server/report/report_json.h"

namespace semblante {
namespace {

using Json = nlohmann::ordered_json;

Json to_value(const Place& place) {
  Json json;
  json["part"] = place.part ? Json(place.part->value()) : Json(nullptr);
  auto& points = json["points"] = Json::array();
  for (const FeaturePointId id : place.points) points.push_back(to_string(id));
  auto& sample = json["vertices"]["sample"] = Json::array();
  for (const VertexId vertex : place.vertices.vertices) sample.push_back(vertex.value());
  json["vertices"]["count"] = place.vertices.count;
  json["position"] = nullptr;
  if (place.position) json["position"] = {place.position->x, place.position->y, place.position->z};
  return json;
}

Json to_value(const Finding& finding) {
  Json json;
  json["code"] = to_string(finding.code);
  json["severity"] = severity_names[static_cast<std::size_t>(finding.severity)];
  json["words"] = finding.words;
  json["remedy"] = finding.remedy;
  if (finding.move) {
    const glm::dvec3& to = finding.move->position;
    json["move"] = {{"point", to_string(finding.move->point)},
                    {"vertex", finding.move->vertex.value()},
                    {"position", {to.x, to.y, to.z}}};
  }
  json["place"] = to_value(finding.place);
  json["measured"] = nullptr;
  if (finding.measured)
    json["measured"] = {{"what", finding.measured->what},
                        {"value", finding.measured->value},
                        {"threshold", finding.measured->threshold}};
  return json;
}

}  // namespace

std::string write_report(const Report& report, std::span<const ReportSection> sections) {
  const FindingCounts counts = report.counts();
  Json json;
  json["version"] = report_version;
  json["summary"] = {{"errors", counts.errors}, {"warnings", counts.warnings}, {"notes", counts.notes}};
  auto& findings = json["findings"] = Json::array();
  for (const Finding& finding : report.findings) findings.push_back(to_value(finding));
  for (const ReportSection& section : sections) json[section.name] = section.value;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace semblante
