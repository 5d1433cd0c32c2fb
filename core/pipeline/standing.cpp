#include "core/pipeline/standing.h"

#include <cassert>
#include <cmath>
#include <utility>

#include <glm/matrix.hpp>

#include "core/import/axes.h"

namespace semblante {
namespace {

/// The guess needs the surface of the model in the file's axes; `surface` stays empty when nothing is guessed.
ModelFrame find_frame(const Model& model, const StandingRequest& request, const FrameWish& wish, Surface& surface) {
  if (request.known) return *request.known;
  if (wish.unit && wish.has_axes()) return apply_wish(ModelFrame{}, wish);
  surface = build_surface(model);
  return apply_wish(guess_frame(model, surface), wish);
}

}  // namespace

Result<StandingHead> stand_head(ImportedHead head, const StandingRequest& request, const Progress& progress) {
  assert(!request.to_mpeg4_axes || (!request.wish.has_axes() && !request.known));
  if (auto told = report_progress(progress, 0.0, "surface"); !told) return told.error();
  StandingHead standing{std::move(head), {}, {}, request.wish, glm::dmat3(1.0)};
  if (request.to_mpeg4_axes) {
    standing.to_mpeg4 = *request.to_mpeg4_axes;
    change_axes(standing.model, standing.to_mpeg4);
    standing.frame_wish.up = Direction::plus_y;
    standing.frame_wish.front = Direction::plus_z;
  }
  standing.frame = find_frame(standing.model, request, standing.frame_wish, standing.surface);
  standing.warnings.stance = stance_warnings(standing.frame);
  if (const glm::dmat3 turn = turn_upright(standing.frame); turn != glm::dmat3(1.0)) {
    change_axes(standing.model, turn);
    standing.to_mpeg4 = turn * standing.to_mpeg4;
    standing.surface = build_surface(standing.model);
  } else if (standing.surface.surface_of.empty()) {
    standing.surface = build_surface(standing.model);
  }
  return standing;
}

glm::dmat3 turn_between(const ModelFrame& from, const ModelFrame& to) {
  return turn_upright(to) * glm::transpose(turn_upright(from));
}

void turn_points(std::vector<MarkedPoint>& points, const glm::dmat3& turn) {
  for (MarkedPoint& point : points) {
    if (point.position) point.position = turn * *point.position;
  }
}

std::string stance_in_words(const ModelFrame& frame) {
  const std::string stands = "stands along " + std::string(to_string(frame.axes.up)) + " and faces " +
                             std::string(to_string(frame.axes.front));
  if (frame.tilt == glm::dmat3(1.0)) return stands + " in its file";
  const std::string tilted = "is tilted by " + std::to_string(std::lround(tilt_of(frame))) + " degrees in its file";
  return frame.axes == Axes{} ? tilted : stands + " and " + tilted;
}

std::vector<std::string> stance_warnings(const ModelFrame& frame) {
  if (turn_upright(frame) != glm::dmat3(1.0))
    return {"the head " + stance_in_words(frame) + (frame.axes_sure ? "" : ", as far as its shape shows") +
            "; it is turned upright"};
  if (!frame.axes_sure) return {"the axes of the head are uncertain; it keeps the axes of its file"};
  return {};
}

}  // namespace semblante
