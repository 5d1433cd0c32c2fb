#include "core/anatomy/plausible_joints.h"

#include <cmath>
#include <optional>

#include "core/anatomy/head_landmarks.h"
#include "core/anatomy/neck_shape.h"

namespace semblante {
namespace {

// In heights of the eyes above the chin.
constexpr double joint_aside = 0.4;            ///< of a joint from the middle
constexpr double joint_behind_chin = 0.2;      ///< at least
constexpr double joint_far_behind_chin = 2.5;  ///< at most
constexpr double head_joint_below_chin = 0.5;  ///< the head's joint is at most this far below the chin

}  // namespace

NeckJoints plausible_joints(const NeckJoints& joints, std::span<const Part> parts, const FeaturePointSet& points) {
  const std::optional<double> eyes = eye_height(points, parts);
  const std::optional<glm::dvec3> chin = eyes ? chin_place(points, *eyes) : std::nullopt;
  if (!chin || !(*eyes > chin->y)) return {};
  const double height = *eyes - chin->y;
  const auto is_within = [&](const std::optional<SkinJoint>& joint, double low, double high) {
    if (!joint) return false;
    const glm::dvec3 from_chin = (glm::dvec3(joint->position) - *chin) / height;
    return std::abs(from_chin.x) <= joint_aside && from_chin.z <= -joint_behind_chin &&
           from_chin.z >= -joint_far_behind_chin && from_chin.y >= low && from_chin.y <= high;
  };
  NeckJoints result;
  if (is_within(joints.head, -head_joint_below_chin, 1.0)) result.head = joints.head;
  const bool is_below_head = !joints.head || (joints.neck && joints.neck->position.y < joints.head->position.y);
  if (is_below_head && is_within(joints.neck, -shoulders_within, 0.0)) result.neck = joints.neck;
  return result;
}

}  // namespace semblante
