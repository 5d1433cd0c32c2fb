#include "core/propose/modelled_rim_corrections.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "core/anatomy/joined_rims.h"
#include "core/anatomy/modelled_eye.h"
#include "core/anatomy/modelled_rims.h"
#include "core/anatomy/part_roles.h"
#include "core/anatomy/point_order.h"
#include "core/anatomy/seen_lid_edge.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

// All in ES0 but the last.
/// A proposed corner stays if it is nearer than this to where the lids are seen to meet.
constexpr double near_corner = 0.06;
/// A proposed pupil stays if it is nearer than this to the middle of the eye that is seen.
constexpr double near_middle = 0.05;
/// The edges that are seen are not those of this eye if they are farther than this from a marked point.
constexpr double near_marked = 0.15;
/// The greatest distance of a point of a lid from the middle between the corners, as a share of the eye's width.
constexpr double greatest_aside = 0.3;

/// The points of one eye's lids, and the edges that are seen about the eye.
class RimMover {
 public:
  RimMover(Draft& draft, std::size_t eye, const ModelledRims& rims)
      : draft_(draft), face_(draft.face()), eye_(eye), lids_(mpeg4::lids_of(eye)), rims_(rims) {}

  /// All points that are off the edges, or none.
  void run() {
    if (!plan_corners() || !plan_middles() || moves_.empty() || !closes_after_moves()) return;
    std::vector<double> off;
    for (const Move& move : moves_) off.push_back(glm::distance(face_.at(move.vertex), *draft_.settled()[move.id]));
    for (const Move& move : moves_) draft_.withdraw(move.id);
    for (std::size_t i = 0; i < moves_.size(); ++i) {
      const auto& [id, vertex] = moves_[i];
      draft_.settle(id, {face_.at(vertex), vertex}, ProposalMethod::shape, std::max(draft_.error(id), 0.5 * off[i]));
    }
    center_pupil();
  }

 private:
  /// Of a point to another vertex.
  struct Move {
    std::size_t id;
    std::uint32_t vertex;
  };

  // False if the edges cannot be those of this eye.

  [[nodiscard]] bool plan_corners() {
    for (const bool is_left : {true, false}) {
      const std::size_t id = index_of(lids_.corners[is_left ? 0 : 1]);
      const glm::dvec3& place = is_left ? rims_.left : rims_.right;
      if (!plan_move(id, place, glm::distance(*draft_.settled()[id], place) > near_corner)) return false;
    }
    return true;
  }

  [[nodiscard]] bool plan_middles() {
    const double middle = 0.5 * (rims_.left.x + rims_.right.x);
    const double width = rims_.left.x - rims_.right.x;
    for (const bool is_upper : {true, false}) {
      const std::size_t id = index_of(is_upper ? lids_.upper.front() : lids_.lower.front());
      const glm::dvec3& before = *draft_.settled()[id];
      const bool is_aside = std::abs(before.x - middle) > greatest_aside * width;
      const ModelledRims::Column& edges = rims_.at(is_aside ? middle : before.x);
      const glm::dvec3& place = is_upper ? edges.upper : edges.lower;
      // The person who marked the other eye's lid may have meant a place a little beside what is seen of the edge.
      const double off = (draft_.has_image(id) ? 0.5 : 1.0) * (before.y - place.y);
      const bool is_off = is_aside || !is_on_edge(off, edges.upper.y - edges.lower.y, 1.0);
      if (!plan_move(id, place, is_off)) return false;
    }
    return true;
  }

