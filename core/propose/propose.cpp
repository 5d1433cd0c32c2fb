#include "core/propose/propose.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/anatomy/part_roles.h"
#include "core/anatomy/plausible_joints.h"
#include "core/anatomy/point_lookup.h"
#include "core/anatomy/point_order.h"
#include "core/anatomy/rim_points.h"
#include "core/propose/draft.h"
#include "core/propose/found_points.h"
#include "core/propose/lid_corrections.h"
#include "core/propose/modelled_rim_corrections.h"
#include "core/propose/mouth_and_eyes.h"
#include "core/propose/quick_set.h"
#include "core/propose/relations.h"
#include "core/propose/shape_rules.h"

namespace semblante {
namespace {

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

/// Order of the proposals by dependency: points near lips and lids determine their sides, middles and corners the
/// points between them.
enum class Turn : std::uint8_t { open_skin, rims, related };

Turn turn_of(FeaturePointId id) {
  if (has_relation(id)) return Turn::related;
  return rim_of_point(id).opening != nullptr ? Turn::rims : Turn::open_skin;
}

std::string name_of(PartRole role) {
  std::string name(part_role_names[static_cast<std::size_t>(role)]);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// Where the shape itself shows the point: an extreme of it, or the border of the tongue.
std::optional<std::uint32_t> find_on_shape(const Draft& draft, std::size_t id, const glm::dvec3& place) {
  const auto& tongue = draft.settled()[index_of("6.2")];
  const bool left = id == index_of("6.3");
  if ((left || id == index_of("6.4")) && tongue && is_tongue_alone(draft.face())) {
    return border_of_tongue(draft.face(), *tongue, left ? 1.0 : -1.0);
  }
  return find_extreme(draft.face(), draft.plane(), id_of(id), place);
}

glm::dvec3 related(const Draft& draft, std::size_t id, const glm::dvec3& place) {
  const auto& tip = draft.settled()[index_of("6.1")];
  if (id == index_of("6.2") && tip && is_tongue_alone(draft.face())) {
    return middle_of_tongue(draft.face(), draft.plane(), *tip, place);
  }
  return apply_relations(id_of(id), place, draft.settled());
}

/// The nearest vertex on the point's own side of a lip or lid; if it is far, the one at the mirror image of a known
/// point.
std::optional<RimVertex> choose_vertex(Draft& draft, std::size_t id, PartRole role, const glm::dvec3& place,
                                       double error) {
  constexpr double far = 0.08;  // more than the rims of a nearly closed eye, or of lips that touch, are apart
  auto nearest = draft.nearest_vertex(id, role, place, error);
  if (nearest && glm::distance(draft.face().at(nearest->vertex), place) < far) return nearest;
  auto at_image = draft.vertex_at_image(id, role);
  return at_image ? at_image : nearest;
}

/// Proposes a point on the surface of its part, expected at `place`.
void propose_on_surface(Draft& draft, std::size_t id, const glm::dvec3& place) {
  const FaceSurface& face = draft.face();
  const double error = draft.error(id);
  const PartRole role = role_of_point(id_of(id));
  if (face.with_role(role).empty()) return draft.refuse(id, "the model has no " + name_of(role));
  if (!draft.has_image(id)) {
    // On a coarse mesh the extreme of the chin may be a vertex of the lip above it.
    if (const auto vertex = find_on_shape(draft, id, place);
        vertex && draft.is_free(*vertex) && order_bounds(id_of(id), draft.settled()).contains(face.at(*vertex))) {
      return draft.settle(id, {face.at(*vertex), vertex}, ProposalMethod::shape, error);
    }
  }
  const auto error_at = [&](const glm::dvec3& chosen) { return std::max(error, 0.5 * glm::distance(chosen, place)); };
  const std::optional<RimVertex> nearest = choose_vertex(draft, id, role, place, error);
  if (const auto between = draft.place_between(id, role, place, error, nearest)) {
    return draft.settle(id, {*between, std::nullopt}, draft.method(id), error_at(*between));
  }
  if (!nearest) return draft.refuse(id, "every vertex of the " + name_of(role) + " already has a point");
  const glm::dvec3& at = face.at(nearest->vertex);
  if (!Draft::is_near(at, place, error)) {
    return draft.refuse(id, draft.has_surface_near(role, place, error)
                                ? "the surface has no free vertex that fits this point at its expected position"
                                : "the model has no surface at the expected position");
  }
  // A lid of its own is an upper or a lower lid as its mirror image is.
  const std::string doubt = draft.is_on_lid_of_image(id, nearest->vertex) ? "" : nearest->doubt;
  draft.settle(id, {at, nearest->vertex}, draft.method(id), error_at(at), doubt);
}

/// `head_joint`: in the frame of the draft.
void propose(Draft& draft, std::size_t id, const std::optional<glm::dvec3>& head_joint) {
  if (!draft.is_expected(id)) return draft.refuse(id, "no reference head has this point");
  if (id == index_of("11.5")) return draft.refuse(id, "the thickness of the hair cannot be derived from the face");
  const double error = draft.error(id);
  const glm::dvec3 place = draft.has_image(id) ? draft.expected(id) : related(draft, id, draft.expected(id));
  if (id == index_of("7.1")) {
    return draft.settle(id, {head_joint.value_or(place), std::nullopt},
                        head_joint ? ProposalMethod::shape : ProposalMethod::proportion, error);
  }
  if (id == index_of("3.5") || id == index_of("3.6")) {
    const glm::dvec3 pupil = find_pupil(draft.face(), draft.head().parts, role_of_point(id_of(id)), place);
    return draft.settle(id, {pupil, std::nullopt}, ProposalMethod::shape, error);
  }
  propose_on_surface(draft, id, place);
}

/// The points to place next: as many as proposals need, for all twenty are too many to read.
std::string next_of_quick_set(const FeaturePointSet& known) {
  std::string names;
  std::size_t count = 0;
  for (const std::string_view name : quick_set) {
    if (count == least_known_points) break;
    if (find_point(known, name) != nullptr) continue;
    names += (names.empty() ? "" : ", ") + std::string(name);
    ++count;
  }
  return names.empty() ? "" : "; next of the quick set: " + names;
}

bool has_vertex(const FeaturePointSet& points, const Surface& surface, VertexId vertex) {
  return std::any_of(points.begin(), points.end(), [&](const FeaturePoint& point) {
    return point.vertex && surface.surface_of[point.vertex->value()] == surface.surface_of[vertex.value()];
  });
}

Error too_few(const FeaturePointSet& marked, const std::string& why_none_by_shape) {
  return Error{ErrorCode::missing, "/points",
               "proposals need at least " + std::to_string(least_known_points) + " placed points, but there are " +
                   std::to_string(marked.size()) + "; the shape of the face does not show them: " + why_none_by_shape +
                   next_of_quick_set(marked)};
}

/// Minimum number of marked points and those found by eyeballs together. Less than of marked points alone: found ones
/// are spread over the face, and of an eye that is shut only the pupil is found.
constexpr std::size_t least_with_found = 6;

/// With too few marked points, those that the shape of the face shows beside them; otherwise none.
Result<std::vector<FoundPoint>> find_missing(const Surface& surface, std::span<const Part> parts,
                                             std::span<const Triangle> triangles, const FeaturePointSet& marked,
                                             std::span<const ReferenceHead> references) {
  if (marked.size() >= least_known_points) return std::vector<FoundPoint>();
  const auto without_marked = [&](std::vector<FoundPoint> found) {
    std::erase_if(found, [&](const FoundPoint& f) {
      return find_point(marked, f.point.id) != nullptr ||
             (f.point.vertex && has_vertex(marked, surface, *f.point.vertex));
    });
    return found;
  };
  const auto by_eyeballs = find_points_by_eyeballs(surface, parts, triangles, references);
  std::string why = by_eyeballs ? "" : by_eyeballs.error().message;
  if (by_eyeballs) {
    auto found = without_marked(*by_eyeballs);
    if (marked.size() + found.size() >= least_with_found) return found;
    why = "only " + std::to_string(found.size()) + " are seen";
  }
  auto found = find_points_by_likeness(surface, parts, triangles, references);
  if (found.empty()) return too_few(marked, why + ", and nothing seen from the front is like a face");
  return without_marked(std::move(found));
}

/// A part with a found point of the skin is skin, as one with a marked point is.
std::vector<Part> with_found_skin(const Surface& surface, std::span<const Part> parts,
                                  std::span<const FoundPoint> found) {
  std::vector<Part> changed(parts.begin(), parts.end());
  for (const auto& [point, noise] : found) {
    if (!point.vertex || !is_skin_point(point.id)) continue;
    Part& part = changed[surface.part_of[surface.surface_of[point.vertex->value()].value()].value()];
    if (!part.role_by_user) part.role = PartRole::skin;
  }
  return changed;
}

FeaturePointSet with_found(FeaturePointSet points, std::span<const FoundPoint> found) {
  for (const FoundPoint& f : found) points.push_back(f.point);
  std::sort(points.begin(), points.end(), [](const FeaturePoint& a, const FeaturePoint& b) { return a.id < b.id; });
  return points;
}

}  // namespace

Result<Proposals> propose_feature_points(const Surface& surface, std::span<const Part> described,
                                         const FeaturePointSet& marked, std::span<const ReferenceHead> references,
                                         const NeckJoints& joints, std::span<const Triangle> triangles) {
  const auto found = find_missing(surface, described, triangles, marked, references);
  if (!found) return found.error();
  const std::vector<Part> parts = with_found_skin(surface, described, *found);
  const FeaturePointSet known = with_found(marked, *found);
  Places places;
  for (const FeaturePoint& point : known) places[point.id.value()] = glm::dvec3(point.position);
  std::optional<Similarity> frame = fit_to_references(places, references);
  if (!frame) {
    return Error{
        ErrorCode::missing, "/points",
        "the placed points are on one line or at one place, so the orientation of the head cannot be determined" +
            next_of_quick_set(known)};
  }
  frame->rotation = to_quarter_turns(frame->rotation);
  Draft draft({surface, parts, triangles, known, *found}, *frame, references);
  std::optional<glm::dvec3> head_joint;
  if (const auto joint = plausible_joints(joints, parts, known).head)
    head_joint = (*frame)(glm::dvec3(joint->position));
  for (const Turn turn : {Turn::open_skin, Turn::rims, Turn::related}) {
    for (const bool of_image : {true, false}) {  // a guess does not take the vertex at the image of a known point
      for (std::size_t id = 0; id < feature_point_count; ++id) {
        const bool is_next = !draft.settled()[id] && turn_of(id_of(id)) == turn && draft.has_image(id) == of_image;
        if (is_next) propose(draft, id, head_joint);
      }
    }
  }
  correct_sides(draft);
  correct_lid_edges(draft);
  correct_modelled_rims(draft);
  correct_folds(draft);
  return draft.take();
}

}  // namespace semblante
