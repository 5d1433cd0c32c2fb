#include "core/anatomy/head_landmarks.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/anatomy/point_lookup.h"

namespace semblante {
namespace {

// Lengths in units of the height from the chin to the eyes. Human proportions.
constexpr double nape_below_eyes = 0.6;   ///< the head ends there at the back
constexpr double above_line = 0.01;       ///< how far below the line of the jaw the head still reaches
constexpr double chin_below_mouth = 0.6;  ///< in heights of the eyes above the mouth, without a point of the chin

constexpr std::array<std::string_view, 2> pupil_point_names = {"3.5", "3.6"};
constexpr std::array<std::string_view, 8> lid_point_names = {"3.1", "3.2", "3.3", "3.4", "3.7", "3.8", "3.11", "3.12"};

}  // namespace

std::optional<double> eye_height(const FeaturePointSet& points, std::span<const Part> parts) {
  for (const auto& names :
       {std::span<const std::string_view>(pupil_point_names), std::span<const std::string_view>(lid_point_names)}) {
    double sum = 0.0;
    int count = 0;
    for (const std::string_view name : names) {
      if (const FeaturePoint* const point = find_point(points, name)) sum += point->position.y, ++count;
    }
    if (count > 0) return sum / count;
  }
  for (const Part& part : parts) {
    if (part.role == PartRole::left_eye || part.role == PartRole::right_eye)
      return 0.5 * (static_cast<double>(part.box_min.y) + part.box_max.y);
  }
  return std::nullopt;
}

std::optional<glm::dvec3> chin_place(const FeaturePointSet& points, double eyes) {
  for (const std::string_view name : {"2.1", "2.10"}) {
    if (const FeaturePoint* const point = find_point(points, name)) return glm::dvec3(point->position);
  }
  for (const std::string_view name : {"8.2", "2.3", "2.2"}) {
    const FeaturePoint* const lip = find_point(points, name);
    if (lip == nullptr) continue;
    return glm::dvec3(lip->position) - glm::dvec3(0.0, chin_below_mouth * (eyes - lip->position.y), 0.0);
  }
  return std::nullopt;
}

std::optional<HeadLandmarks> find_head_landmarks(const FeaturePointSet& points, std::span<const Part> parts,
                                                 const glm::vec3& head_pivot) {
  const std::optional<double> eyes = eye_height(points, parts);
  if (!eyes) return std::nullopt;
  const std::optional<glm::dvec3> chin = chin_place(points, *eyes);
  if (!chin) return std::nullopt;
  HeadLandmarks marks;
  marks.chin = *chin;
  marks.height = *eyes - marks.chin.y;
  if (!(marks.height > 0.0)) return std::nullopt;
  marks.nape = {head_pivot.x, *eyes - nape_below_eyes * marks.height,
                std::min<double>(head_pivot.z, marks.chin.z - 0.5 * marks.height)};
  return marks;
}

double jaw_line(const HeadLandmarks& marks, double z) {
  const double t = (z - marks.chin.z) / (marks.nape.z - marks.chin.z);
  return marks.chin.y + std::clamp(t, 0.0, 1.0) * (marks.nape.y - marks.chin.y);
}

bool above_jaw(const HeadLandmarks& marks, const glm::dvec3& p) {
  return p.y >= jaw_line(marks, p.z) - above_line * marks.height;
}

}  // namespace semblante
