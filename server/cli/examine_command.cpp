#include <algorithm>
#include <iostream>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "core/anatomy/part_roles.h"
#include "core/doctor/examine.h"
#include "server/cli/command_failure.h"
#include "server/cli/commands.h"
#include "server/cli/head_input.h"
#include "server/report/report_json.h"
#include "server/store/frame_json.h"

namespace semblante {
namespace {

struct ExamineCommand {
  HeadOptions head;
  bool json = false;
};

/// The report of a head, and its frame.
struct Examination {
  Report report;
  ModelFrame frame;
  FrameWish wish;
};

/// Without feature points: findings from the mesh alone.
Examination examine_shape(HeadFiles files, const HeadOptions& options) {
  const auto head = stand_head(std::move(files.head), {files.wish, {}, {}});
  if (!head) fail(options.model_path, head.error());
  print_warnings(head->warnings.all(), options.quiet);
  const auto parts = describe_parts(head->model, head->surface, {});
  return {examine_mesh(head->model, head->surface, parts), head->frame, head->frame_wish};
}

/// Points that cannot be placed are findings too.
Examination examine_with_points(HeadFiles files, const HeadOptions& options) {
  MarkedHead marked = place_points(std::move(files), options, true);
  // Without the warnings of the rig: the report has the same findings, with place and remedy.
  print_warnings(marked.warnings.all(), options.quiet);
  const RiggedHead head = rig(std::move(marked), options);
  Report report = examine(head.model, head.surface, head.rig, rig_request(options).weights);
  report.findings.insert(report.findings.begin(), head.refused.begin(), head.refused.end());
  return {std::move(report), head.frame, head.frame_wish};
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
  HeadFiles files = read_head(options.head);
  const auto [report, frame, wish] = options.head.feature_points_path.empty()
                                         ? examine_shape(std::move(files), options.head)
                                         : examine_with_points(std::move(files), options.head);
  if (options.json) {
    const ReportSection section{"frame", store::frame_to_json(frame, wish)};
    std::cout << write_report(report, {&section, 1});
  } else {
    print(report, std::cout);
    print(frame, std::cout);
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
