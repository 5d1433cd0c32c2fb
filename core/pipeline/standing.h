#pragma once

#include <optional>
#include <vector>

#include <glm/mat3x3.hpp>

#include "core/frame/frame_guess.h"
#include "core/geometry/surface.h"
#include "core/pipeline/imported.h"
#include "core/types/marked_point.h"

namespace semblante {

/// Stage 2: the head rotated to MPEG-4 axes, if its shape or the user determines its axes.
struct StandingHead : ImportedHead {
  Surface surface;           ///< of `model` after the rotation
  ModelFrame frame;          ///< its axes and unit in the file
  FrameWish frame_wish;      ///< the axes and unit set by the user
  glm::dmat3 to_mpeg4{1.0};  ///< the rotation from the file to `model`
};

struct StandingRequest {
  FrameWish wish;                   ///< its set members replace the guess
  std::optional<ModelFrame> known;  ///< the result of an earlier run on this file, used without a new guess
  /// "to_mpeg4_axes" of a feature point file: rotates (or mirrors) the file's axes to MPEG-4's, so that only the unit
  /// is guessed. Excludes axes in `wish`, and `known`.
  std::optional<glm::dmat3> to_mpeg4_axes;
};

/// Adds a warning when the head was rotated, or when its axes are uncertain (then it is not). Error: `cancelled`.
Result<StandingHead> stand_head(ImportedHead head, const StandingRequest& request, const Progress& progress = {});

/// The rotation from a model that `from` turns upright to one that `to` turns upright.
glm::dmat3 turn_between(const ModelFrame& from, const ModelFrame& to);

/// Rotates the positions of marked points with their model.
void turn_points(std::vector<MarkedPoint>& points, const glm::dmat3& turn);

/// The warnings about the axes of a head: rotated, or uncertain; empty: upright in its file.
std::vector<std::string> stance_warnings(const ModelFrame& frame);

/// "stands along +Z and faces -Y in its file", "is tilted by 20 degrees in its file".
std::string stance_in_words(const ModelFrame& frame);

}  // namespace semblante
