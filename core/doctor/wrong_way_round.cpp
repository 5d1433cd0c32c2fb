#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <glm/geometric.hpp>

#include "core/anatomy/point_lookup.h"
#include "core/doctor/point_checks.h"
#include "core/doctor/words.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

/// FAPs move points along the axes of the model: at 30 degrees half of every movement is along a wrong axis.
constexpr double most_tilt = 30.0;
/// Marks of an upright, asymmetric face differ from its axes by 2 degrees; at 8 a seventh of a movement goes astray.
constexpr double most_turn = 8.0;

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

std::vector<FeaturePointId> ids_of(const FeaturePointSet& points) {
  std::vector<FeaturePointId> ids;
  for (const FeaturePoint& point : points) ids.push_back(point.id);
  return ids;
}

std::optional<Finding> wrong_axes(const Subject& head) {
  const FaceAxes& face = head.frame;
  const double of_up = degrees_between(face.up, {0, 1, 0});
  const double of_forward = degrees_between(face.forward, {0, 0, 1});
  const double tilt = std::max(of_up, of_forward);
  if (tilt <= most_tilt) return std::nullopt;
  Finding finding;
  finding.severity = Severity::error;
  finding.place.points = ids_of(head.rig.points);
  finding.measured = {"degrees between the face's axes and the model's", tilt, most_tilt};
  const std::string angle = std::to_string(std::lround(tilt)) + " degrees";
  if (of_up > 180.0 - most_tilt) {
    finding.code = FindingCode::upside_down;
    finding.words =
        "the face is upside down: its brows are below its mouth, so every movement is in the wrong direction";
    finding.remedy = "rotate the model so that +Y is up, or set its axes";
  } else if (of_up <= most_tilt && of_forward > 180.0 - most_tilt) {
    finding.code = FindingCode::facing_away;
    finding.words =
        "the face looks along -Z, away from the front, so left and right, and forward and backward, are exchanged";
    finding.remedy = "rotate the model by half a turn about the vertical axis, so that it looks along +Z";
  } else {
    finding.code = FindingCode::not_upright;
    finding.words = "the face is rotated by " + angle + " from the model's axes, so movements are in wrong directions";
    finding.remedy = "rotate the model so that +Y is up and the face looks along +Z, or set its axes";
  }
  return finding;
}

/// Of a face within most_tilt. Pitch is not told: the profiles of upright faces differ by as much.
std::optional<Finding> turned_aside(const Subject& head) {
  if (!head.frame.symmetry) return std::nullopt;
  const glm::dvec3 left = head.frame.symmetry->plane.normal;
  const double tilt = degrees_between(left, {1, 0, 0});
  if (tilt <= most_turn) return std::nullopt;
  const auto degrees = [](double radians) { return radians * 180.0 / std::numbers::pi; };
  const double yaw = degrees(std::atan2(-left.z, left.x));
  const double roll = degrees(std::asin(std::clamp(left.y, -1.0, 1.0)));
  const auto about = [](double angle) { return std::to_string(std::lround(std::abs(angle))) + " degrees"; };
  constexpr double least_told = 2.0;
  std::string how;
  if (std::abs(yaw) >= least_told) how = "turned by " + about(yaw) + (yaw > 0.0 ? " to its left" : " to its right");
  if (std::abs(roll) >= least_told)
    how += (how.empty() ? "" : " and ") + std::string("tilted by ") + about(roll) +
           (roll > 0.0 ? " towards its right shoulder" : " towards its left shoulder");
  Finding finding;
  finding.code = FindingCode::not_upright;
  finding.severity = Severity::warning;
  finding.place.points = ids_of(head.rig.points);
  finding.words = "the face is " + how + ", by its points, so movements to a side and forward are in wrong directions";
  finding.remedy =
      "rotate the model so that the face looks along +Z; if its axes were set by hand, take them back: then it is "
      "turned by its points";
  finding.measured = {"degrees between the face's plane of symmetry and the model's", tilt, most_turn};
  return finding;
}

std::optional<Finding> exchanged_sides(const Subject& head) {
  const std::vector<FeaturePointId>& swapped = head.frame.swapped;
  if (swapped.empty()) return std::nullopt;
  Finding finding;
  finding.code = FindingCode::left_right_swapped;
  finding.severity = Severity::error;
  std::string pairs;
  std::size_t told = 0;
  for (const FeaturePointId left : swapped) {
    const FeaturePointId right(mpeg4::feature_points[left.value()].mirror);
    finding.place.points.push_back(left);
    finding.place.points.push_back(right);
    if (++told <= 6) pairs += (pairs.empty() ? "" : ", ") + to_string(left) + " with " + to_string(right);
  }
  if (told > 6) pairs += " and " + count_of(told - 6, "more pair", "more pairs");
  if (const FeaturePoint* const first = find_point(head.rig.points, to_string(swapped.front())))
    finding.place.position = glm::dvec3(first->position);
  finding.words = "left and right are exchanged: " + pairs +
                  "; left and right are the face's own, not the viewer's, so these points move the wrong side";
  finding.remedy = "exchange the points of each pair; if all of them are, the model itself may be mirrored";
  return finding;
}

}  // namespace

std::vector<Finding> find_wrong_way_round(const Subject& head) {
  std::vector<Finding> findings;
  if (auto finding = wrong_axes(head)) {
    findings.push_back(std::move(*finding));
  } else if (auto turned = turned_aside(head)) {
    findings.push_back(std::move(*turned));
  }
  if (auto finding = exchanged_sides(head)) findings.push_back(std::move(*finding));
  return findings;
}

}  // namespace semblante
