#include "core/propose/draft.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/anatomy/front_points.h"
#include "core/anatomy/part_roles.h"
#include "core/anatomy/point_order.h"
#include "core/propose/mouth_and_eyes.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

// All in ES0.
constexpr double marking_noise = 0.015;  ///< standard deviation of a marked point
constexpr double mirror_noise = 0.02;    ///< standard deviation of the mirror image of a marked point
constexpr double surely = 0.12;          ///< largest claimed radius of `high` confidence
constexpr double about = 0.26;           ///< largest claimed radius of `medium` confidence
// How far an eyeball may lie from the mirror image of the other one, with the difference of their radii.
constexpr double least_off_mirror = 0.05;  ///< below it, mirror images of points need no correction
constexpr double most_off_mirror = 0.5;    ///< above it, one of the two is no eyeball

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

/// The piece of the surface with most of the points.
PartId piece_with_most(const Surface& surface, const FeaturePointSet& points) {
  std::vector<std::size_t> count(std::max<std::size_t>(1, surface.part_count()));
  for (const FeaturePoint& p : points) {
    if (p.vertex) ++count[surface.part_of[surface.surface_of[p.vertex->value()].value()].value()];
  }
  return PartId(static_cast<std::uint32_t>(std::max_element(count.begin(), count.end()) - count.begin()));
}

/// `spacing`: mean length of the edges at the point's vertex, if it has one.
Proposal proposal_of(const FeaturePoint& point, ProposalMethod method, double error, std::optional<double> spacing) {
  const double radius = nine_in_ten * (spacing ? std::hypot(error, between_vertices * *spacing) : error);
  const Confidence confidence = radius < surely  ? Confidence::high
                                : radius < about ? Confidence::medium
                                                 : Confidence::low;
  return {point, method, confidence, radius, {}};
}

}  // namespace

FeaturePointId id_of(std::size_t id) { return FeaturePointId(static_cast<std::uint8_t>(id)); }
std::size_t index_of(std::string_view name) { return parse_feature_point(name)->value(); }

Draft::Draft(const HeadToMark& head, const Similarity& frame, std::span<const ReferenceHead> references)
    : head_(head),
      frame_(frame),
      face_(head.surface, head.parts, frame, head.triangles),
      piece_of_face_(piece_with_most(head.surface, head.known)) {
  for (std::size_t eye = 0; eye < 2; ++eye) eyeballs_[eye] = find_eyeball(face_, head.parts, eyeball_role(eye));
  for (const FeaturePoint& point : head.known) {
    settled_[point.id.value()] = frame(glm::dvec3(point.position));
    if (!point.vertex) continue;
    const SurfaceVertexId vertex = head.surface.surface_of[point.vertex->value()];
    taken_.insert(vertex.value());
    anchors_.push_back({point.id, vertex, head.surface.positions[vertex.value()]});
  }
  find_mirror_plane();
  guess(references);
}

