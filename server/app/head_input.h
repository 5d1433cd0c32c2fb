#pragma once

#include <string>
#include <vector>

#include "core/frame/frame_guess.h"
#include "core/geometry/surface.h"
#include "core/import/feature_points_file.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace CLI {
class App;
}

namespace semblante {

/// What both `parametrize` and `deform` begin with.
struct HeadOptions {
  std::string model_path;
  std::string feature_points_path;
  std::string format;             ///< empty: by content and name
  std::string weights = "paper";  ///< a name of weight_method_names
  std::string metric = "edge";    ///< a name of distance_metric_names
  std::string unit, up, front;    ///< of the model file, as length_unit_names and direction_names; empty: guessed
  bool quiet = false;
};

enum class PointsOption : bool { required, optional };

/// Declares MODEL, --feature-points, --format, --unit, --up, --front and --quiet.
void add_file_options(CLI::App& command, HeadOptions& options, PointsOption points = PointsOption::required);

/// The same, and --weights and --metric.
void add_head_options(CLI::App& command, HeadOptions& options, PointsOption points = PointsOption::required);

/// The same for a command whose own argument is another file: --model, --model-format and the rest but --quiet, none of
/// them required.
void add_named_head_options(CLI::App& command, HeadOptions& options);

/// What the files say, brought into the MPEG-4 frame.
struct HeadFiles {
  Model model;
  std::vector<MarkedPoint> marked;  ///< empty without a file of feature points
  glm::dmat3 to_mpeg4{1.0};         ///< by "to_mpeg4_axes" of the feature point file, else by `frame`
  ModelFrame frame;                 ///< its axes are not told where the file says "to_mpeg4_axes"
  FrameWish wish;                   ///< what the options say of it
};

/// Reads both files. Throws CommandFailure, naming the file and the place in it.
HeadFiles read_head(const HeadOptions& options);

/// A parametrized head, in the MPEG-4 frame; model.to_file_frame leads back to the file's.
struct Head {
  Model model;
  Surface surface;
  Rig rig;
  glm::dmat3 to_mpeg4{1.0};           ///< what brought it there
  std::vector<std::string> warnings;  ///< of all steps, for print_warnings once the command has succeeded
};

/// Reads, places and parametrizes. Progress goes to stderr if that is a terminal and quiet is not asked for. Throws
/// CommandFailure, naming the file and the place in it.
Head load_head(const HeadOptions& options);

/// "semblante: warning: ..." on stderr. At the end, so that a failure is one line alone.
void print_warnings(const std::vector<std::string>& warnings, bool quiet);

}  // namespace semblante
