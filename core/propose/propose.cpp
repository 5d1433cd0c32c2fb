#include "core/propose/propose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include "core/anatomy/front_points.h"
#include "core/anatomy/joined_rims.h"
#include "core/anatomy/lid_edge.h"
#include "core/anatomy/mirror_plane.h"
#include "core/anatomy/modelled_eye.h"
#include "core/anatomy/modelled_rims.h"
#include "core/anatomy/part_roles.h"
#include "core/anatomy/plausible_joints.h"
#include "core/anatomy/point_lookup.h"
#include "core/anatomy/point_order.h"
#include "core/anatomy/rim_points.h"
#include "core/anatomy/seen_lid_edge.h"
#include "core/geometry/similarity.h"
#include "core/propose/eye_edge_lines.h"
#include "core/propose/face_surface.h"
#include "core/propose/mouth_and_eyes.h"
#include "core/propose/proportion_guess.h"
#include "core/propose/quick_set.h"
#include "core/propose/relations.h"
#include "core/propose/rim_choice.h"
#include "core/propose/shape_rules.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

// All in ES0.
constexpr double marking_noise = 0.015;  ///< standard deviation of a marked point
constexpr double mirror_noise = 0.02;    ///< standard deviation of the mirror image of a marked point
constexpr double surely = 0.12;          ///< largest claimed radius of `high` confidence
constexpr double about = 0.26;           ///< largest claimed radius of `medium` confidence
// Of an eye that is modelled in the skin.
/// A proposed corner stays if it is nearer than this to where the lids are seen to meet.
constexpr double near_corner = 0.06;
/// A proposed pupil stays if it is nearer than this to the middle of the eye that is seen.
constexpr double near_middle = 0.05;
/// The edges that are seen are not those of this eye if they are farther than this from a marked point.
constexpr double near_marked = 0.15;
/// The greatest distance of a point of a lid from the middle between the corners, as a share of the eye's width.
constexpr double greatest_aside = 0.3;

/// How far heads differ from each other beyond what their references tell, as a radius: measured on the proposals for
/// heads that are not among the references (bench_propose). Zero for the other points.
double difference_between_heads(FeaturePointId id) {
  constexpr double ear = 0.07;
  constexpr double hair = 0.14;
  constexpr double fold_of_lid = 0.20;
  const std::string name = to_string(id);
  if (name == "3.13" || name == "3.14") return fold_of_lid;
  return group_of(id) == 10 ? ear : group_of(id) == 11 ? hair : 0.0;
}

/// Of the edges at a vertex: the right place is between vertices.
constexpr double between_vertices = 0.5;

/// Claimed radius per expected error: nine in ten proposals on heads that are not among the references lie within it.
/// Measured by bench_propose.
constexpr double nine_in_ten = 1.75;

std::uint8_t mirror_of(std::size_t id) { return mpeg4::feature_points[id].mirror; }
bool is_middle(std::size_t id) { return mirror_of(id) == id; }
FeaturePointId id_of(std::size_t id) { return FeaturePointId(static_cast<std::uint8_t>(id)); }
std::size_t index_of(std::string_view name) { return parse_feature_point(name)->value(); }

/// Rounds a rotation to quarter turns about the axes, if it is close. Heads are upright; the fit to proportions would
/// tilt them by some degrees, which would change the highest vertex.
glm::dmat3 to_quarter_turns(const glm::dmat3& rotation) {
  constexpr double near = 0.9;  // cosine
  glm::dmat3 turned{0.0};
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      if (std::abs(rotation[c][r]) > near) turned[c][r] = rotation[c][r] < 0.0 ? -1.0 : 1.0;
    }
  }
  return glm::determinant(turned) > 0.5 ? turned : rotation;
}

