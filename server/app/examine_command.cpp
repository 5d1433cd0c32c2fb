#include <algorithm>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "core/doctor/examine.h"
#include "core/doctor/marked_points.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/part_roles.h"
#include "server/app/command_failure.h"
#include "server/app/commands.h"
#include "server/app/head_input.h"
#include "server/report/report_json.h"
#include "server/store/frame_json.h"

namespace semblante {
namespace {

struct ExamineCommand {
  HeadOptions head;
  bool json = false;
};

Report examine_files(const HeadFiles& files, const HeadOptions& options) {
  const Surface surface = build_surface(files.model);
  print_warnings(files.model.warnings, options.quiet);
  if (options.feature_points_path.empty())
    return examine_mesh(files.model, surface, describe_parts(files.model, surface, {}));
  PlacedPoints placed = place_what_can_be(files.model, surface, files.marked);
  print_warnings(placed.warnings, options.quiet);
  ParametrizeOptions parametrize_options;
  parametrize_options.weights = parse_weight_method(options.weights).value_or(WeightMethod::paper);
  parametrize_options.metric = parse_distance_metric(options.metric).value_or(DistanceMetric::edge);
  const auto rig = parametrize(files.model, surface, placed.points, parametrize_options);
  if (!rig) fail(options.model_path, rig.error());
  Report report = examine(files.model, surface, *rig, parametrize_options.weights);
  report.findings.insert(report.findings.begin(), placed.refused.begin(), placed.refused.end());
  return report;
}

void print(const Report& report, std::ostream& out) {
  for (const Finding& finding : report.findings) {
    out << severity_names[static_cast<std::size_t>(finding.severity)] << " " << to_string(finding.code) << ": "
        << finding.words << ".\n";
    if (!finding.place.vertices.vertices.empty()) {
      out << "    where: vertex";
      const auto& sample = finding.place.vertices;
      constexpr std::size_t shown = 8;
      for (std::size_t i = 0; i < std::min(shown, sample.vertices.size()); ++i)
        out << (i == 0 ? " " : ", ") << sample.vertices[i].value();
      if (sample.count > shown) out << " and " << sample.count - shown << " more";
      out << "\n";
    } else if (finding.place.position) {
      const auto& p = *finding.place.position;
      out << "    where: (" << p.x << ", " << p.y << ", " << p.z << ")\n";
    }
    out << "    remedy: " << finding.remedy << ".\n";
  }
  const auto counts = report.counts();
  out << counts.errors << (counts.errors == 1 ? " error, " : " errors, ") << counts.warnings
      << (counts.warnings == 1 ? " warning, " : " warnings, ") << counts.notes
      << (counts.notes == 1 ? " note\n" : " notes\n");
}

void print(const ModelFrame& frame, std::ostream& out) {
  out << "Frame: " << to_string(frame.axes.up) << " up, face towards " << to_string(frame.axes.front)
      << (frame.axes_sure ? "" : " (not sure)") << ", unit " << to_string(frame.unit)
      << (frame.unit_sure ? "" : " (not sure)") << "\n";
  for (const std::string& reason : frame.reasons) out << "    " << reason << ".\n";
}

void run(const ExamineCommand& options) {
  const HeadFiles files = read_head(options.head);
  const Report report = examine_files(files, options.head);
  if (options.json) {
    const ReportSection frame{"frame", store::frame_to_json(files.frame, files.wish).dump()};
    std::cout << write_report(report, {&frame, 1});
  } else {
    print(report, std::cout);
    print(files.frame, std::cout);
  }
  if (const auto errors = report.counts().errors; errors > 0)
    throw CommandFailure(CommandFailure::has_errors, options.head.model_path + ": examined, it has " +
                                                         std::to_string(errors) + (errors == 1 ? " error" : " errors"));
}

}  // namespace

void add_examine_command(CLI::App& app) {
  auto options = std::make_shared<ExamineCommand>();
  CLI::App* const command = app.add_subcommand(
      "examine", "Say what is wrong with a head, where, and what to do; exit status 1 if there are errors");
  add_head_options(*command, options->head, PointsOption::optional);
  command->add_flag("--json", options->json, "Print the report as JSON")->envname("SEMBLANTE_JSON");
  command->callback([options] { run(*options); });
}

}  // namespace semblante
