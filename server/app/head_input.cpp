#include "server/app/head_input.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include "core/import/axes.h"
#include "core/import/import.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/place_feature_points.h"
#include "core/propose/propose.h"
#include "server/app/command_failure.h"
#include "server/app/files.h"

namespace semblante {
namespace {

constexpr std::size_t max_feature_points_bytes = std::size_t{4} << 20;
constexpr std::array all_formats = {ModelFormat::glb, ModelFormat::gltf, ModelFormat::gltf_zip,
                                    ModelFormat::obj, ModelFormat::ply,  ModelFormat::stl};

Model read_model(const HeadOptions& options) {
  const ImportLimits limits;
  const auto bytes = read_file(options.model_path, limits.max_file_bytes);
  std::optional<ModelFormat> format;
  for (const ModelFormat candidate : all_formats) {
    if (to_string(candidate) == options.format) format = candidate;
  }
  if (!format) format = detect_format(bytes, std::filesystem::path(options.model_path).filename().string());
  if (!format) {
    throw CommandFailure(CommandFailure::bad_input,
                         options.model_path + ": is no GLB, glTF (or zip of one), OBJ, PLY or STL");
  }
  auto model = import_model(bytes, *format, limits);
  if (!model) fail(options.model_path, model.error());
  return std::move(*model);
}

FrameWish wish_of(const HeadOptions& options) {
  FrameWish wish{parse_length_unit(options.unit), parse_direction(options.up), parse_direction(options.front)};
  if (wish.up && wish.front && !are_valid({*wish.up, *wish.front}))
    throw CommandFailure(CommandFailure::bad_input,
                         "--front: " + options.front + " lies on the axis of --up " + options.up);
  return wish;
}

/// Guesses by the points, and by the shape of the head where they do not say how it stands.
ModelFrame guess_frame_of(const HeadFiles& head) {
  std::vector<PlacedPoint> points;
  for (const MarkedPoint& point : head.marked) {
    if (point.position)
      points.push_back({point.id, *point.position});
    else if (point.vertex && *point.vertex < head.model.positions.size())
      points.push_back({point.id, glm::dvec3(head.model.positions[*point.vertex])});
  }
  const ModelFrame by_points = guess_frame(points, {});
  if (by_points.axes_sure && by_points.unit_sure) return by_points;
  return guess_frame(points, guess_frame(head.model, build_surface(head.model)));
}

void stand_upright(HeadFiles& head) {
  head.frame = apply_wish(guess_frame_of(head), head.wish);
  if (head.frame.axes == Axes{}) return;
  head.to_mpeg4 = to_mpeg4(head.frame.axes);
  change_axes(head.model, head.to_mpeg4);
  for (MarkedPoint& point : head.marked) {
    if (point.position) point.position = head.to_mpeg4 * *point.position;
  }
  head.model.warnings.push_back("the head stands along " + std::string(to_string(head.frame.axes.up)) + " and faces " +
                                std::string(to_string(head.frame.axes.front)) + " in its file; it is turned upright");
}

/// One line that is written over; cleared at the end. Only for people, so only on a terminal.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO) == 1) {}
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() {
    if (shown_) std::cerr << "\r\033[K" << std::flush;
  }
  void show(double progress, std::string_view stage) const {
    if (shown_) std::cerr << "\r\033[K" << static_cast<int>(progress * 100.0) << " % " << stage << std::flush;
  }

 private:
  bool shown_;
};

/// What `semblante propose` could do for these points.
void warn_of_missing_points(const std::vector<MarkedPoint>& marked, std::vector<std::string>& warnings) {
  const auto proposed = std::count_if(marked.begin(), marked.end(), [](const MarkedPoint& p) { return p.proposed; });
  const std::size_t placed = marked.size() - static_cast<std::size_t>(proposed);
  // 11.5, the thickness of hair, is missing from most heads, and nothing proposes it.
  if (marked.size() + 1 < feature_point_count && placed >= least_known_points) {
    warnings.push_back(std::to_string(feature_point_count - marked.size()) +
                       " of the 84 feature points are missing; `semblante propose` proposes most of them");
  }
  if (proposed > 0) {
    warnings.push_back(std::to_string(proposed) + " feature points are proposals that nobody has confirmed");
  }
}

const std::vector<std::string> model_formats = {"glb", "gltf", "gltf_zip", "obj", "ply", "stl"};

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

/// --weights and --metric.
void add_weight_options(CLI::App& command, HeadOptions& options) {
  command
      .add_option("--weights", options.weights,
                  "How the points' weights are computed: paper (Eq. 1 to 4), or smooth (no creases, 8 points a vertex)")
      ->check(CLI::IsMember({"paper", "smooth"}))
      ->capture_default_str()
      ->envname("SEMBLANTE_WEIGHTS");
  command
      .add_option("--metric", options.metric,
                  "What the surface distance is measured along: edge, or unfolded (nearer to the geodesic)")
      ->check(CLI::IsMember({"edge", "unfolded"}))
      ->capture_default_str()
      ->envname("SEMBLANTE_METRIC");
}

}  // namespace

