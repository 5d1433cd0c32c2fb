#include "core/import/gltf_scene.h"

#include <algorithm>
#include <map>
#include <memory>

#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "core/import/gltf_skin.h"

namespace semblante::import {
namespace {

/// The numbers of an array that must have exactly `size` elements.
template <std::size_t size>
std::array<double, size> numbers(const JsonCursor& array) {
  std::array<double, size> values{};
  if (array.size() != size) {
    array.fail(ErrorCode::malformed, "must have " + std::to_string(size) + " numbers");
    return values;
  }
  for (std::size_t i = 0; i < size; ++i) values[i] = array.element(i).number();
  return values;
}

glm::dmat4 local_transform(const JsonCursor& node) {
  glm::dmat4 transform(1.0);
  if (node.has("matrix")) {
    const auto m = numbers<16>(node.member("matrix"));
    std::copy(m.begin(), m.end(), glm::value_ptr(transform));  // both by columns
    return transform;
  }
  if (node.has("translation")) {
    const auto t = numbers<3>(node.member("translation"));
    transform = glm::translate(transform, glm::dvec3(t[0], t[1], t[2]));
  }
  if (node.has("rotation")) {
    const auto r = numbers<4>(node.member("rotation"));
    const glm::dquat rotation(r[3], r[0], r[1], r[2]);
    const double length = glm::length(rotation);
    if (length < 1e-6)
      node.member("rotation").fail(ErrorCode::invalid_argument, "must be a quaternion other than zero");
    if (length > 0.0) transform *= glm::mat4_cast(rotation / length);
  }
  if (node.has("scale")) {
    const auto s = numbers<3>(node.member("scale"));
    transform = glm::scale(transform, glm::dvec3(s[0], s[1], s[2]));
  }
  return transform;
}

/// Nodes that are no child of another node, for a file without a scene.
std::vector<std::size_t> root_nodes(GltfDocument& document, std::size_t node_count) {
  std::vector<bool> is_child(node_count, false);
  for (std::size_t i = 0; i < node_count; ++i) {
    const JsonCursor node = document.item("nodes", i);
    for (std::size_t c = 0; c < node.size_of("children"); ++c) {
      const std::uint64_t child = node.member("children").element(c).integer(0, node_count - 1);
      if (!document.failed()) is_child[child] = true;
    }
  }
  std::vector<std::size_t> roots;
  for (std::size_t i = 0; i < node_count; ++i) {
    if (!is_child[i]) roots.push_back(i);
  }
  return roots;
}

std::vector<std::size_t> scene_nodes(GltfDocument& document, std::size_t node_count) {
  const std::size_t scene_count = document.count("scenes");
  if (scene_count == 0) return root_nodes(document, node_count);
  const JsonCursor scene = document.item("scenes", document.root().index("scene", scene_count).value_or(0));
  scene.must_be_object();
  std::vector<std::size_t> nodes;
  for (std::size_t i = 0; i < scene.size_of("nodes"); ++i) {
    nodes.push_back(scene.member("nodes").element(i).integer(0, node_count - 1));
  }
  return nodes;
}

/// The effect of a skin on its meshes.
struct SkinPose {
  std::optional<glm::dmat4> common;                       ///< one matrix for all vertices
  std::shared_ptr<const std::vector<glm::dmat4>> joints;  ///< otherwise one per joint
};

SkinPose pose_of(GltfDocument& document, std::size_t skin, std::span<const std::optional<glm::dmat4>> world) {
  std::vector<glm::dmat4> joints = joint_matrices(document, skin, world);
  if (joints.empty()) return {};  // a skin without joints in the scene: uses the node's own transform
  if (const auto common = common_matrix(joints)) return {common, nullptr};
  return {std::nullopt, std::make_shared<const std::vector<glm::dmat4>>(std::move(joints))};
}

void apply(const SkinPose& pose, MeshPlacement& placement) {
  if (pose.common) {
    placement.to_world = *pose.common;
    placement.is_identity = *pose.common == glm::dmat4(1.0);
  } else if (pose.joints) {
    placement.joints = pose.joints;
    placement.is_identity = false;
  }
}

/// A skin places its mesh, wherever the node is: two nodes with one skin are one place.
bool is_same_place(const MeshPlacement& a, const MeshPlacement& b) {
  return a.skin == b.skin && (a.skin || nearly_equal(a.to_world, b.to_world));
}

void add(MeshPlacement placement, MeshPlacements& placements) {
  for (const MeshPlacement& other : placements.kept) {
    if (is_same_place(placement, other)) return;
  }
  ++placements.count;
  if (placements.kept.size() < MeshPlacements::most) placements.kept.push_back(std::move(placement));
}

}  // namespace

GltfScene read_scene(GltfDocument& document) {
  const std::size_t mesh_count = document.count("meshes");
  const std::size_t node_count = document.count("nodes");
  if (node_count == 0) return {std::vector<MeshPlacements>(mesh_count, {{MeshPlacement{}}, 1}), {}};

  std::vector<MeshPlacements> meshes(mesh_count);
  struct Visit {
    std::size_t node;
    glm::dmat4 parent;
  };
  std::vector<Visit> pending;
  const std::vector<std::size_t> roots = scene_nodes(document, node_count);
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) pending.push_back({*root, glm::dmat4(1.0)});
  std::vector<std::optional<glm::dmat4>> world(node_count);
  while (!pending.empty() && !document.failed()) {
    const auto [index, parent] = pending.back();
    pending.pop_back();
    const JsonCursor node = document.item("nodes", index);
    node.must_be_object();
    if (world[index]) {
      node.fail(ErrorCode::malformed, "is in the scene twice, but nodes must form trees");
      break;
    }
    const glm::dmat4 to_world = parent * local_transform(node);
    world[index] = to_world;
    if (const auto mesh = node.index("mesh", mesh_count); mesh && !document.failed()) {
      add({to_world, to_world == glm::dmat4(1.0), node.index("skin", document.count("skins")), {}}, meshes[*mesh]);
    }
    for (std::size_t c = node.size_of("children"); c-- > 0;) {
      pending.push_back({node.member("children").element(c).integer(0, node_count - 1), to_world});
    }
  }
  std::map<std::size_t, SkinPose> poses;  // each computed once, for all meshes with the skin
  for (MeshPlacements& mesh : meshes) {
    for (MeshPlacement& placement : mesh.kept) {
      if (!placement.skin || document.failed()) continue;
      const auto [pose, is_new] = poses.try_emplace(*placement.skin);
      if (is_new) pose->second = pose_of(document, *placement.skin, world);
      apply(pose->second, placement);
    }
  }
  return {std::move(meshes), std::move(world)};
}

}  // namespace semblante::import
