#include "server/jobs/standing.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "core/import/axes.h"

namespace semblante::jobs {
namespace {

Axes axes_before(const WorkerRequest& request) { return request.frame ? request.frame->axes : Axes{}; }

/// From standing one way to standing another.
glm::dmat3 turn_between(const Axes& from, const Axes& to) { return to_mpeg4(to) * glm::transpose(to_mpeg4(from)); }

void keep_turn(const glm::dmat3& turn, WorkerResult& result) {
  store::Turn rows{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rows[static_cast<std::size_t>(3 * row + column)] = turn[column][row];
  }
  result.turn = rows;
}

std::string in_words(const Axes& axes) {
  return "stands along " + std::string(to_string(axes.up)) + " and faces " + std::string(to_string(axes.front)) +
         " in its file";
}

}  // namespace

void stand_upright(Model& model, Surface& surface, const WorkerRequest& request, WorkerResult& result) {
  const FrameWish& wish = request.frame_wish;
  const bool all_said = wish.unit && wish.has_axes();
  const ModelFrame frame = apply_wish(all_said ? ModelFrame{} : guess_frame(model, surface), wish);
  if (frame.axes != Axes{}) {
    change_axes(model, to_mpeg4(frame.axes));
    surface = build_surface(model);
    model.warnings.push_back("the head " + in_words(frame.axes) + "; it is turned upright");
  } else if (!frame.axes_sure) {
    model.warnings.push_back("how the head stands cannot be told for certain; it is taken as it lies in its file");
  }
  if (request.frame && request.frame->axes != frame.axes)
    keep_turn(turn_between(request.frame->axes, frame.axes), result);
  result.frame = frame;
}

void stand_as_before(Model& model, const WorkerRequest& request) { change_axes(model, to_mpeg4(axes_before(request))); }

bool stand_by_points(Model& model, Surface& surface, std::span<MarkedPoint> marked, const FeaturePointSet& points,
                     const WorkerRequest& request, WorkerResult& result) {
  const Axes before = axes_before(request);
  const glm::dmat3 to_file = glm::transpose(to_mpeg4(before));
  std::vector<PlacedPoint> in_file;
  for (const FeaturePoint& point : points) in_file.push_back({point.id, to_file * glm::dvec3(point.position)});
  const ModelFrame frame = apply_wish(guess_frame(in_file, request.frame.value_or(ModelFrame{})), request.frame_wish);
  result.frame = frame;
  if (frame.axes == before) return false;
  const glm::dmat3 turn = turn_between(before, frame.axes);
  change_axes(model, turn);
  for (MarkedPoint& point : marked) {
    if (point.position) point.position = turn * *point.position;
  }
  surface = build_surface(model);
  model.warnings.push_back("the feature points show that the head " + in_words(frame.axes) + "; it is turned upright");
  keep_turn(turn, result);
  return true;
}

glm::dvec3 turned_back(const glm::dvec3& position, const std::optional<store::Turn>& turn) {
  if (!turn) return position;
  glm::dvec3 before(0.0);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      before[column] += (*turn)[static_cast<std::size_t>(3 * row + column)] * position[row];
  }
  return before;
}

}  // namespace semblante::jobs