/// The vertices of the face for the comparison with its mirror image.
std::vector<glm::dvec3> front_of(const FaceSurface& face) {
  constexpr double behind_eyes = -0.8;
  constexpr double above_and_below = 2.0;
  std::vector<glm::dvec3> front;
  for (const std::uint32_t v : face.with_role(PartRole::skin)) {
    const glm::dvec3& p = face.at(v);
    if (p.z > behind_eyes && std::abs(p.y) < above_and_below) front.push_back(p);
  }
  return front;
}

/// Every n-th place, so that there are at most `enough`.
std::vector<glm::dvec3> thinned(const std::vector<glm::dvec3>& places, std::size_t enough) {
  std::vector<glm::dvec3> some;
  for (std::size_t i = 0; i < places.size(); i += places.size() / enough + 1) some.push_back(places[i]);
  return some;
}

/// Order of the proposals by dependency: points near lips and lids determine their sides, middles and corners the
/// points between them.
enum class Turn : std::uint8_t { open_skin, rims, related };

Turn turn_of(FeaturePointId id) {
  if (has_relation(id)) return Turn::related;
  return rim_of_point(id).opening != nullptr ? Turn::rims : Turn::open_skin;
}

/// A position, with the surface vertex there, if any.
struct Spot {
  glm::dvec3 place{0.0};
  std::optional<std::uint32_t> vertex;
};

class Proposer {
 public:
  Proposer(const Surface& surface, std::span<const Part> parts, const Similarity& frame, const FeaturePointSet& known,
           std::span<const ReferenceHead> references, const std::optional<SkinJoint>& head_joint,
           std::span<const Triangle> triangles)
      : surface_(surface),
        parts_(parts),
        frame_(frame),
        known_(known),
        face_(surface, parts, frame, triangles),
        triangles_(triangles),
        references_(references) {
    if (head_joint) head_joint_ = frame(glm::dvec3(head_joint->position));
    for (const FeaturePoint& point : known) {
      settled_[point.id.value()] = frame(glm::dvec3(point.position));
      if (!point.vertex) continue;
      const SurfaceVertexId vertex = surface.surface_of[point.vertex->value()];
      taken_.insert(vertex.value());
      anchors_.push_back({point.id, vertex, surface.positions[vertex.value()]});
    }
  }

  Proposals run() {
    find_mirror_plane();
    guess();
    for (const Turn turn : {Turn::open_skin, Turn::rims, Turn::related}) {
      for (std::size_t id = 0; id < feature_point_count; ++id) {
        if (!settled_[id] && turn_of(id_of(id)) == turn) propose(id);
      }
    }
    correct_sides();
    correct_lid_edges();
    correct_modelled_rims();
    correct_folds();
    std::sort(proposals_.points.begin(), proposals_.points.end(),
              [](const Proposal& a, const Proposal& b) { return a.point.id < b.point.id; });
    std::sort(proposals_.not_proposed.begin(), proposals_.not_proposed.end(),
              [](const NotProposed& a, const NotProposed& b) { return a.id < b.id; });
    return std::move(proposals_);
  }

 private:
  void find_mirror_plane() {
    std::vector<MirrorPair> pairs;
    std::vector<glm::dvec3> middle;
    for (std::size_t id = 0; id < feature_point_count; ++id) {
      if (!settled_[id]) continue;
      if (is_middle(id)) middle.push_back(*settled_[id]);
      if (mpeg4::feature_points[id].side == mpeg4::Side::left && settled_[mirror_of(id)]) {
        pairs.push_back({*settled_[id], *settled_[mirror_of(id)]});
      }
    }
    constexpr std::size_t compared = 4000;
    const std::vector<glm::dvec3> front = front_of(face_);
    plane_ = refine_mirror_plane(fit_mirror_plane(pairs, middle), pairs, middle, thinned(front, compared), front);
  }

  void guess() {
    std::vector<KnownPlace> samples;
    for (std::size_t id = 0; id < feature_point_count; ++id) {
      if (settled_[id]) {
        samples.push_back({id_of(id), *settled_[id], marking_noise});
      } else if (settled_[mirror_of(id)]) {
        images_[id] = plane_.image(*settled_[mirror_of(id)]);
        samples.push_back({id_of(id), *images_[id], mirror_noise});
      }
    }
    guesses_ = guess_by_proportions(samples, references_);
  }

