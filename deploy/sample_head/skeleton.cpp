#include "deploy/sample_head/skeleton.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "deploy/sample_head/half_mesh.h"

namespace semblante::sample_head_detail {
namespace {

/// A joint at `position` (cm) and the bone from there to `end`, the part of the body that turns about it. Joints of
/// the left side have a partner on the right.
struct Bone {
  std::string_view name, parent;
  Vec3 position, end;
};
constexpr Bone bones[] = {
    {"Hips", "", {0, -66, -4}, {0, -58, -4}},
    {"Spine", "Hips", {0, -58, -4}, {0, -45, -4}},
    {"Spine1", "Spine", {0, -45, -4}, {0, -33, -4}},
    {"Spine2", "Spine1", {0, -33, -4}, {0, -20, -4}},
    {"Neck", "Spine2", {0, -17.5, -4}, {0, -11, -3}},
    {"Head", "Neck", {0, -9, -2.5}, {0, 11, -1}},
    {"LeftEye", "Head", {3.2, 0, 6.62}, {3.2, 0, 8}},
    {"LeftShoulder", "Spine2", {3, -20, -4}, {12, -21, -4.2}},
    {"LeftArm", "LeftShoulder", {14, -23, -4.2}, {20.8, -46, -4.8}},
    {"LeftForeArm", "LeftArm", {20.8, -46, -4.8}, {24.7, -68, -3.4}},
    {"LeftHand", "LeftForeArm", {24.7, -68, -3.4}, {26.3, -78, -2.4}},
    {"LeftUpLeg", "Hips", {8, -72, -4}, {9.2, -112, -3.9}},
    {"LeftLeg", "LeftUpLeg", {9.2, -112, -3.9}, {9.7, -151, -5.2}},
    {"LeftFoot", "LeftLeg", {9.7, -151, -5.2}, {10.4, -156, 9}},
};

struct Segment {
  Vec3 from, to;
};

double distance_to(const Segment& bone, const Vec3& p) {
  const Vec3 along = bone.to - bone.from;
  const double share = glm::clamp(glm::dot(p - bone.from, along) / glm::dot(along, along), 0.0, 1.0);
  return glm::distance(p, bone.from + along * share);
}

int joint_named(const SampleHead& body, std::string_view name) {
  const auto found = std::find_if(body.joints.begin(), body.joints.end(),
                                  [&](const SampleHeadJoint& joint) { return joint.name == name; });
  return found == body.joints.end() ? -1 : static_cast<int>(found - body.joints.begin());
}

std::string on_the_right(std::string_view name) {
  return name.starts_with("Left") ? "Right" + std::string(name.substr(4)) : std::string(name);
}

struct Binding {
  std::array<std::uint8_t, 4> joints{};
  glm::vec4 weights{1.0F, 0.0F, 0.0F, 0.0F};
};

/// To the two nearest bones; where one is clearly nearer, to it alone.
Binding bound_to_nearest(const Vec3& p, std::span<const Segment> segments) {
  std::array<std::pair<double, std::size_t>, 2> nearest;
  nearest.fill({std::numeric_limits<double>::infinity(), 0});
  for (std::size_t joint = 0; joint < segments.size(); ++joint) {
    const std::pair candidate(distance_to(segments[joint], p), joint);
    if (candidate < nearest[0])
      nearest = {candidate, nearest[0]};
    else if (candidate < nearest[1])
      nearest[1] = candidate;
  }
  constexpr double blend = 4.0;  // cm
  const double second = 0.5 * glm::clamp(1.0 - (nearest[1].first - nearest[0].first) / blend, 0.0, 1.0);
  return {{static_cast<std::uint8_t>(nearest[0].second), static_cast<std::uint8_t>(nearest[1].second)},
          {static_cast<float>(1.0 - second), static_cast<float>(second), 0.0F, 0.0F}};
}

}  // namespace

void add_skeleton(SampleHead& body) {
  std::vector<Segment> segments;
  const auto add = [&](std::string name, const std::string& parent, Vec3 from, Vec3 to) {
    body.joints.push_back({std::move(name), joint_named(body, parent), glm::vec3(from * 0.01)});
    segments.push_back({from, to});
  };
  for (const Bone& bone : bones) {
    add(std::string(bone.name), std::string(bone.parent), bone.position, bone.end);
    const Vec3 mirror(-1.0, 1.0, 1.0);
    if (bone.name.starts_with("Left"))
      add(on_the_right(bone.name), on_the_right(bone.parent), bone.position * mirror, bone.end * mirror);
  }
  const auto head = static_cast<std::uint8_t>(joint_named(body, "Head"));
  const auto neck = static_cast<std::uint8_t>(joint_named(body, "Neck"));
  const auto chest = static_cast<std::uint8_t>(joint_named(body, "Spine2"));
  for (SampleHeadMesh& mesh : body.meshes) {
    const bool below = mesh.name == "shirt" || mesh.name == "torso" || mesh.name == "sleeves" || mesh.name == "hands" ||
                       mesh.name == "hips" || mesh.name == "legs" || mesh.name == "shoes";
    for (const glm::vec3& position : mesh.positions) {
      const Vec3 p = Vec3(position) * 100.0;
      Binding binding;
      binding.joints[0] = head;
      if (below) {
        binding = bound_to_nearest(p, segments);
      } else if (mesh.name == "skin") {
        const auto of_head = static_cast<float>(glm::smoothstep(-14.0, -8.0, p.y));
        const auto of_chest = static_cast<float>(1.0 - glm::smoothstep(-18.0, -14.0, p.y));
        binding = {{head, neck, chest}, {of_head, 1.0F - of_head - of_chest, of_chest, 0.0F}};
      } else if (mesh.name == "left eye") {
        binding.joints[0] = static_cast<std::uint8_t>(joint_named(body, "LeftEye"));
      } else if (mesh.name == "right eye") {
        binding.joints[0] = static_cast<std::uint8_t>(joint_named(body, "RightEye"));
      }
      mesh.joints.push_back(binding.joints);
      mesh.joint_weights.push_back(binding.weights);
    }
  }
}

}  // namespace semblante::sample_head_detail
