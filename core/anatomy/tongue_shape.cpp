#include "core/anatomy/tongue_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>

#include <glm/geometric.hpp>

#include "core/anatomy/jaw_share.h"
#include "core/anatomy/smooth_step.h"

namespace semblante {
namespace {

/// Minimum share of vertices that count as tongue when its extent is measured.
constexpr double mostly = 0.5;

/// Distance from the border points to the rear if none are marked, as a fraction of the length.
constexpr double rear_part = 0.35;

/// Borders rotated by half a turn meet; a tongue of typical thickness touches itself a little before.
constexpr double greatest_roll = 2.6;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// The direction in which the tongue is longest, in the face's middle plane and out of the mouth.
glm::dvec3 length_axis(const Surface& surface, const std::vector<double>& share, const glm::dvec3& middle) {
  double yy = 0.0;
  double yz = 0.0;
  double zz = 0.0;
  for (std::size_t s = 0; s < share.size(); ++s) {
    const glm::dvec3 d = surface.positions[s] - middle;
    yy += share[s] * d.y * d.y;
    yz += share[s] * d.y * d.z;
    zz += share[s] * d.z * d.z;
  }
  const double angle = 0.5 * std::atan2(2.0 * yz, zz - yy);  // of the longer principal axis, from z towards y
  return {0.0, std::sin(angle), std::cos(angle)};
}

}  // namespace

std::optional<TongueOfHead> find_tongue(const Surface& surface, std::span<const Part> parts,
                                        std::span<const SurfacePoint> points, std::span<const MouthShare> mouth) {
  TongueOfHead tongue;
  tongue.share.resize(surface.vertex_count());
  double total = 0.0;
  glm::dvec3 middle(0.0);
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    if (parts[p].role != PartRole::tongue) continue;
    for (const SurfaceVertexId v : surface.members_of(PartId(p))) {
      const double share = mouth[v.value()].tongue;
      tongue.share[v.value()] = share;
      middle += share * surface.positions[v.value()];
      total += share;
    }
  }
  if (!(total > 0.0)) return std::nullopt;
  middle /= total;
  // Both border points determine the middle line better than the mean of the vertices.
  const auto border = [&](std::string_view name) -> const SurfacePoint* {
    const auto found = std::find_if(points.begin(), points.end(), [&](const SurfacePoint& point) {
      return to_string(point.id) == name && tongue.share[point.vertex.value()] > 0.0;
    });
    return found == points.end() ? nullptr : &*found;
  };
  const SurfacePoint* const left_border = border("6.3");
  const SurfacePoint* const right_border = border("6.4");
  if (left_border != nullptr && right_border != nullptr) {
    middle.x = 0.5 * (left_border->position.x + right_border->position.x);
  }

  const glm::dvec3 left(1.0, 0.0, 0.0);
  const glm::dvec3 along = length_axis(surface, tongue.share, middle);
  const glm::dvec3 up = glm::cross(along, left);
  Range width;
  Range length;
  for (std::size_t s = 0; s < tongue.share.size(); ++s) {
    if (tongue.share[s] < mostly) continue;
    width.add(std::abs(glm::dot(surface.positions[s] - middle, left)));
    length.add(glm::dot(surface.positions[s] - middle, along));
  }
  double border_place = length.low + rear_part * (length.high - length.low);
  std::vector<double> borders;
  for (const SurfacePoint* const point : {left_border, right_border}) {
    if (point == nullptr) continue;
    const glm::dvec3 d = point->position - middle;
    borders.push_back(std::abs(glm::dot(d, left)));
    border_place = borders.size() == 1 ? glm::dot(d, along) : std::min(border_place, glm::dot(d, along));
  }
  const double half_width =
      borders.empty() ? width.high
                      : std::accumulate(borders.begin(), borders.end(), 0.0) / static_cast<double>(borders.size());
  if (!(half_width > 0.0) || !(border_place > length.low)) return std::nullopt;

  double thickest = 0.0;
  for (std::size_t s = 0; s < tongue.share.size(); ++s) {
    if (tongue.share[s] == 0.0) continue;
    const glm::dvec3 d = surface.positions[s] - middle;
    tongue.share[s] *= smooth_step(length.low, border_place, glm::dot(d, along));
    thickest = std::max(thickest, tongue.share[s] * std::abs(glm::dot(d, up)));
  }
  tongue.shape.origin = glm::vec3(middle);
  tongue.shape.left = glm::vec3(left);
  tongue.shape.up = glm::vec3(up);
  tongue.shape.half_width = static_cast<float>(half_width);
  // Vertices above the sheet move on a smaller arc, whose radius must stay positive.
  const double room = thickest > 0.0 ? 0.85 * half_width / thickest : greatest_roll;
  tongue.shape.roll_limit = static_cast<float>(std::min(greatest_roll, room));
  return tongue;
}

}  // namespace semblante
