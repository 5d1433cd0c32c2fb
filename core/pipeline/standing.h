#pragma once

#include <optional>
#include <vector>

#include <glm/mat3x3.hpp>

#include "core/frame/frame_guess.h"
#include "core/geometry/surface.h"
#include "core/pipeline/imported.h"
#include "core/types/marked_point.h"

namespace semblante {

/// Stage 2: the head turned into the MPEG-4 frame, as far as its shape or the user tells how it stands.
struct StandingHead : ImportedHead {
  Surface surface;           ///< of `model` as it stands now
  ModelFrame frame;          ///< how it stands in its file
  FrameWish frame_wish;      ///< what the user says of that
  glm::dmat3 to_mpeg4{1.0};  ///< the turn from the file to `model`
};

struct StandingRequest {
  FrameWish wish;                   ///< replaces the guess where it says something
  std::optional<ModelFrame> known;  ///< the result of an earlier run on this file: taken as it is, nothing is guessed
  /// "to_mpeg4_axes" of a feature point file: turns (or mirrors) the file's axes into MPEG-4's, so that only the unit
  /// is guessed. Not together with axes in `wish`, nor with `known`.
  std::optional<glm::dmat3> to_mpeg4_axes;
};

/// Warns when the head was turned, and when its stance is not sure: then it stays as it lies. Error: `cancelled`.
Result<StandingHead> stand_head(ImportedHead head, const StandingRequest& request, const Progress& progress = {});

/// The rotation from a model that stands by `from` to one that stands by `to`.
glm::dmat3 turn_between(const Axes& from, const Axes& to);

/// Turns the positions of marked points, as the model they lie on was turned.
void turn_points(std::vector<MarkedPoint>& points, const glm::dmat3& turn);

/// What there is to warn of in how a head stands: turned, or not sure, or (empty) upright in its file.
std::vector<std::string> stance_warnings(const ModelFrame& frame);

/// "stands along +Z and faces -Y in its file".
std::string stance_in_words(const Axes& axes);

}  // namespace semblante
