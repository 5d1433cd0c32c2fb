#include "core/pipeline/marked.h"

#include <utility>

#include <glm/matrix.hpp>

#include "core/doctor/marked_points.h"
#include "core/import/axes.h"
#include "core/parametrize/place_feature_points.h"

namespace semblante {
namespace {

Status place(MarkedHead& head, const MarkRequest& request) {
  head.warnings.points.clear();
  if (request.leaves_out_refused) {
    auto placed = place_what_can_be(head.model, head.surface, request.points, head.roles_by_user);
    head.points = std::move(placed.points);
    head.refused = std::move(placed.refused);
    head.warnings.points = std::move(placed.warnings);
    return Unit{};
  }
  auto points =
      place_feature_points(head.model, head.surface, request.points, &head.warnings.points, head.roles_by_user);
  if (!points) return points.error();
  head.points = std::move(*points);
  return Unit{};
}

/// Guesses the axes and unit of the head again, with its feature points.
ModelFrame frame_by_points(const MarkedHead& head) {
  const glm::dmat3 to_file = glm::transpose(to_mpeg4(head.frame.axes));
  std::vector<PlacedPoint> in_file;
  for (const FeaturePoint& point : head.points) in_file.push_back({point.id, to_file * glm::dvec3(point.position)});
  return apply_wish(guess_frame(in_file, head.frame), head.frame_wish);
}

void turn(MarkedHead& head, const glm::dmat3& turn) {
  change_axes(head.model, turn);
  head.surface = build_surface(head.model);
  head.to_mpeg4 = turn * head.to_mpeg4;
  head.turn = turn;
}

}  // namespace

Result<MarkedHead> mark_head(StandingHead standing, MarkRequest request, const Progress& progress) {
  if (auto told = report_progress(progress, 0.0, "feature points"); !told) return told.error();
  MarkedHead head{std::move(standing), {}, std::move(request.roles_by_user), request.fapu_by_user, {}, std::nullopt};
  if (auto placed = place(head, request); !placed) return placed.error();
  const Axes before = head.frame.axes;
  head.frame = frame_by_points(head);
  if (head.frame.axes == before) {
    head.warnings.stance = stance_warnings(head.frame);
    return head;
  }
  turn(head, turn_between(before, head.frame.axes));
  turn_points(request.points, *head.turn);
  head.warnings.stance = {"the feature points show that the head " + stance_in_words(head.frame.axes) +
                          "; it is turned upright"};
  if (auto placed = place(head, request); !placed) return placed.error();
  return head;
}

}  // namespace semblante
