#include "core/propose/rim_choice.h"

#include <glm/geometric.hpp>

namespace semblante {

std::string sides_in_words(const mpeg4::Opening& opening) {
  return "the " + std::string(opening.upper_name) + " from the " + std::string(opening.lower_name);
}

std::string undistinguished(const mpeg4::Opening& opening) {
  return "the surface connects both directly here and does not distinguish " + sides_in_words(opening);
}

std::optional<RimVertex> RimChoice::nearest(const RimOfPoint& rim, PartRole role, const glm::dvec3& place, double error,
                                            const MirrorPlane* on, const FaceSurface::Filter& is_free) {
  const RimSides& sides = sides_of(*rim.opening);
  const auto side = [&](std::uint32_t v) { return sides.side(SurfaceVertexId(v), rim.is_upper); };
  const auto nearest_with = [&](const auto& has_side) {
    return face_.nearest(role, place, on,
                         [&](std::uint32_t v) { return (!is_free || is_free(v)) && has_side(side(v)); });
  };
  const auto off = [&](std::uint32_t v) { return glm::distance(face_.at(v), place); };
  const std::string both = sides_in_words(*rim.opening);

  const auto own = nearest_with([](double s) { return s > 0.0; });
  const auto other = nearest_with([](double s) { return s < 0.0; });
  const auto apart = nearest_with([](double s) { return s == 0.0; });
  // A separate piece of unknown side, such as a lid behind the fold, is treated like the nearest vertex.
  if (apart && (!own || off(*apart) < off(*own)) && (!other || own || off(*apart) < off(*other)))
    return RimVertex{*apart, sides.have_anchors() ? "no placed point on this piece distinguishes " + both
                                                  : "too few points are placed to distinguish " + both};
  if (!own) {
    if (!other) return std::nullopt;
    return RimVertex{*other, "the surface has no vertex on the side of this point that distinguishes " + both};
  }
  if (side(*own) >= RimSides::clear) return RimVertex{*own, {}};
  // If the other side is about as near, prefer a slightly farther vertex whose side is certain.
  const bool is_contested = other && off(*other) < off(*own) + error;
  const auto clear = nearest_with([](double s) { return s >= RimSides::clear; });
  if (is_contested && clear && off(*clear) < off(*own) + error) return RimVertex{*clear, {}};
  return RimVertex{*own, undistinguished(*rim.opening)};
}

bool RimChoice::is_surely_beyond(const RimOfPoint& rim, std::uint32_t vertex) {
  return sides_of(*rim.opening).side(SurfaceVertexId(vertex), rim.is_upper) <= -RimSides::clear;
}

const RimSides& RimChoice::sides_of(const mpeg4::Opening& opening) {
  auto& sides = sides_[static_cast<std::size_t>(&opening - mpeg4::openings.data())];
  if (!sides) sides = std::make_unique<RimSides>(face_.surface(), opening, anchors_);
  return *sides;
}

}  // namespace semblante