  void propose(std::size_t id) {
    if (!guesses_[id]) return refuse(id, "no reference head has this point");
    if (id_of(id) == parse_feature_point("11.5"))
      return refuse(id, "the thickness of the hair cannot be derived from the face");
    const double error = guesses_[id]->error;
    const glm::dvec3 place = images_[id] ? *images_[id] : related(id, guesses_[id]->place);
    if (id == index_of("7.1") && head_joint_)
      return settle(id, {*head_joint_, std::nullopt}, ProposalMethod::shape, error);
    if (id == index_of("7.1")) return settle(id, {place, std::nullopt}, ProposalMethod::proportion, error);
    if (id == index_of("3.5") || id == index_of("3.6")) {
      const glm::dvec3 pupil = find_pupil(face_, parts_, role_of_point(id_of(id)), place);
      return settle(id, {pupil, std::nullopt}, ProposalMethod::shape, error);
    }
    const PartRole role = role_of_point(id_of(id));
    if (face_.with_role(role).empty()) return refuse(id, "the model has no " + name_of(role));
    if (!images_[id]) {
      // On a coarse mesh the extreme of the chin may be a vertex of the lip above it.
      if (const auto vertex = find_on_shape(id, place);
          vertex && !taken_.contains(*vertex) && order_bounds(id_of(id), settled_).contains(face_.at(*vertex))) {
        return settle(id, {face_.at(*vertex), vertex}, ProposalMethod::shape, error);
      }
    }
    const std::optional<RimVertex> nearest = nearest_vertex(id, role, place, error);
    if (const auto between = place_between(id, role, place, error, nearest)) {
      return settle(id, {*between, std::nullopt}, images_[id] ? ProposalMethod::mirror : ProposalMethod::proportion,
                    std::max(error, 0.5 * glm::distance(*between, place)));
    }
    if (!nearest) return refuse(id, "every vertex of the " + name_of(role) + " already has a point");
    const auto& [vertex, doubt] = *nearest;
    const double off = glm::distance(face_.at(vertex), place);
    if (!is_near(face_.at(vertex), place, error)) {
      return refuse(id, has_surface_near(role, place, error)
                            ? "the surface has no free vertex that fits this point at its expected position"
                            : "the model has no surface at the expected position");
    }
    settle(id, {face_.at(vertex), vertex}, images_[id] ? ProposalMethod::mirror : ProposalMethod::proportion,
           std::max(error, 0.5 * off), doubt);
  }

  /// The known points and those proposed so far.
  [[nodiscard]] std::vector<SurfacePoint> present_points() const {
    FeaturePointSet all = known_;
    for (const Proposal& p : proposals_.points) all.push_back(p.point);
    return surface_points(surface_, all);
  }

  /// The sides of lips and lids again, by all points beside them, of which some were not yet there at the choice: on a
  /// mesh as coarse as a lip the two may differ. Known points stay.
  void correct_sides() {
    for (const MisplacedRimPoint& misplaced : find_misplaced_rim_points(surface_, present_points())) {
      const auto at = proposal_of(misplaced.point.id.value());
      if (at == proposals_.points.end()) continue;
      const std::size_t id = misplaced.point.id.value();
      const ProposalMethod method = at->method;
      proposals_.points.erase(at);
      const std::uint32_t vertex = misplaced.nearest_own.value();
      const double off = glm::distance(face_.at(vertex), *settled_[id]);
      settle(id, {face_.at(vertex), vertex}, method, std::max(guesses_[id]->error, 0.5 * off),
             "the surface is too coarse here to distinguish " + sides_in_words(*misplaced.opening));
    }
  }

