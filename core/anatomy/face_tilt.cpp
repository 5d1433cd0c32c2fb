#include "core/anatomy/face_tilt.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/anatomy/point_symmetry.h"
#include "core/geometry/rotation.h"
#include "core/tables/mpeg4.h"
#include "core/types/places.h"

namespace semblante {
namespace {

constexpr std::size_t least_points = 8;
constexpr std::size_t least_pairs = 3;  ///< of points marked on both sides
/// Root mean square distance to the references, in the face's spread; of faces of human proportions at most 0.13.
constexpr double most_misfit = 0.25;
constexpr double most_misfit_of_nod = 0.16;  ///< pitch shows by proportions alone
constexpr double least_tilt = 6.0;           ///< degrees; a smaller one may be the marks' inaccuracy
/// Degrees, of a head that only nods; if it is turned or tilted to a side too, least_tilt is enough.
constexpr double least_nod = 12.0;

/// Points whose place on a head is about the same for everybody: no hair, no tongue, no teeth, no pivot.
bool is_of_the_face(FeaturePointId id) {
  const int group = group_of(id);
  const int number = number_of(id);
  return group != 6 && group != 7 && group != 11 && !(group == 9 && number >= 8 && number <= 11);
}

/// The rotation that takes yaw and roll from a face of any proportions, by the symmetry of its points. Empty if it is
/// less than `least_tilt`.
std::optional<glm::dmat3> straight_by_symmetry(const Places& places) {
  const auto symmetry = symmetry_of_points(places);
  if (!symmetry) return std::nullopt;
  const glm::dmat3 straight = rotation_between(symmetry->plane.normal, {1.0, 0.0, 0.0});
  return degrees_of(straight) >= least_tilt ? std::optional(straight) : std::nullopt;
}

/// Relative to the spread of the face about its middle.
double misfit(const Places& places, const Similarity& fit, std::span<const ReferenceHead> references) {
  const Places mean = mean_of(references);
  double squares = 0.0;
  double spread = 0.0;
  for (std::size_t id = 0; id < feature_point_count; ++id) {
    if (!places[id] || !mean[id]) continue;
    const glm::dvec3 error = fit(*places[id]) - *mean[id];
    squares += glm::dot(error, error);
    const glm::dvec3 arm = *mean[id] - fit.to;
    spread += glm::dot(arm, arm);
  }
  return std::sqrt(squares / spread);
}

}  // namespace

std::optional<glm::dmat3> upright_rotation(Places places, std::span<const ReferenceHead> references) {
  // Points of one side alone show yaw only as far as faces are alike.
  std::size_t count = 0;
  std::size_t pairs = 0;
  for (std::size_t id = 0; id < feature_point_count; ++id) {
    const std::uint8_t mirror = mpeg4::feature_points[id].mirror;
    if (!places[mirror] || !is_of_the_face(FeaturePointId(static_cast<std::uint8_t>(id)))) places[id].reset();
    if (!places[id]) continue;
    ++count;
    if (mirror > id) ++pairs;
  }
  if (count < least_points || pairs < least_pairs) return std::nullopt;
  const auto fit = fit_to_references(places, references);
  if (!fit) return straight_by_symmetry(places);
  const double off = misfit(places, *fit, references);
  if (off > most_misfit) return straight_by_symmetry(places);
  if (degrees_of(fit->rotation) > 90.0) return std::nullopt;
  // fit->rotation = nod * straight, where `straight` is the part without pitch.
  const glm::dvec3 left = glm::transpose(fit->rotation)[0];
  const glm::dmat3 straight = rotation_between(left, {1.0, 0.0, 0.0});
  const glm::dmat3 nod = fit->rotation * glm::transpose(straight);
  const bool is_tilted = degrees_of(straight) >= least_tilt;
  const bool nods = off < most_misfit_of_nod && degrees_of(nod) >= (is_tilted ? least_tilt : least_nod);
  if (!is_tilted && !nods) return std::nullopt;
  return nods ? fit->rotation : straight;
}

}  // namespace semblante
