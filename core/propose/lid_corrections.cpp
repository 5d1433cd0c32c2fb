#include "core/propose/lid_corrections.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "core/anatomy/lid_edge.h"
#include "core/anatomy/point_order.h"
#include "core/anatomy/rim_points.h"
#include "core/anatomy/seen_lid_edge.h"
#include "core/propose/eye_edge_lines.h"
#include "core/propose/shape_rules.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

/// Moves the middle of a lid to its `edge`, if it is off it and a vertex is much nearer.
void move_to_edge(Draft& draft, std::size_t id, const glm::dvec3& edge, double height_of_eye) {
  const glm::dvec3 before = *draft.settled()[id];
  if (is_on_edge(before.y - edge.y, height_of_eye, 1.0)) return;
  const double error = draft.error(id);
  const auto nearest = draft.nearest_vertex(id, PartRole::skin, edge, error);
  if (!nearest) return;
  const glm::dvec3& place = draft.face().at(nearest->vertex);
  if (glm::distance(place, edge) > 0.5 * glm::distance(before, edge)) return;
  draft.withdraw(id);
  draft.settle(id, {place, nearest->vertex}, ProposalMethod::shape, error, nearest->doubt);
}

/// Moves a fold that lies on an edge to the nearest free vertex above (`side` 1) or below (-1) `height`, that of the
/// middle of its lid's edge.
void move_off_edges(Draft& draft, std::size_t id, double height, double side, const EyeEdgeLines& edges) {
  if (!draft.proposed_vertex(id) || !edges.has(*draft.settled()[id])) return;
  draft.withdraw(id);
  const FaceSurface& face = draft.face();
  const glm::dvec3& place = draft.expected(id);
  const OrderBounds bounds = order_bounds(id_of(id), draft.settled());
  const auto beside = face.nearest(role_of_point(id_of(id)), place, nullptr, [&](std::uint32_t v) {
    return draft.is_free(v) && !edges.has(face.at(v)) && face.faces_forward_at(v) &&
           (face.at(v).y - height) * side > 0.0 && bounds.contains(face.at(v));
  });
  if (!beside || !Draft::is_near(face.at(*beside), place, draft.error(id)))
    return draft.refuse(id, "the surface has no free vertex that fits this point at its expected position");
  draft.settle(id, {face.at(*beside), *beside}, draft.method(id),
               std::max(draft.error(id), 0.5 * glm::distance(face.at(*beside), place)));
}

}  // namespace

void correct_sides(Draft& draft) {
  for (const MisplacedRimPoint& misplaced : find_misplaced_rim_points(draft.head().surface, draft.present_points())) {
    const std::size_t id = misplaced.point.id.value();
    if (!draft.is_proposed(id)) continue;
    const ProposalMethod method = draft.proposed_method(id);
    const std::uint32_t vertex = misplaced.nearest_own.value();
    const glm::dvec3& place = draft.face().at(vertex);
    const double off = glm::distance(place, *draft.settled()[id]);
    draft.withdraw(id);
    draft.settle(id, {place, vertex}, method, std::max(draft.error(id), 0.5 * off),
                 "the surface is too coarse here to distinguish " + sides_in_words(*misplaced.opening));
  }
}

void correct_lid_edges(Draft& draft) {
  const HeadToMark& head = draft.head();
  const Places& settled = draft.settled();
  for (const mpeg4::Opening& opening : mpeg4::openings) {
    if (opening.is_mouth) continue;
    const std::size_t upper = index_of(opening.upper.front());
    const std::size_t lower = index_of(opening.lower.front());
    if (!settled[upper] || !settled[lower] || settled[upper]->y <= settled[lower]->y) continue;
    for (const std::size_t id : {upper, lower}) {
      if (!draft.is_proposed(id)) continue;
      constexpr double around = 0.15;
      const auto eye = seen_eye(head.surface, head.parts, head.triangles, draft.frame(), draft.expected(id).x,
                                settled[lower]->y - around, settled[upper]->y + around);
      if (eye) move_to_edge(draft, id, id == upper ? eye->upper : eye->lower, eye->upper.y - eye->lower.y);
    }
  }
}

void correct_folds(Draft& draft) {
  const std::vector<SurfacePoint> points = draft.present_points();
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const auto edges = find_eye_edges(draft.head().surface, points, eye, draft.head().parts);
    if (!edges) continue;
    const EyeEdgeLines lines(*edges, draft.face().places());
    const mpeg4::Opening& lids = mpeg4::lids_of(eye);
    const auto height_of = [&](std::string_view point) { return draft.settled()[index_of(point)]->y; };
    move_off_edges(draft, index_of(eye == 0 ? "3.13" : "3.14"), height_of(lids.upper.front()), 1.0, lines);
    move_off_edges(draft, index_of(eye == 0 ? "3.9" : "3.10"), height_of(lids.lower.front()), -1.0, lines);
  }
}

}  // namespace semblante