  /// Moves proposed middles of lids to the edges of the lids. Mirror images miss them where one eye is higher than the
  /// other.
  void correct_lid_edges() {
    for (const mpeg4::Opening& opening : mpeg4::openings) {
      if (opening.is_mouth) continue;
      const std::size_t upper = index_of(opening.upper.front());
      const std::size_t lower = index_of(opening.lower.front());
      if (!settled_[upper] || !settled_[lower] || settled_[upper]->y <= settled_[lower]->y) continue;
      for (const std::size_t id : {upper, lower}) {
        const auto at = proposal_of(id);
        if (at == proposals_.points.end()) continue;
        constexpr double around = 0.15;
        const glm::dvec3 expected = images_[id] ? *images_[id] : guesses_[id]->place;
        const auto eye = seen_eye(surface_, parts_, triangles_, frame_, expected.x, settled_[lower]->y - around,
                                  settled_[upper]->y + around);
        if (!eye) continue;
        const glm::dvec3& edge = id == upper ? eye->upper : eye->lower;
        const glm::dvec3 before = *settled_[id];
        if (is_on_edge(before.y - edge.y, eye->upper.y - eye->lower.y, 1.0)) continue;
        const double error = guesses_[id]->error;
        const auto nearest = nearest_vertex(id, PartRole::skin, edge, error);
        if (!nearest || glm::distance(face_.at(nearest->vertex), edge) > 0.5 * glm::distance(before, edge)) continue;
        if (at->point.vertex) taken_.erase(surface_.surface_of[at->point.vertex->value()].value());
        proposals_.points.erase(at);
        settle(id, {face_.at(nearest->vertex), nearest->vertex}, ProposalMethod::shape, error, nearest->doubt);
      }
    }
  }

  /// Moves proposed points of lids about an eye that is modelled in the skin to the edges of the lids as they are seen:
  /// mirror images and proportions come to lie on the eye, or beside the lids.
  void correct_modelled_rims() {
    if (triangles_.empty()) return;
    for (std::size_t eye = 0; eye < 2; ++eye) {
      if (!face_.with_role(eyeball_role(eye)).empty()) continue;
      const mpeg4::Opening& lids = mpeg4::lids_of(eye);
      const auto& upper = settled_[index_of(lids.upper.front())];
      const auto& lower = settled_[index_of(lids.lower.front())];
      const auto& left = settled_[index_of(lids.corners[0])];
      const auto& right = settled_[index_of(lids.corners[1])];
      if (!upper || !lower || !left || !right) continue;
      const auto skin = face_.nearest(PartRole::skin, *upper);
      if (!skin) continue;
      const auto rims = find_modelled_rims(surface_, face_.places(), triangles_, surface_.part_of[*skin],
                                           {*upper, *lower, *left, *right});
      if (rims) move_to_rims(eye, lids, *rims);
    }
  }

