#include <memory>
#include <ostream>
#include <utility>

#include <CLI/CLI.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "core/pipeline/proposed.h"
#include "server/cli/command_failure.h"
#include "server/cli/commands.h"
#include "server/cli/files.h"
#include "server/cli/head_input.h"

namespace semblante {
namespace {

using Json = nlohmann::ordered_json;

struct ProposeCommand {
  HeadOptions head;
  std::string out = "-";
};

/// In the axes of the model's file and with its vertices only, like feature point files.
Json to_json(const FeaturePoint& point, const MarkedHead& head) {
  const glm::dvec3 p = glm::inverse(head.to_mpeg4) * glm::dvec3(point.position);
  Json json = {{"vertex", nullptr}, {"position", {p.x, p.y, p.z}}};
  if (point.vertex && head.is_of_file(*point.vertex)) json["vertex"] = point.vertex->value();
  return json;
}

Json document(const MarkedHead& head, const Proposals& proposals) {
  std::array<Json, feature_point_count> by_id;
  for (const FeaturePoint& point : head.points) by_id[point.id.value()] = to_json(point, head);
  for (const Proposal& proposal : proposals.points) {
    Json json = to_json(proposal.point, head);
    json["proposed"] = true;
    json["method"] = proposal_method_names[static_cast<std::size_t>(proposal.method)];
    json["confidence"] = confidence_names[static_cast<std::size_t>(proposal.confidence)];
    json["expected_error"] = proposal.expected_error;
    if (!proposal.remark.empty()) json["remark"] = proposal.remark;
    by_id[proposal.point.id.value()] = std::move(json);
  }
  Json result = Json::object();
  // Axes that nobody set, and that do not turn the head, are left to all points: they show what twenty are too few for,
  // as that a head is tilted.
  if (head.frame_wish.has_axes() || head.to_mpeg4 != glm::dmat3(1.0)) {
    const glm::dmat3& to_mpeg4 = head.to_mpeg4;
    for (int row = 0; row < 3; ++row) {
      result["to_mpeg4_axes"].push_back({to_mpeg4[0][row], to_mpeg4[1][row], to_mpeg4[2][row]});
    }
  }
  result["points"] = Json::object();
  result["not_proposed"] = Json::object();
  for (std::uint8_t id = 0; id < feature_point_count; ++id) {
    if (!by_id[id].is_null()) result["points"][to_string(FeaturePointId(id))] = std::move(by_id[id]);
  }
  for (const NotProposed& point : proposals.not_proposed) result["not_proposed"][to_string(point.id)] = point.reason;
  return result;
}

void run(const ProposeCommand& options) {
  HeadFiles files = read_head(options.head);
  // Proposals of an earlier run are replaced by new ones from the points that a user placed.
  std::erase_if(files.points.points, [](const MarkedPoint& point) { return point.proposed; });
  const MarkedHead head = place_points(std::move(files), options.head);
  const auto proposals = propose_points(head);
  if (!proposals) {
    const std::string& points = options.head.feature_points_path;
    fail(points.empty() ? options.head.model_path : points, proposals.error());
  }
  const Json json = document(head, *proposals);
  write_file(options.out, [&json](std::ostream& out) { out << json.dump(1) << "\n"; });
  print_warnings(head.warnings.all(), options.head.quiet);
}

}  // namespace

void add_propose_command(CLI::App& app) {
  auto options = std::make_shared<ProposeCommand>();
  CLI::App* const command = app.add_subcommand("propose",
                                               "Propose the feature points that nobody placed, from those that are or "
                                               "else from the shape of the face, for a look "
                                               "and a correction");
  add_file_options(*command, options->head, PointsOption::optional);
  command->add_option("--out", options->out, "Write all points here, the proposed ones marked; - is standard output")
      ->capture_default_str()
      ->envname("SEMBLANTE_OUT");
  command->callback([options] { run(*options); });
}

}  // namespace semblante
