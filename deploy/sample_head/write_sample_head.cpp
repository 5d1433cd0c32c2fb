#include "deploy/sample_head/write_sample_head.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <sstream>
#include <tiny_gltf.h>

#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include "core/gltf/encode_image.h"

namespace semblante {
namespace {

/// Appends to the only buffer of the file; every view starts at a multiple of four bytes.
class Buffer {
 public:
  explicit Buffer(tinygltf::Model& model) : model_(model) { model_.buffers.emplace_back(); }

  int add_view(const void* data, std::size_t bytes, int target) {
    auto& out = model_.buffers[0].data;
    out.resize((out.size() + 3) / 4 * 4, 0);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = out.size();
    view.byteLength = bytes;
    view.target = target;
    const auto* from = static_cast<const unsigned char*>(data);
    out.insert(out.end(), from, from + bytes);
    model_.bufferViews.push_back(view);
    return static_cast<int>(model_.bufferViews.size()) - 1;
  }

  template <class Vector>
  int add_vectors(const std::vector<Vector>& values, int type, bool with_bounds) {
    static_assert(sizeof(Vector) == sizeof(float) * static_cast<std::size_t>(Vector::length()));
    tinygltf::Accessor accessor;
    accessor.bufferView = add_view(values.data(), values.size() * sizeof(Vector), TINYGLTF_TARGET_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.count = values.size();
    accessor.type = type;
    if (with_bounds) {
      Vector low = values.front();
      Vector high = values.front();
      for (const auto& v : values) {
        low = glm::min(low, v);
        high = glm::max(high, v);
      }
      for (int i = 0; i < Vector::length(); ++i) {
        accessor.minValues.push_back(low[i]);
        accessor.maxValues.push_back(high[i]);
      }
    }
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  int add_joints(const std::vector<std::array<std::uint8_t, 4>>& joints) {
    tinygltf::Accessor accessor;
    accessor.bufferView = add_view(joints.data(), joints.size() * sizeof joints[0], TINYGLTF_TARGET_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    accessor.count = joints.size();
    accessor.type = TINYGLTF_TYPE_VEC4;
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  /// The inverses of matrices that only translate.
  int add_inverse_binds(const std::vector<SampleHeadJoint>& joints) {
    std::vector<float> matrices;
    for (const SampleHeadJoint& joint : joints) {
      const glm::vec3& p = joint.position;
      for (const float value : {1.F, 0.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 0.F, 1.F, 0.F, -p.x, -p.y, -p.z, 1.F})
        matrices.push_back(value);
    }
    tinygltf::Accessor accessor;
    accessor.bufferView = add_view(matrices.data(), matrices.size() * sizeof(float), 0);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.count = joints.size();
    accessor.type = TINYGLTF_TYPE_MAT4;
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  int add_indices(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::vector<std::uint16_t> indices;
    for (const auto& t : triangles) {
      for (const std::uint32_t v : t) indices.push_back(static_cast<std::uint16_t>(v));
    }
    tinygltf::Accessor accessor;
    accessor.bufferView =
        add_view(indices.data(), indices.size() * sizeof(std::uint16_t), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    accessor.count = indices.size();
    accessor.type = TINYGLTF_TYPE_SCALAR;
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

 private:
  tinygltf::Model& model_;
};

bool add_image(tinygltf::Model& model, Buffer& buffer, const SampleHeadImage& image) {
  const std::vector<std::uint8_t> png = encode_png(image.rgb, image.width, image.height, 3);
  if (png.empty()) return false;
  tinygltf::Image out;
  out.name = image.name;
  out.mimeType = "image/png";
  out.bufferView = buffer.add_view(png.data(), png.size(), 0);
  model.images.push_back(out);
  tinygltf::Texture texture;
  texture.source = static_cast<int>(model.images.size()) - 1;
  texture.sampler = 0;
  model.textures.push_back(texture);
  return true;
}

tinygltf::Material material_of(const SampleHeadMaterial& material) {
  tinygltf::Material out;
  out.name = material.name;
  out.doubleSided = material.double_sided;
  auto& pbr = out.pbrMetallicRoughness;
  const auto& c = material.base_color;
  pbr.baseColorFactor = {c.r, c.g, c.b, c.a};
  pbr.metallicFactor = 0.0;
  pbr.roughnessFactor = material.roughness;
  if (material.image) pbr.baseColorTexture.index = static_cast<int>(*material.image);
  return out;
}

/// Adds a node for each joint and the skin of them all. The nodes of the meshes come first.
void add_skin(tinygltf::Model& model, Buffer& buffer, tinygltf::Scene& scene, const SampleHead& head) {
  const auto first = static_cast<int>(model.nodes.size());
  tinygltf::Skin skin;
  skin.inverseBindMatrices = buffer.add_inverse_binds(head.joints);
  for (const SampleHeadJoint& joint : head.joints) {
    tinygltf::Node node;
    node.name = joint.name;
    glm::dvec3 offset(joint.position);
    if (joint.parent >= 0) offset -= glm::dvec3(head.joints[static_cast<std::size_t>(joint.parent)].position);
    node.translation = {offset.x, offset.y, offset.z};
    const auto number = static_cast<int>(model.nodes.size());
    model.nodes.push_back(node);
    skin.joints.push_back(number);
    if (joint.parent < 0)
      scene.nodes.push_back(number);
    else
      model.nodes[static_cast<std::size_t>(first + joint.parent)].children.push_back(number);
  }
  model.skins.push_back(skin);
}

/// Adds the targets of the head to a mesh whose vertices begin at `first`: all of them if any moves a vertex of it.
void add_targets(tinygltf::Mesh& mesh, Buffer& buffer, const SampleHead& head, std::size_t first, std::size_t count) {
  std::vector<std::vector<glm::vec3>> parts;
  bool is_moved = false;
  for (const SampleHeadTarget& target : head.targets) {
    const auto begin = target.displacements.begin() + static_cast<std::ptrdiff_t>(first);
    parts.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(count));
    is_moved = is_moved || std::any_of(parts.back().begin(), parts.back().end(),
                                       [](const glm::vec3& d) { return d != glm::vec3(0.0F); });
  }
  if (!is_moved) return;
  tinygltf::Value::Array names;
  for (std::size_t t = 0; t < parts.size(); ++t) {
    mesh.primitives[0].targets.push_back({{"POSITION", buffer.add_vectors(parts[t], TINYGLTF_TYPE_VEC3, true)}});
    names.emplace_back(head.targets[t].name);
  }
  mesh.weights.assign(parts.size(), 0.0);
  mesh.extras = tinygltf::Value(tinygltf::Value::Object{{"targetNames", tinygltf::Value(names)}});
}

}  // namespace

Result<std::vector<std::uint8_t>> sample_head_glb(const SampleHead& head) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "semblante-sample-head";
  model.asset.copyright = "CC0 1.0: no rights reserved";
  Buffer buffer(model);
  tinygltf::Sampler sampler;
  sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
  sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
  model.samplers.push_back(sampler);
  for (const auto& image : head.images) {
    if (!add_image(model, buffer, image)) return Error{ErrorCode::internal, image.name, "the PNG encoder failed"};
  }
  for (const auto& material : head.materials) model.materials.push_back(material_of(material));

  // A mesh and a node for each part: glTF gives names to these, not to primitives.
  tinygltf::Scene scene;
  std::size_t first = 0;
  for (const auto& part : head.meshes) {
    if (part.positions.size() > 0xFFFF) return Error{ErrorCode::too_large, part.name, "over 65535 vertices in a part"};
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = static_cast<int>(part.material);
    primitive.attributes["POSITION"] = buffer.add_vectors(part.positions, TINYGLTF_TYPE_VEC3, true);
    primitive.attributes["NORMAL"] = buffer.add_vectors(part.normals, TINYGLTF_TYPE_VEC3, false);
    primitive.attributes["TEXCOORD_0"] = buffer.add_vectors(part.uvs, TINYGLTF_TYPE_VEC2, false);
    if (!part.joints.empty()) {
      primitive.attributes["JOINTS_0"] = buffer.add_joints(part.joints);
      primitive.attributes["WEIGHTS_0"] = buffer.add_vectors(part.joint_weights, TINYGLTF_TYPE_VEC4, false);
    }
    primitive.indices = buffer.add_indices(part.triangles);
    tinygltf::Mesh mesh;
    mesh.name = part.name;
    mesh.primitives.push_back(primitive);
    add_targets(mesh, buffer, head, first, part.positions.size());
    first += part.positions.size();
    tinygltf::Node node;
    node.name = part.name;
    node.mesh = static_cast<int>(model.meshes.size());
    if (!part.joints.empty()) node.skin = 0;
    scene.nodes.push_back(static_cast<int>(model.nodes.size()));
    model.meshes.push_back(mesh);
    model.nodes.push_back(node);
  }
  if (!head.joints.empty()) add_skin(model, buffer, scene, head);
  model.scenes.push_back(scene);
  model.defaultScene = 0;

  std::ostringstream stream(std::ios::binary);
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToStream(&model, stream, false, true)) {
    return Error{ErrorCode::internal, "", "the glTF writer failed"};
  }
  const std::string bytes = stream.str();
  return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
}

std::string sample_head_feature_points_json(const SampleHead& head) {
  nlohmann::ordered_json json;
  json["head"] = head.name;
  json["model"] = head.name + ".glb";
  json["vertex_index_base"] = 0;
  json["to_mpeg4_axes"] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  json["unit"] = "metre";
  json["orientation"] = "already MPEG-4: +X to the face's own left, +Y up, +Z out of the face";
  json["symmetric"] = head.is_symmetric;
  json["count"] = head.points.size();
  auto& points = json["points"];
  for (const auto& point : head.points) {
    nlohmann::ordered_json one;
    if (point.vertex) {
      one["vertex"] = *point.vertex;
    } else {
      one["vertex"] = nullptr;
    }
    one["position"] = {point.position.x, point.position.y, point.position.z};
    one["placed"] = "by construction";
    one["confidence"] = "high";
    points[to_string(point.id)] = one;
  }
  return json.dump(1) + "\n";
}

}  // namespace semblante
