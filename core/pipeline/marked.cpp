#include "core/pipeline/marked.h"

#include <cmath>
#include <string>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
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

/// Whether the model is much more than a head, so that a tilted head in it is the posture of a body.
bool has_body(const MarkedHead& head) {
  const auto size_of = [](const auto& positions, const auto& place) {
    glm::dvec3 low(1e300);
    glm::dvec3 high(-1e300);
    for (const auto& position : positions) {
      low = glm::min(low, glm::dvec3(place(position)));
      high = glm::max(high, glm::dvec3(place(position)));
    }
    return glm::distance(low, high);
  };
  constexpr double most_faces = 6.0;
  return size_of(head.model.positions, [](const glm::vec3& p) { return p; }) >
         most_faces * size_of(head.points, [](const FeaturePoint& p) { return p.position; });
}

/// Guesses the axes and unit of the head again, with its feature points.
ModelFrame frame_by_points(const MarkedHead& head) {
  const glm::dmat3 to_file = glm::transpose(turn_upright(head.frame));
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

/// A point moves the vertex at it with weight 1 (Eq. 4), so a point between vertices needs one.
void give_vertices(MarkedHead& head) {
  std::vector<TrianglePlace> places;
  for (const FeaturePoint& point : head.points) {
    if (point.between) places.push_back(*point.between);
  }
  if (places.empty()) return;
  Insertion insertion = insert_vertices(head.model, head.surface, places);
  head.inserted = std::move(insertion.vertices);
  head.surface = build_surface(head.model);
  auto vertex = insertion.vertex_of_place.begin();
  for (FeaturePoint& point : head.points) {
    if (!point.between) continue;
    point = {point.id, VertexId(*vertex), head.model.positions[*vertex]};
    ++vertex;
  }
}

}  // namespace

Result<MarkedHead> mark_head(StandingHead standing, MarkRequest request, const Progress& progress) {
  if (auto told = report_progress(progress, 0.0, "feature points"); !told) return told.error();
  MarkedHead head{std::move(standing), {}, std::move(request.roles_by_user), request.fapu_by_user, {},
                  std::nullopt,        {}};
  if (auto placed = place(head, request); !placed) return placed.error();
  const ModelFrame before = head.frame;
  head.frame = frame_by_points(head);
  const double tilt = tilt_of(head.frame);
  const bool is_of_body = tilt > 0.0 && has_body(head);
  if (is_of_body) head.frame.tilt = glm::dmat3(1.0);
  const auto warn_of_body = [&] {
    if (is_of_body)
      head.warnings.stance.push_back("the head is tilted by " + std::to_string(std::lround(tilt)) +
                                     " degrees on its body; its points move along the axes of the body");
  };
  if (turn_upright(head.frame) == turn_upright(before)) {
    head.warnings.stance = stance_warnings(head.frame);
    warn_of_body();
    give_vertices(head);
    return head;
  }
  turn(head, turn_between(before, head.frame));
  turn_points(request.points, *head.turn);
  head.warnings.stance = {"the feature points show that the head " + stance_in_words(head.frame) +
                          "; it is turned upright"};
  warn_of_body();
  if (auto placed = place(head, request); !placed) return placed.error();
  give_vertices(head);
  return head;
}

}  // namespace semblante