  /// Adds a move to the vertex nearest to `place`, of a proposed point that is `off` it or on the eye. False if
  /// `place` is too far from a marked point, or from where the point is expected.
  [[nodiscard]] bool plan_move(std::size_t id, const glm::dvec3& place, bool is_off) {
    const glm::dvec3& settled = *draft_.settled()[id];
    if (!draft_.is_proposed(id)) return glm::distance(settled, place) < near_marked;
    const auto before = draft_.proposed_vertex(id);
    if (!before || (!is_off && !rims_.is_of_eye(SurfaceVertexId(*before)))) return true;
    const auto vertex = face_.nearest(PartRole::skin, place, nullptr, [&](std::uint32_t v) {
      return (v == *before || draft_.is_free(v)) && !rims_.is_of_eye(SurfaceVertexId(v));
    });
    if (!vertex || !Draft::is_near(face_.at(*vertex), settled, draft_.error(id))) return false;
    if (*vertex != *before) moves_.push_back({id, *vertex});
    return true;
  }

  /// Whether the points keep their order on the face when they are moved, and lids of one skin close over their eye.
  [[nodiscard]] bool closes_after_moves() const {
    Places moved = draft_.settled();
    for (const Move& move : moves_) moved[move.id] = face_.at(move.vertex);
    if (std::any_of(moves_.begin(), moves_.end(), [&](const Move& move) {
          return !order_bounds(id_of(move.id), moved).contains(face_.at(move.vertex));
        }))
      return false;
    const HeadToMark& head = draft_.head();
    std::vector<SurfacePoint> points = draft_.present_points();
    for (SurfacePoint& point : points) {
      for (const Move& move : moves_) {
        if (point.id != id_of(move.id)) continue;
        point = {point.id, SurfaceVertexId(move.vertex), head.surface.positions[move.vertex]};
      }
    }
    return !are_joined(head.surface, lids_, points) ||
           find_modelled_eyes(head.surface, head.triangles, head.parts, points)[eye_];
  }

  /// Moves a proposed pupil to the middle of the eye, if it lies beside it: it was proposed from lids that were
  /// elsewhere.
  void center_pupil() {
    const std::size_t id = index_of(eye_ == 0 ? "3.5" : "3.6");
    if (!draft_.is_proposed(id)) return;
    const ModelledRims::Column& middle = rims_.columns[rims_.columns.size() / 2];
    glm::dvec3 place = 0.5 * (middle.upper + middle.lower);
    const auto aside = [&](SurfaceVertexId v) {
      return glm::distance(glm::dvec2(face_.at(v.value())), glm::dvec2(place));
    };
    const auto nearest = std::min_element(rims_.of_eye.begin(), rims_.of_eye.end(),
                                          [&](SurfaceVertexId a, SurfaceVertexId b) { return aside(a) < aside(b); });
    if (nearest != rims_.of_eye.end()) place.z = face_.at(nearest->value()).z;
    if (glm::distance(*draft_.settled()[id], place) < near_middle) return;
    draft_.withdraw(id);
    draft_.settle(id, {place, std::nullopt}, ProposalMethod::shape, draft_.error(id));
  }

  Draft& draft_;
  const FaceSurface& face_;
  std::size_t eye_;
  const mpeg4::Opening& lids_;
  const ModelledRims& rims_;
  std::vector<Move> moves_;
};

}  // namespace

void correct_modelled_rims(Draft& draft) {
  const HeadToMark& head = draft.head();
  if (head.triangles.empty()) return;
  const FaceSurface& face = draft.face();
  for (std::size_t eye = 0; eye < 2; ++eye) {
    if (!face.with_role(eyeball_role(eye)).empty()) continue;
    const mpeg4::Opening& lids = mpeg4::lids_of(eye);
    const auto& upper = draft.settled()[index_of(lids.upper.front())];
    const auto& lower = draft.settled()[index_of(lids.lower.front())];
    const auto& left = draft.settled()[index_of(lids.corners[0])];
    const auto& right = draft.settled()[index_of(lids.corners[1])];
    if (!upper || !lower || !left || !right) continue;
    const auto skin = face.nearest(PartRole::skin, *upper);
    if (!skin) continue;
    const auto rims = find_modelled_rims(head.surface, face.places(), head.triangles, head.surface.part_of[*skin],
                                         {*upper, *lower, *left, *right});
    if (rims) RimMover(draft, eye, *rims).run();
  }
}

}  // namespace semblante