void Draft::find_mirror_plane() {
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

/// The mirror image of the known partner of a point. That of a point of an eye is moved and scaled with the eyeball
/// where one eye is higher than the other, nearer to the nose or larger.
glm::dvec3 Draft::mirror_image(std::size_t id) const {
  const glm::dvec3 image = plane_.image(*settled_[mirror_of(id)]);
  if (group_of(id_of(id)) != 3) return image;
  const bool is_left = mpeg4::feature_points[id].side == mpeg4::Side::left;
  const auto& own = eyeballs_[is_left ? 0 : 1];
  const auto& other = eyeballs_[is_left ? 1 : 0];
  if (!own || !other) return image;
  const glm::dvec3 mirrored = plane_.image(other->center);
  const double scale = own->radius / other->radius;
  const double off = glm::distance(own->center, mirrored) + std::abs(own->radius - other->radius);
  if (off < least_off_mirror || off > most_off_mirror) return image;
  return own->center + scale * (image - mirrored);
}

/// The piece of the surface on which the known point lies whose mirror image is to be placed; empty without a vertex.
std::optional<PartId> Draft::piece_of_partner(std::size_t id) const {
  const FeaturePoint* const partner = images_[id] ? find_point(head_.known, id_of(mirror_of(id))) : nullptr;
  if (partner == nullptr || !partner->vertex) return std::nullopt;
  return head_.surface.part_of[head_.surface.surface_of[partner->vertex->value()].value()];
}

/// Whether a vertex agrees with `partner`, the piece of the known point whose mirror image is to be placed: both are
/// the piece of the face, or both are others, such as lids.
bool Draft::is_on_piece_of_image(PartId partner, std::uint32_t vertex) const {
  return (head_.surface.part_of[vertex] == piece_of_face_) == (partner == piece_of_face_);
}

bool Draft::is_on_lid_of_image(std::size_t id, std::uint32_t vertex) const {
  const std::optional<PartId> partner = piece_of_partner(id);
  return partner && *partner != piece_of_face_ && is_on_piece_of_image(*partner, vertex);
}

/// Whether one lid of an eye is a piece of its own and the other is not, as those of the other eye show.
bool Draft::are_apart(const mpeg4::Opening& lids) const {
  const auto upper = piece_of_partner(index_of(lids.upper.front()));
  const auto lower = piece_of_partner(index_of(lids.lower.front()));
  return upper && lower && *upper != *lower;
}

/// The standard deviation of a known point.
double Draft::noise_of(std::size_t known) const {
  const auto at = std::find_if(head_.found.begin(), head_.found.end(),
                               [&](const FoundPoint& found) { return found.point.id == id_of(known); });
  return at == head_.found.end() ? marking_noise : at->noise;
}

void Draft::guess(std::span<const ReferenceHead> references) {
  std::vector<KnownPlace> samples;
  for (std::size_t id = 0; id < feature_point_count; ++id) {
    if (settled_[id]) {
      samples.push_back({id_of(id), *settled_[id], noise_of(id)});
    } else if (settled_[mirror_of(id)]) {
      images_[id] = mirror_image(id);
      samples.push_back({id_of(id), *images_[id], mirror_noise});
    }
  }
  guesses_ = guess_by_proportions(samples, references);
}

std::vector<SurfacePoint> Draft::present_points() const {
  FeaturePointSet all = head_.known;
  for (const Proposal& p : proposals_.points) all.push_back(p.point);
  return surface_points(head_.surface, all);
}

const glm::dvec3& Draft::expected(std::size_t id) const { return images_[id] ? *images_[id] : guesses_[id]->place; }

ProposalMethod Draft::method(std::size_t id) const {
  return images_[id] ? ProposalMethod::mirror : ProposalMethod::proportion;
}

bool Draft::is_near(const glm::dvec3& of_surface, const glm::dvec3& place, double error) {
  return glm::distance(of_surface, place) <= 0.15 + error;
}

bool Draft::has_surface_near(PartRole role, const glm::dvec3& place, double error) const {
  const auto vertex = face_.nearest(role, place);
  if (vertex && is_near(face_.at(*vertex), place, error)) return true;
  const auto between = face_.nearest_between(role, place, false);
  return between && is_near(*between, place, error);
}

std::optional<RimVertex> Draft::nearest_vertex(std::size_t id, PartRole role, const glm::dvec3& place, double error) {
  const MirrorPlane* const on = is_middle(id) ? &plane_ : nullptr;
  const RimOfPoint rim = rim_of_point(id_of(id));
  const auto nearest = [&](const FaceSurface::Filter& filter) -> std::optional<RimVertex> {
    if (rim.opening != nullptr) return rims_.nearest(rim, role, place, error, on, filter);
    const auto vertex = face_.nearest(role, place, on, filter);
    return vertex ? std::optional(RimVertex{*vertex, {}}) : std::nullopt;
  };
  const FaceSurface::Filter has_no_point = [this](std::uint32_t v) { return is_free(v); };
  // On a coarse mesh the nearest vertex may be beyond a neighbour: a fold of a lid above the lid's edge. An order
  // that leaves nothing near the place is that of a misplaced point, which the doctor names.
  const OrderBounds bounds = order_bounds(id_of(id), settled_);
  const auto is_in_order = [&](std::uint32_t v) { return is_free(v) && bounds.contains(face_.at(v)); };
  const std::optional<PartId> partner = piece_of_partner(id);
  if (partner && rim.opening != nullptr && are_apart(*rim.opening)) {  // not on the other lid
    auto on_piece = nearest([&](std::uint32_t v) {
      return is_in_order(v) && face_.faces_forward_at(v) && is_on_piece_of_image(*partner, v);
    });
    if (on_piece && is_near(face_.at(on_piece->vertex), place, error)) return on_piece;
  }
  if (is_on_front(id_of(id))) {  // not on the inner wall of a double surface
    auto outer = nearest([&](std::uint32_t v) { return is_in_order(v) && face_.faces_forward_at(v); });
    if (outer && is_near(face_.at(outer->vertex), place, error)) return outer;
  }
  auto in_order = nearest(is_in_order);
  if (in_order && is_near(face_.at(in_order->vertex), place, error)) return in_order;
  auto out_of_order = nearest(has_no_point);
  if (out_of_order && out_of_order->doubt.empty())
    out_of_order->doubt = "no free vertex near here keeps the order in which the points stand on a face";
  return out_of_order;
}

std::optional<RimVertex> Draft::vertex_at_image(std::size_t id, PartRole role) {
  constexpr double of_an_image = 0.05;
  const RimOfPoint rim = rim_of_point(id_of(id));
  if (!images_[id] || rim.opening == nullptr) return std::nullopt;
  const OrderBounds bounds = order_bounds(id_of(id), settled_);
  const auto vertex = face_.nearest(role, *images_[id], nullptr,
                                    [&](std::uint32_t v) { return is_free(v) && bounds.contains(face_.at(v)); });
  if (!vertex || glm::distance(face_.at(*vertex), *images_[id]) > of_an_image) return std::nullopt;
  if (rims_.is_surely_beyond(rim, *vertex)) return std::nullopt;
  return RimVertex{*vertex, undistinguished(*rim.opening)};
}

std::optional<glm::dvec3> Draft::place_between(std::size_t id, PartRole role, const glm::dvec3& place, double error,
                                               const std::optional<RimVertex>& nearest) const {
  constexpr double of_a_vertex = 0.05;
  constexpr double apart = 0.03;
  if (rim_of_point(id_of(id)).opening != nullptr) return std::nullopt;
  const double off =
      nearest ? glm::distance(face_.at(nearest->vertex), place) : std::numeric_limits<double>::infinity();
  if (off < of_a_vertex) return std::nullopt;
  const auto between = face_.nearest_between(role, place, is_on_front(id_of(id)));
  if (!between || !is_near(*between, place, error) || glm::distance(*between, place) > 0.5 * off) return std::nullopt;
  if (!order_bounds(id_of(id), settled_).contains(*between)) return std::nullopt;
  const bool is_apart = std::none_of(settled_.begin(), settled_.end(), [&](const std::optional<glm::dvec3>& other) {
    return other && glm::distance(*other, *between) < apart;
  });
  return is_apart ? between : std::nullopt;
}

const Proposal* Draft::find_proposal(std::size_t id) const {
  const auto at = std::find_if(proposals_.points.begin(), proposals_.points.end(),
                               [id](const Proposal& p) { return p.point.id == id_of(id); });
  return at == proposals_.points.end() ? nullptr : &*at;
}

std::optional<std::uint32_t> Draft::proposed_vertex(std::size_t id) const {
  const Proposal* const proposal = find_proposal(id);
  if (proposal == nullptr || !proposal->point.vertex) return std::nullopt;
  return head_.surface.surface_of[proposal->point.vertex->value()].value();
}

void Draft::settle(std::size_t id, const Spot& spot, ProposalMethod method, double error, std::string doubt) {
  if (spot.vertex) taken_.insert(*spot.vertex);
  settled_[id] = spot.place;
  // A vertex of a lip or lid that was chosen by its side is not evidence for sides.
  if (spot.vertex && rim_of_point(id_of(id)).opening == nullptr) {
    anchors_.push_back({id_of(id), SurfaceVertexId(*spot.vertex), head_.surface.positions[*spot.vertex]});
  }
  if (method != ProposalMethod::mirror) error = std::hypot(error, difference_between_heads(id_of(id)));
  const auto spacing = spot.vertex ? std::optional(face_.spacing(*spot.vertex)) : std::nullopt;
  Proposal proposal = proposal_of({id_of(id), std::nullopt}, method, error, spacing);
  if (!doubt.empty()) proposal.confidence = std::max(proposal.confidence, Confidence::medium);
  proposal.remark = std::move(doubt);
  if (spot.vertex) {
    proposal.point.vertex = head_.surface.file_vertex_of[*spot.vertex];
    proposal.point.position = glm::vec3(head_.surface.positions[*spot.vertex]);
  } else {
    proposal.point.position = glm::vec3(frame_.back(spot.place));
  }
  proposals_.points.push_back(std::move(proposal));
}

void Draft::withdraw(std::size_t id) {
  if (const auto vertex = proposed_vertex(id)) taken_.erase(*vertex);
  settled_[id].reset();
  std::erase_if(proposals_.points, [id](const Proposal& p) { return p.point.id == id_of(id); });
}

void Draft::refuse(std::size_t id, std::string reason) {
  proposals_.not_proposed.push_back({id_of(id), std::move(reason)});
}

void Draft::propose_found() {
  for (const auto& [point, noise] : head_.found) {
    std::optional<double> spacing;
    if (point.vertex) spacing = face_.spacing(head_.surface.surface_of[point.vertex->value()].value());
    proposals_.points.push_back(proposal_of(point, ProposalMethod::shape, noise, spacing));
  }
}

Proposals Draft::take() {
  propose_found();
  std::sort(proposals_.points.begin(), proposals_.points.end(),
            [](const Proposal& a, const Proposal& b) { return a.point.id < b.point.id; });
  std::sort(proposals_.not_proposed.begin(), proposals_.not_proposed.end(),
            [](const NotProposed& a, const NotProposed& b) { return a.id < b.id; });
  return std::move(proposals_);
}

}  // namespace semblante