void add_file_options(CLI::App& command, HeadOptions& options, PointsOption points) {
  command.add_option("MODEL", options.model_path, "The head: GLB, glTF (or a zip of one), OBJ, PLY or STL")
      ->required()
      ->envname("SEMBLANTE_MODEL");
  command
      .add_option("--feature-points,--points", options.feature_points_path,
                  "JSON: {\"points\": {\"2.1\": {\"vertex\": 966}, ...}}, vertices as the model file numbers them, or "
                  "positions")
      ->required(points == PointsOption::required)
      ->envname("SEMBLANTE_FEATURE_POINTS");
  command.add_option("--format", options.format, "Format of MODEL, instead of what its content shows")
      ->check(CLI::IsMember(model_formats))
      ->envname("SEMBLANTE_FORMAT");
  add_placing_options(command, options);
  command.add_flag("--quiet", options.quiet, "No warnings and no progress on stderr")->envname("SEMBLANTE_QUIET");
}

void add_head_options(CLI::App& command, HeadOptions& options, PointsOption points) {
  add_file_options(command, options, points);
  add_weight_options(command, options);
}

void add_named_head_options(CLI::App& command, HeadOptions& options) {
  CLI::Option* const model =
      command.add_option("--model", options.model_path, "A head: GLB, glTF (or a zip of one), OBJ, PLY or STL")
          ->envname("SEMBLANTE_MODEL");
  CLI::Option* const points =
      command.add_option("--feature-points,--points", options.feature_points_path, "Its feature points, as JSON")
          ->needs(model)
          ->envname("SEMBLANTE_FEATURE_POINTS");
  model->needs(points);
  command.add_option("--model-format", options.format, "Format of the head, instead of what its content shows")
      ->check(CLI::IsMember(model_formats))
      ->envname("SEMBLANTE_MODEL_FORMAT");
  add_placing_options(command, options);
  add_weight_options(command, options);
}

void print_warnings(const std::vector<std::string>& warnings, bool quiet) {
  if (quiet) return;
  for (const std::string& warning : warnings) std::cerr << "semblante: warning: " << warning << "\n";
}

HeadFiles read_head(const HeadOptions& options) {
  FeaturePointsFile file;
  if (!options.feature_points_path.empty()) {
    const auto json = read_file(options.feature_points_path, max_feature_points_bytes);
    auto parsed = parse_feature_points({reinterpret_cast<const char*>(json.data()), json.size()});
    if (!parsed) fail(options.feature_points_path, parsed.error());
    file = std::move(*parsed);
  }
  HeadFiles head;
  head.wish = wish_of(options);
  head.model = read_model(options);
  if (!file.to_mpeg4_axes) {
    head.marked = std::move(file.points);
    stand_upright(head);
    return head;
  }
  if (head.wish.has_axes()) {
    throw CommandFailure(
        CommandFailure::bad_input,
        options.feature_points_path + ": /to_mpeg4_axes says how the model stands; leave out --up and --front");
  }
  head.to_mpeg4 = *file.to_mpeg4_axes;
  change_axes(head.model, head.to_mpeg4);
  change_axes(file);
  head.marked = std::move(file.points);
  head.frame = guess_frame_of(head);
  head.frame.axes = {};
  head.frame = apply_wish(std::move(head.frame), head.wish);
  return head;
}

Head load_head(const HeadOptions& options) {
  HeadFiles files = read_head(options);
  Head head;
  head.model = std::move(files.model);
  head.to_mpeg4 = files.to_mpeg4;
  head.warnings = head.model.warnings;
  head.surface = build_surface(head.model);
  const auto points = place_feature_points(head.model, head.surface, files.marked, &head.warnings);
  if (!points) fail(options.feature_points_path, points.error());

  warn_of_missing_points(files.marked, head.warnings);

  const ProgressLine line(options.quiet);
  ParametrizeOptions parametrize_options;
  parametrize_options.weights = parse_weight_method(options.weights).value_or(WeightMethod::paper);
  parametrize_options.metric = parse_distance_metric(options.metric).value_or(DistanceMetric::edge);
  parametrize_options.progress = [&line](double progress, std::string_view stage) {
    line.show(progress, stage);
    return true;
  };
  auto rig = parametrize(head.model, head.surface, *points, parametrize_options);
  if (!rig) fail(options.model_path, rig.error());
  head.rig = std::move(*rig);
  head.warnings.insert(head.warnings.end(), head.rig.warnings.begin(), head.rig.warnings.end());
  return head;
}

}  // namespace semblante