  /// Moves proposed folds of lids off the edges of the lids, on which they come to lie where the mesh is coarse: the
  /// place of an edge that is marked as a fold stays behind in a blink.
  void correct_folds() {
    const std::vector<SurfacePoint> points = present_points();
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const auto edges = find_eye_edges(surface_, points, eye);
      if (!edges) continue;
      const EyeEdgeLines lines(*edges, face_.places());
      const mpeg4::Opening& lids = mpeg4::lids_of(eye);
      move_off_edges(index_of(eye == 0 ? "3.13" : "3.14"), settled_[index_of(lids.upper.front())]->y, 1.0, lines);
      move_off_edges(index_of(eye == 0 ? "3.9" : "3.10"), settled_[index_of(lids.lower.front())]->y, -1.0, lines);
    }
  }

  /// Moves a fold that lies on an edge to the nearest free vertex above (`side` 1) or below (-1) `height`, that of the
  /// middle of its lid's edge.
  void move_off_edges(std::size_t id, double height, double side, const EyeEdgeLines& edges) {
    const auto at = proposal_of(id);
    if (at == proposals_.points.end() || !at->point.vertex) return;
    if (!edges.has(*settled_[id])) return;
    proposals_.points.erase(at);
    settled_[id].reset();
    const double error = guesses_[id]->error;
    const glm::dvec3 place = images_[id] ? *images_[id] : guesses_[id]->place;
    const OrderBounds bounds = order_bounds(id_of(id), settled_);
    const auto beside = face_.nearest(role_of_point(id_of(id)), place, nullptr, [&](std::uint32_t v) {
      return !taken_.contains(v) && !edges.has(face_.at(v)) && face_.faces_forward_at(v) &&
             (face_.at(v).y - height) * side > 0.0 && bounds.contains(face_.at(v));
    });
    if (!beside || !is_near(face_.at(*beside), place, error))
      return refuse(id, "the surface has no free vertex that fits this point at its expected position");
    settle(id, {face_.at(*beside), *beside}, images_[id] ? ProposalMethod::mirror : ProposalMethod::proportion,
           std::max(error, 0.5 * glm::distance(face_.at(*beside), place)));
  }

  /// To another vertex.
  struct Move {
    std::size_t id;
    std::uint32_t vertex;
  };

  void move_to_rims(std::size_t eye, const mpeg4::Opening& lids, const ModelledRims& rims) {
    const double middle = 0.5 * (rims.left.x + rims.right.x);
    const double width = rims.left.x - rims.right.x;
    std::vector<Move> moves;
    for (const bool is_left : {true, false}) {
      const std::size_t id = index_of(lids.corners[is_left ? 0 : 1]);
      const glm::dvec3& place = is_left ? rims.left : rims.right;
      const bool is_off = glm::distance(*settled_[id], place) > near_corner;
      if (!plan_move(id, place, is_off, rims, moves)) return;
    }
    for (const bool is_upper : {true, false}) {
      const std::size_t id = index_of(is_upper ? lids.upper.front() : lids.lower.front());
      const glm::dvec3& before = *settled_[id];
      const bool is_aside = std::abs(before.x - middle) > greatest_aside * width;
      const ModelledRims::Column& edges = rims.at(is_aside ? middle : before.x);
      const glm::dvec3& place = is_upper ? edges.upper : edges.lower;
      // The person who marked the other eye's lid may have meant a place a little beside what is seen of the edge.
      const double off = (images_[id] ? 0.5 : 1.0) * (before.y - place.y);
      const bool is_off = is_aside || !is_on_edge(off, edges.upper.y - edges.lower.y, 1.0);
      if (!plan_move(id, place, is_off, rims, moves)) return;
    }
    if (moves.empty() || !closes_after(moves, eye, lids)) return;
    for (const Move& move : moves) {
      const auto at = proposal_of(move.id);
      taken_.erase(surface_.surface_of[at->point.vertex->value()].value());
      proposals_.points.erase(at);
    }
    for (const Move& move : moves) {
      const double off = glm::distance(face_.at(move.vertex), *settled_[move.id]);
      settle(move.id, {face_.at(move.vertex), move.vertex}, ProposalMethod::shape,
             std::max(guesses_[move.id]->error, 0.5 * off));
    }
    center_pupil(index_of(eye == 0 ? "3.5" : "3.6"), rims);
  }

  /// A proposed pupil, which was beside the middle of an eye whose lids were elsewhere: to its middle.
  void center_pupil(std::size_t id, const ModelledRims& rims) {
    const auto at = proposal_of(id);
    if (at == proposals_.points.end()) return;
    const ModelledRims::Column& middle = rims.columns[rims.columns.size() / 2];
    glm::dvec3 place = 0.5 * (middle.upper + middle.lower);
    const auto aside = [&](SurfaceVertexId v) {
      return glm::distance(glm::dvec2(face_.at(v.value())), glm::dvec2(place));
    };
    const auto nearest = std::min_element(rims.of_eye.begin(), rims.of_eye.end(),
                                          [&](SurfaceVertexId a, SurfaceVertexId b) { return aside(a) < aside(b); });
    if (nearest != rims.of_eye.end()) place.z = face_.at(nearest->value()).z;
    if (glm::distance(*settled_[id], place) < near_middle) return;
    proposals_.points.erase(at);
    settle(id, {place, std::nullopt}, ProposalMethod::shape, guesses_[id]->error);
  }

  /// Adds a move to the vertex nearest to `place`, of a proposed point that is `off` it or on the eye. False if the
  /// edges cannot be those of this eye: they are too far from a marked point, or from where the point is expected.
  bool plan_move(std::size_t id, const glm::dvec3& place, bool is_off, const ModelledRims& rims,
                 std::vector<Move>& moves) {
    const auto at = proposal_of(id);
    if (at == proposals_.points.end()) return glm::distance(*settled_[id], place) < near_marked;
    if (!at->point.vertex) return true;
    const std::uint32_t before = surface_.surface_of[at->point.vertex->value()].value();
    if (!is_off && !rims.is_of_eye(SurfaceVertexId(before))) return true;
    const auto vertex = face_.nearest(PartRole::skin, place, nullptr, [&](std::uint32_t v) {
      return (v == before || !taken_.contains(v)) && !rims.is_of_eye(SurfaceVertexId(v));
    });
    if (!vertex || !is_near(face_.at(*vertex), *settled_[id], guesses_[id]->error)) return false;
    if (*vertex != before) moves.push_back({id, *vertex});
    return true;
  }

  /// Whether the points keep their order on the face when they are moved, and lids of one skin close over their eye.
  [[nodiscard]] bool closes_after(const std::vector<Move>& moves, std::size_t eye, const mpeg4::Opening& lids) const {
    Places moved = settled_;
    for (const Move& move : moves) moved[move.id] = face_.at(move.vertex);
    if (std::any_of(moves.begin(), moves.end(), [&](const Move& move) {
          return !order_bounds(id_of(move.id), moved).contains(face_.at(move.vertex));
        }))
      return false;
    std::vector<SurfacePoint> points = present_points();
    for (SurfacePoint& point : points) {
      for (const Move& move : moves) {
        if (point.id != id_of(move.id)) continue;
        point = {point.id, SurfaceVertexId(move.vertex), surface_.positions[move.vertex]};
      }
    }
    return !are_joined(surface_, lids, points) || find_modelled_eyes(surface_, triangles_, parts_, points)[eye];
  }

  std::vector<Proposal>::iterator proposal_of(std::size_t id) {
    return std::find_if(proposals_.points.begin(), proposals_.points.end(),
                        [id](const Proposal& p) { return p.point.id == id_of(id); });
  }

  /// Whether a place of the surface may be the point expected at `place`.
  static bool is_near(const glm::dvec3& of_surface, const glm::dvec3& place, double error) {
    return glm::distance(of_surface, place) <= 0.15 + error;
  }

  /// Whether there is any surface near a place: with vertices that have a point, or are of the other lip or lid.
  [[nodiscard]] bool has_surface_near(PartRole role, const glm::dvec3& place, double error) const {
    const auto vertex = face_.nearest(role, place);
    if (vertex && is_near(face_.at(*vertex), place, error)) return true;
    const auto between = face_.nearest_between(role, place, false);
    return between && is_near(*between, place, error);
  }

  /// On a coarse mesh: a place between vertices that is clearly nearer to the expected one than `nearest`, the vertex
  /// to choose otherwise. It keeps the order of the points on a face and does not come near another point. Not
  /// for lips and lids, because only vertices have a side.
  [[nodiscard]] std::optional<glm::dvec3> place_between(std::size_t id, PartRole role, const glm::dvec3& place,
                                                        double error, const std::optional<RimVertex>& nearest) const {
    constexpr double of_a_vertex = 0.05;
    constexpr double apart = 0.03;
    if (rim_of_point(id_of(id)).opening != nullptr) return std::nullopt;
    const double off =
        nearest ? glm::distance(face_.at(nearest->vertex), place) : std::numeric_limits<double>::infinity();
    if (off < of_a_vertex) return std::nullopt;
    const auto between = face_.nearest_between(role, place, is_on_front(id_of(id)));
    if (!between || !is_near(*between, place, error) || glm::distance(*between, place) > 0.5 * off) return std::nullopt;
    if (!order_bounds(id_of(id), settled_).contains(*between)) return std::nullopt;
    const bool is_free = std::none_of(settled_.begin(), settled_.end(), [&](const std::optional<glm::dvec3>& other) {
      return other && glm::distance(*other, *between) < apart;
    });
    return is_free ? between : std::nullopt;
  }

  /// Considers only vertices without a point: the parametrization needs a vertex of its own for each point. Prefers
  /// those that keep the order of the points on a face. Empty if the role has none left.
  std::optional<RimVertex> nearest_vertex(std::size_t id, PartRole role, const glm::dvec3& place, double error) {
    const MirrorPlane* const on = is_middle(id) ? &plane_ : nullptr;
    const RimOfPoint rim = rim_of_point(id_of(id));
    const auto nearest = [&](const FaceSurface::Filter& filter) -> std::optional<RimVertex> {
      if (rim.opening != nullptr) return rims_.nearest(rim, role, place, error, on, filter);
      const auto vertex = face_.nearest(role, place, on, filter);
      return vertex ? std::optional(RimVertex{*vertex, {}}) : std::nullopt;
    };
    const FaceSurface::Filter is_free = [this](std::uint32_t v) { return !taken_.contains(v); };
    // On a coarse mesh the nearest vertex may be beyond a neighbour: a fold of a lid above the lid's edge. An order
    // that leaves nothing near the place is that of a misplaced point, which the doctor names.
    const OrderBounds bounds = order_bounds(id_of(id), settled_);
    const auto is_in_order = [&](std::uint32_t v) { return is_free(v) && bounds.contains(face_.at(v)); };
    if (is_on_front(id_of(id))) {  // not on the inner wall of a double surface
      auto outer = nearest([&](std::uint32_t v) { return is_in_order(v) && face_.faces_forward_at(v); });
      if (outer && is_near(face_.at(outer->vertex), place, error)) return outer;
    }
    auto in_order = nearest(is_in_order);
    if (in_order && is_near(face_.at(in_order->vertex), place, error)) return in_order;
    auto out_of_order = nearest(is_free);
    if (out_of_order && out_of_order->doubt.empty())
      out_of_order->doubt = "no free vertex near here keeps the order in which the points stand on a face";
    return out_of_order;
  }

  std::optional<std::uint32_t> find_on_shape(std::size_t id, const glm::dvec3& place) const {
    const auto& tongue = settled_[index_of("6.2")];
    const bool left = id == index_of("6.3");
    if ((left || id == index_of("6.4")) && tongue && is_tongue_alone(face_)) {
      return border_of_tongue(face_, *tongue, left ? 1.0 : -1.0);
    }
    return find_extreme(face_, plane_, id_of(id), place);
  }

  glm::dvec3 related(std::size_t id, const glm::dvec3& place) const {
    if (id == index_of("6.2") && settled_[index_of("6.1")] && is_tongue_alone(face_)) {
      return middle_of_tongue(face_, plane_, *settled_[index_of("6.1")], place);
    }
    return apply_relations(id_of(id), place, settled_);
  }

  /// Mean length of the edges at a vertex, in ES0.
  double edge_length_at(std::uint32_t vertex) const {
    const auto steps = surface_.steps_from(SurfaceVertexId(vertex));
    double sum = 0.0;
    for (const Surface::Step& step : steps) sum += step.length;
    return steps.empty() ? 0.0 : frame_.scale * sum / static_cast<double>(steps.size());
  }

  static std::string name_of(PartRole role) {
    std::string name(part_role_names[static_cast<std::size_t>(role)]);
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
  }

  void refuse(std::size_t id, std::string reason) { proposals_.not_proposed.push_back({id_of(id), std::move(reason)}); }

  void settle(std::size_t id, const Spot& spot, ProposalMethod method, double error, std::string doubt = {}) {
    if (spot.vertex) taken_.insert(*spot.vertex);
    settled_[id] = spot.place;
    // A vertex of a lip or lid that was chosen by its side is not evidence for sides.
    if (spot.vertex && rim_of_point(id_of(id)).opening == nullptr) {
      anchors_.push_back({id_of(id), SurfaceVertexId(*spot.vertex), surface_.positions[*spot.vertex]});
    }
    Proposal proposal;
    proposal.point.id = id_of(id);
    proposal.method = method;
    if (method != ProposalMethod::mirror) error = std::hypot(error, difference_between_heads(id_of(id)));
    if (spot.vertex) error = std::hypot(error, between_vertices * edge_length_at(*spot.vertex));
    const double radius = nine_in_ten * error;
    proposal.expected_error = radius;
    proposal.confidence = radius < surely ? Confidence::high : radius < about ? Confidence::medium : Confidence::low;
    if (!doubt.empty()) proposal.confidence = std::max(proposal.confidence, Confidence::medium);
    proposal.remark = std::move(doubt);
    if (spot.vertex) {
      proposal.point.vertex = surface_.file_vertex_of[*spot.vertex];
      proposal.point.position = glm::vec3(surface_.positions[*spot.vertex]);
    } else {
      const glm::dvec3 back = glm::transpose(frame_.rotation) * (spot.place - frame_.to) / frame_.scale;
      proposal.point.position = glm::vec3(frame_.from + back);
    }
    proposals_.points.push_back(proposal);
  }

  const Surface& surface_;
  std::span<const Part> parts_;
  Similarity frame_;
  const FeaturePointSet& known_;
  FaceSurface face_;
  std::span<const Triangle> triangles_;  ///< of file vertices, may be empty
  std::span<const ReferenceHead> references_;
  std::optional<glm::dvec3> head_joint_;
  MirrorPlane plane_;
  Places settled_;                           ///< known, and proposed so far
  std::unordered_set<std::uint32_t> taken_;  ///< surface vertices with a point
  std::vector<SurfacePoint> anchors_;        ///< the known points, and those proposed on open skin
  RimChoice rims_{face_, anchors_};
  Places images_;  ///< mirror images of known points whose partner is not known
  std::array<std::optional<Guess>, feature_point_count> guesses_;
  Proposals proposals_;
};

