#include "core/import/gltf_neck_joints.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "core/types/letter_case.h"
#include "core/types/printable.h"

namespace semblante::import {
namespace {

constexpr std::size_t most_joints = 65536;

/// Words of letters in lower case: a capital after a small letter begins one, all else separates them.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  char before = '\0';
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalpha(letter) != 0) {
      const bool begins = std::isalpha(static_cast<unsigned char>(before)) == 0 ||
                          (std::isupper(letter) != 0 && std::islower(static_cast<unsigned char>(before)) != 0);
      if (begins) words.emplace_back();
      words.back() += lower_case(c);
    }
    before = c;
  }
  return words;
}

/// The joint of a node of the scene; empty for others, and where its place is no number.
std::optional<SkinJoint> joint_at(const JsonCursor& root, std::size_t node,
                                  std::span<const std::optional<glm::dmat4>> world) {
  if (node >= world.size() || !world[node]) return std::nullopt;
  const glm::vec3 position((*world[node])[3]);
  if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z)) return std::nullopt;
  return SkinJoint{printable(root.member("nodes").element(node).text_or("name", "")), position};
}

std::optional<std::size_t> node_of_bone(const JsonCursor& humanoid, std::string_view bone, std::size_t nodes) {
  const auto bones = humanoid.optional_member("humanBones");
  if (!bones) return std::nullopt;
  if (!bones->is_array()) {  // VRM 1.0: {"neck": {"node": 4}}
    const auto found = bones->optional_member(bone);
    return found ? found->index("node", nodes) : std::nullopt;
  }
  const std::size_t count = std::min(bones->size(), most_joints);
  for (std::size_t i = 0; i < count && !bones->failed(); ++i) {  // VRM 0.x: [{"bone": "neck", "node": 4}]
    const JsonCursor entry = bones->element(i);
    if (entry.text_or("bone", "") == bone) return entry.index("node", nodes);
  }
  return std::nullopt;
}

std::optional<SkinJoint> humanoid_bone(GltfDocument& document, std::string_view bone,
                                       std::span<const std::optional<glm::dmat4>> world) {
  JsonCursor::Report ignored;
  const JsonCursor root = document.root(ignored);
  const auto extensions = root.optional_member("extensions");
  if (!extensions) return std::nullopt;
  for (const char* const name : {"VRMC_vrm", "VRM"}) {
    const auto extension = extensions->optional_member(name);
    const auto humanoid = extension ? extension->optional_member("humanoid") : std::nullopt;
    if (!humanoid) continue;
    const auto node = node_of_bone(*humanoid, bone, world.size());
    if (node && !root.failed()) return joint_at(root, *node, world);
  }
  return std::nullopt;
}

struct NamedJoints {
  std::vector<SkinJoint> necks, heads;
};

NamedJoints joints_by_name(GltfDocument& document, std::span<const std::optional<glm::dmat4>> world) {
  JsonCursor::Report ignored;
  const JsonCursor root = document.root(ignored);
  NamedJoints found;
  std::size_t left = most_joints;
  for (std::size_t skin = 0; skin < root.size_of("skins") && left > 0 && !root.failed(); ++skin) {
    const JsonCursor joints = root.member("skins").element(skin).member("joints");
    const std::size_t count = std::min(joints.size(), left);
    left -= count;
    for (std::size_t i = 0; i < count && !root.failed(); ++i) {
      const std::uint64_t node = joints.element(i).integer(0, world.empty() ? 0 : world.size() - 1);
      if (root.failed()) break;
      auto joint = joint_at(root, node, world);
      if (!joint || root.failed()) continue;
      const JointKind kind = joint_kind(joint->name);
      if (kind != JointKind::other) (kind == JointKind::neck ? found.necks : found.heads).push_back(*std::move(joint));
    }
  }
  return found;
}

}  // namespace

JointKind joint_kind(std::string_view name) {
  std::vector<std::string> words = words_of(name);
  if (!words.empty() && words.back() == "twist") words.pop_back();
  if (words.empty()) return JointKind::other;
  if (words.back() == "neck") return JointKind::neck;
  return words.back() == "head" ? JointKind::head : JointKind::other;
}

NeckJoints find_neck_joints(GltfDocument& document, std::span<const std::optional<glm::dmat4>> world) {
  NeckJoints result{humanoid_bone(document, "neck", world), humanoid_bone(document, "head", world)};
  if (result.neck || result.head) return result;
  NamedJoints named = joints_by_name(document, world);
  if (!named.heads.empty()) result.head = named.heads.front();
  if (named.necks.empty()) return result;
  const auto from_head = [&](const SkinJoint& joint) {
    return result.head ? glm::distance(joint.position, result.head->position) : 0.0F;
  };
  result.neck = *std::max_element(named.necks.begin(), named.necks.end(),
                                  [&](const SkinJoint& a, const SkinJoint& b) { return from_head(a) < from_head(b); });
  return result;
}

}  // namespace semblante::import
