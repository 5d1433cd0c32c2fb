#include "server/cli/head_input.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <iostream>
#include <utility>

#include <CLI/CLI.hpp>

#include "core/parametrize/fapu.h"
#include "core/pipeline/proposed.h"
#include "server/cli/command_failure.h"
#include "server/cli/files.h"
#include "server/cli/folder_resources.h"
#include "server/cli/progress_line.h"

namespace semblante {
namespace {

constexpr std::size_t max_feature_points_bytes = std::size_t{4} << 20;

ImportedHead import_file(const HeadOptions& options) {
  ImportRequest request;
  request.file_name = std::filesystem::path(options.model_path).filename().string();
  request.format = parse_model_format(options.format);
  request.resources = folder_resources(options.model_path);
  auto head = import_head(read_file(options.model_path, request.limits.max_file_bytes), request);
  if (!head) fail(options.model_path, head.error());
  return std::move(*head);
}

FrameWish wish_of(const HeadOptions& options) {
  FrameWish wish{parse_length_unit(options.unit), parse_direction(options.up), parse_direction(options.front)};
  if (wish.up && wish.front && !are_valid({*wish.up, *wish.front}))
    throw CommandFailure(CommandFailure::bad_input,
                         "--front: " + options.front + " lies on the axis of --up " + options.up);
  return wish;
}

/// Advice to use `semblante propose` for these points.
std::vector<std::string> advice_on(const std::vector<MarkedPoint>& marked) {
  std::vector<std::string> advice;
  const auto proposed = std::count_if(marked.begin(), marked.end(), [](const MarkedPoint& p) { return p.proposed; });
  const std::size_t placed = marked.size() - static_cast<std::size_t>(proposed);
  // 11.5, the thickness of hair, is missing from most heads, and nothing proposes it.
  if (marked.size() + 1 < feature_point_count && placed >= least_known_points) {
    advice.push_back(std::to_string(feature_point_count - marked.size()) +
                     " of the 84 feature points are missing; `semblante propose` proposes most of them");
  }
  if (proposed > 0)
    advice.push_back(std::to_string(proposed) + " feature points are proposals that nobody has confirmed");
  return advice;
}

/// The head with the points that the shape of its face shows, as proposals.
MarkedHead find_points(MarkedHead head, const HeadOptions& options) {
  const auto proposals = propose_points(head);
  if (!proposals) {
    Error told = proposals.error();
    told.message += "; --feature-points takes a file of them";
    fail(options.model_path, told);
  }
  MarkRequest request;
  request.fapu_by_user = head.fapu_by_user;
  for (const Proposal& proposal : proposals->points) {
    MarkedPoint& marked = request.points.emplace_back();
    marked.id = proposal.point.id;
    marked.proposed = true;
    if (proposal.point.vertex)
      marked.vertex = proposal.point.vertex->value();
    else
      marked.position = glm::dvec3(proposal.point.position);
  }
  auto found = mark_head(std::move(head), std::move(request));
  if (!found) fail(options.model_path, found.error());
  return std::move(*found);
}

std::vector<std::string> model_format_names() {
  std::vector<std::string> names;
  names.reserve(model_formats.size());
  for (const auto& format : model_formats) names.emplace_back(format.name);
  return names;
}

constexpr const char* found_without = "; without it those that the shape of the face shows";

/// --unit, --up and --front.
void add_placing_options(CLI::App& command, HeadOptions& options) {
  command.add_option("--unit", options.unit, "Unit of MODEL's coordinates, instead of a guess")
      ->check(CLI::IsMember(std::vector<std::string>(length_unit_names.begin(), length_unit_names.end())))
      ->envname("SEMBLANTE_UNIT");
  const auto direction = CLI::Validator(
      [](std::string& text) { return parse_direction(text) ? std::string() : "must be +X, -X, +Y, -Y, +Z or -Z"; },
      "DIRECTION");
  command.add_option("--up", options.up, "Where the top of the head is in MODEL, instead of a guess")
      ->check(direction)
      ->envname("SEMBLANTE_UP");
  command.add_option("--front", options.front, "Where the face looks in MODEL, instead of a guess")
      ->check(direction)
      ->envname("SEMBLANTE_FRONT");
}

/// --fapu.
void add_fapu_option(CLI::App& command, HeadOptions& options) {
  command
      .add_option("--fapu", options.fapu,
                  "A unit by hand instead of measured between points, as NAME=LENGTH: IRISD, ES, ENS, MNS or MW, in "
                  "MODEL's unit, not divided by 1024 (ES=62.5); may be repeated")
      ->delimiter(',')
      ->envname("SEMBLANTE_FAPU");
}

/// Parses the values of --fapu.
Fapu fapu_of(const HeadOptions& options) {
  FapuLengths lengths;
  for (const std::string& text : options.fapu) {
    const auto refuse = [&](const std::string& why) {
      throw CommandFailure(CommandFailure::bad_input, std::string("--fapu: '").append(text).append("': ").append(why));
    };
    const std::size_t sign = text.find('=');
    if (sign == std::string::npos) refuse("it must be NAME=LENGTH, such as ES=62.5");
    double length = 0.0;
    const auto [end, fault] = std::from_chars(text.data() + sign + 1, text.data() + text.size(), length);
    if (fault != std::errc{} || end != text.data() + text.size()) refuse("the length is not a number");
    const std::string name = text.substr(0, sign);
    if (const auto checked = fapu_from_lengths({{name, length}}); !checked) refuse(checked.error().message);
    if (!lengths.emplace(name, length).second) refuse(name + " is given twice");
  }
  return *fapu_from_lengths(lengths);
}

/// --weights, --metric and --articulation.
void add_rig_options(CLI::App& command, HeadOptions& options) {
  command
      .add_option("--weights", options.weights,
                  "How the points' weights are computed: paper (Eq. 1 to 4), smooth (no creases, 8 points a vertex), "
                  "or fitted (smooth, fitted to the morph targets of the head)")
      ->check(CLI::IsMember(std::vector<std::string>(weight_method_names.begin(), weight_method_names.end())))
      ->capture_default_str()
      ->envname("SEMBLANTE_WEIGHTS");
  command
      .add_option("--metric", options.metric,
                  "What the surface distance is measured along: edge, or unfolded (nearer to the geodesic)")
      ->check(CLI::IsMember({"edge", "unfolded"}))
      ->capture_default_str()
      ->envname("SEMBLANTE_METRIC");
  command
      .add_option("--articulation", options.articulation,
                  "How far the jaw opens in visemes, as a multiple of the usual opening; without it, as far as in the "
                  "head's own shapes (morph targets) of open vowels, 1 without them")
      ->check(CLI::Range(least_articulation, most_articulation))
      ->envname("SEMBLANTE_ARTICULATION");
}

}  // namespace

void add_file_options(CLI::App& command, HeadOptions& options, PointsOption points) {
  command.add_option("MODEL", options.model_path, "The head: " + model_file_titles())
      ->required()
      ->envname("SEMBLANTE_MODEL");
  command
      .add_option("--feature-points,--points", options.feature_points_path,
                  std::string("JSON: {\"points\": {\"2.1\": {\"vertex\": 966}, ...}}, vertices as the model file "
                              "numbers them, or positions") +
                      (points == PointsOption::found ? found_without : ""))
      ->required(points == PointsOption::required)
      ->envname("SEMBLANTE_FEATURE_POINTS");
  command.add_option("--format", options.format, "Format of MODEL, instead of what its content shows")
      ->check(CLI::IsMember(model_format_names()))
      ->envname("SEMBLANTE_FORMAT");
  add_placing_options(command, options);
  add_fapu_option(command, options);
  command.add_flag("--quiet", options.quiet, "No warnings and no progress on stderr")->envname("SEMBLANTE_QUIET");
}

void add_head_options(CLI::App& command, HeadOptions& options, PointsOption points) {
  add_file_options(command, options, points);
  add_rig_options(command, options);
}

void add_named_head_options(CLI::App& command, HeadOptions& options) {
  CLI::Option* const model =
      command.add_option("--model", options.model_path, "A head: " + model_file_titles())->envname("SEMBLANTE_MODEL");
  command
      .add_option("--feature-points,--points", options.feature_points_path,
                  std::string("Its feature points, as JSON") + found_without)
      ->needs(model)
      ->envname("SEMBLANTE_FEATURE_POINTS");
  command.add_option("--model-format", options.format, "Format of the head, instead of what its content shows")
      ->check(CLI::IsMember(model_format_names()))
      ->envname("SEMBLANTE_MODEL_FORMAT");
  add_placing_options(command, options);
  add_fapu_option(command, options);
  add_rig_options(command, options);
}

void print_warnings(const std::vector<std::string>& warnings, bool quiet) {
  if (quiet) return;
  for (const std::string& warning : warnings) std::cerr << "semblante: warning: " << warning << "\n";
}

HeadFiles read_head(const HeadOptions& options) {
  HeadFiles files;
  if (!options.feature_points_path.empty()) {
    const auto json = read_file(options.feature_points_path, max_feature_points_bytes);
    auto parsed = parse_feature_points({reinterpret_cast<const char*>(json.data()), json.size()});
    if (!parsed) fail(options.feature_points_path, parsed.error());
    files.points = std::move(*parsed);
  }
  files.points.fapu_by_user = fapu_of(options);
  files.wish = wish_of(options);
  files.head = import_file(options);
  return files;
}

MarkedHead place_points(HeadFiles files, const HeadOptions& options, bool leaves_out_refused) {
  auto head = mark_by_file(std::move(files.head), std::move(files.points), files.wish, leaves_out_refused);
  if (!head) fail(options.feature_points_path, head.error());
  return std::move(*head);
}

RiggedHead rig(MarkedHead head, const HeadOptions& options) {
  const ProgressLine line(options.quiet);
  auto rigged = rig_head(std::move(head), rig_request(options), line.progress());
  if (!rigged) fail(options.model_path, rigged.error());
  return std::move(*rigged);
}

RigRequest rig_request(const HeadOptions& options) {
  return {parse_weight_method(options.weights).value_or(WeightMethod::paper),
          parse_distance_metric(options.metric).value_or(DistanceMetric::edge), options.articulation};
}

Head load_head(const HeadOptions& options) {
  HeadFiles files = read_head(options);
  auto advice = advice_on(files.points.points);
  MarkedHead head = place_points(std::move(files), options);
  if (options.feature_points_path.empty()) {
    head = find_points(std::move(head), options);
    advice = {std::to_string(head.points.size()) +
              " feature points are found by the shape of the face; `semblante propose` writes them for a correction"};
  }
  return {rig(std::move(head), options), std::move(advice)};
}

std::vector<std::string> Head::all_warnings() const {
  std::vector<std::string> list = warnings.all();
  list.insert(list.end(), remarks.begin(), remarks.end());
  return list;
}

}  // namespace semblante
