#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/doctor/part_checks.h"
#include "core/doctor/words.h"

namespace semblante {
namespace {

/// Six metres on an adult: no body, hair or clothes reach so far.
constexpr double farthest = 100.0;
/// A step of coordinates as a fraction of ES0: a quarter of a millimetre on an adult, which is seen on a large screen,
/// and 2 mm, of which the order of lip and lid points falls victim.
constexpr double coarse_step = 0.004, ruinous_step = 0.03;

/// The distance between neighbouring numbers of float32 at the largest coordinate of the points.
double step_at(const Subject& head) {
  float largest = 0.0F;
  for (const FeaturePoint& point : head.rig.points)
    for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(static_cast<float>(point.position[c])));
  return static_cast<double>(std::nextafter(largest, std::numeric_limits<float>::infinity())) - largest;
}

}  // namespace

std::vector<Finding> find_far_reach(const Subject& head) {
  std::vector<Finding> findings;
  const auto& unit = head.frame.eye_separation;
  if (!unit || head.rig.points.empty()) return findings;
  glm::dvec3 middle(0.0);
  for (const FeaturePoint& point : head.rig.points) middle += glm::dvec3(point.position);
  middle /= static_cast<double>(head.rig.points.size());

  if (const double step = step_at(head) / *unit; step > coarse_step) {
    Finding finding;
    finding.code = FindingCode::coarse_coordinates;
    finding.severity = step > ruinous_step ? Severity::error : Severity::warning;
    finding.words = "the head is so far from the origin of its file that its coordinates have steps of " +
                    percent(step) + " of the eye distance; the face is drawn in steps, and near points coincide";
    finding.remedy = "move the head to the origin in the program that made the model, and export it again";
    finding.place.position = middle;
    finding.measured = {"step of the coordinates as a fraction of ES0", step, coarse_step};
    findings.push_back(std::move(finding));
  }

  VertexSample far;
  double distance = 0.0;
  for (std::size_t v = 0; v < head.surface.positions.size(); ++v) {
    const double here = glm::distance(head.surface.positions[v], middle) / *unit;
    if (!(here > farthest)) continue;
    far.add(head.surface.file_vertex_of[v]);
    distance = std::max(distance, here);
  }
  if (far.count > 0) {
    Finding finding;
    finding.code = FindingCode::far_vertices;
    finding.severity = Severity::warning;
    finding.words = count_of(far.count, "vertex is", "vertices are") + " far from the face, at most " +
                    std::to_string(std::llround(std::min(distance, 1e15))) +
                    " times the eye distance, left behind or no part of the head; every client gets them too";
    finding.remedy = "delete what does not belong to the head in the program that made the model";
    finding.place = place_of(head.model, head.surface, std::move(far));
    finding.measured = {"distance from the face as a multiple of ES0", distance, farthest};
    findings.push_back(std::move(finding));
  }
  return findings;
}

}  // namespace semblante