std::string missing_of_quick_set(const FeaturePointSet& known) {
  std::string missing;
  for (const std::string_view name : quick_set) {
    if (find_point(known, name) == nullptr) missing += (missing.empty() ? "" : ", ") + std::string(name);
  }
  return missing.empty() ? "" : "; missing from the quick set: " + missing;
}

}  // namespace

std::optional<Error> find_too_few_known(const FeaturePointSet& known) {
  if (known.size() >= least_known_points) return std::nullopt;
  return Error{ErrorCode::missing, "/points",
               "proposals need at least " + std::to_string(least_known_points) + " placed points, but there are " +
                   std::to_string(known.size()) + missing_of_quick_set(known)};
}

Result<Proposals> propose_feature_points(const Surface& surface, std::span<const Part> parts,
                                         const FeaturePointSet& known, std::span<const ReferenceHead> references,
                                         const NeckJoints& joints, std::span<const Triangle> triangles) {
  if (std::optional<Error> fault = find_too_few_known(known)) return std::move(*fault);
  Places places;
  for (const FeaturePoint& point : known) places[point.id.value()] = glm::dvec3(point.position);
  std::optional<Similarity> frame = fit_to_references(places, references);
  if (!frame) {
    return Error{
        ErrorCode::missing, "/points",
        "the placed points are on one line or at one place, so the orientation of the head cannot be determined" +
            missing_of_quick_set(known)};
  }
  frame->rotation = to_quarter_turns(frame->rotation);
  return Proposer(surface, parts, *frame, known, references, plausible_joints(joints, parts, known).head, triangles)
      .run();
}

}  // namespace semblante
