#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/pipeline/points_file.h"
#include "core/pipeline/rigged.h"

namespace CLI {
class App;
}

namespace semblante {

/// The options that `parametrize` and `deform` have in common.
struct HeadOptions {
  std::string model_path;
  std::string feature_points_path;
  std::string format;                  ///< empty: detected from content and name
  std::string weights = "paper";       ///< a name of weight_method_names
  std::string metric = "edge";         ///< a name of distance_metric_names
  std::optional<double> articulation;  ///< empty: that of the head's own shapes, or the usual one
  std::string unit, up, front;  ///< of the model file, values of length_unit_names and direction_names; empty: guessed
  std::vector<std::string> fapu;  ///< "ES=62.5"
  bool quiet = false;
};

/// What a command does without a file of points: not at all, without points, or with those that the shape of the face
/// shows.
enum class PointsOption : std::uint8_t { required, optional, found };

/// Declares MODEL, --feature-points, --format, --unit, --up, --front and --quiet.
void add_file_options(CLI::App& command, HeadOptions& options, PointsOption points = PointsOption::required);

/// The same, and --weights, --metric and --articulation.
void add_head_options(CLI::App& command, HeadOptions& options, PointsOption points = PointsOption::required);

/// The same for a command whose argument is another file: --model, --model-format and the other options except --quiet,
/// none required.
void add_named_head_options(CLI::App& command, HeadOptions& options);

/// The contents of the files and options, before the first stage.
struct HeadFiles {
  ImportedHead head;
  FeaturePointsFile points;  ///< empty without such a file
  FrameWish wish;
};

/// Reads both files. Throws CommandFailure, naming the file and the place in it.
HeadFiles read_head(const HeadOptions& options);

/// Turns the head upright and places its points: mark_by_file. Throws CommandFailure, naming the file.
MarkedHead place_points(HeadFiles files, const HeadOptions& options, bool leaves_out_refused = false);

RigRequest rig_request(const HeadOptions& options);

/// rig_head with progress on stderr, if that is a terminal and quiet is not set. Throws CommandFailure.
RiggedHead rig(MarkedHead head, const HeadOptions& options);

/// A rigged head, and the remarks of a command in addition to the warnings of the pipeline.
struct Head : RiggedHead {
  std::vector<std::string> remarks;  ///< advice on missing points, then what the command adds

  /// The warnings of the stages in their order, then the remarks: for print_warnings once the command has succeeded.
  [[nodiscard]] std::vector<std::string> all_warnings() const;
};

/// read_head, place_points and rig; without a file of points it takes those that the shape of
/// the face shows.
Head load_head(const HeadOptions& options);

/// Prints "semblante: warning: ..." on stderr. To be called at the end, so that a failure prints only one line.
void print_warnings(const std::vector<std::string>& warnings, bool quiet);

}  // namespace semblante
