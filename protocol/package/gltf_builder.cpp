#include "protocol/package/gltf_builder.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <sstream>
#include <tiny_gltf.h>

#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>

#include "core/draco/draco_mesh.h"

namespace semblante {
namespace {

tinygltf::Value to_value(const nlohmann::json& json) {
  switch (json.type()) {
    case nlohmann::json::value_t::object: {
      tinygltf::Value::Object object;
      for (const auto& [key, member] : json.items()) object.emplace(key, to_value(member));
      return tinygltf::Value(std::move(object));
    }
    case nlohmann::json::value_t::array: {
      tinygltf::Value::Array array;
      for (const nlohmann::json& member : json) array.push_back(to_value(member));
      return tinygltf::Value(std::move(array));
    }
    case nlohmann::json::value_t::string:
      return tinygltf::Value(json.get<std::string>());
    case nlohmann::json::value_t::boolean:
      return tinygltf::Value(json.get<bool>());
    case nlohmann::json::value_t::number_integer:
    case nlohmann::json::value_t::number_unsigned:
      return tinygltf::Value(json.get<int>());
    case nlohmann::json::value_t::number_float:
      return tinygltf::Value(json.get<double>());
    default:
      return {};
  }
}

int component_type(DracoAttribute::Type type) {
  switch (type) {
    case DracoAttribute::Type::uint8:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    case DracoAttribute::Type::uint16:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    case DracoAttribute::Type::uint32:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    case DracoAttribute::Type::float32:
      break;
  }
  return TINYGLTF_COMPONENT_TYPE_FLOAT;
}

int vector_type(int components) {
  constexpr std::array types = {TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4};
  return types[static_cast<std::size_t>(components) - 1];
}

}  // namespace

class GltfBuilder::Content {
 public:
  Content(const std::vector<Material>& materials, const std::vector<Image>& images) {
    gltf_.asset.version = "2.0";
    gltf_.asset.generator = "Semblante";
    gltf_.buffers.emplace_back();
    for (const Image& image : images) add_image(image);
    for (const Material& material : materials) add_material(material);
    gltf_.meshes.emplace_back();
    gltf_.meshes[0].name = "face";
    gltf_.nodes.emplace_back();
    gltf_.nodes[0].mesh = 0;
    gltf_.nodes[0].name = "face";
    gltf_.scenes.emplace_back();
    gltf_.scenes[0].nodes = {0};
    gltf_.defaultScene = 0;
  }

  Status add_draco_primitive(const Slice& slice, std::span<const SliceAttribute> attributes) {
    std::vector<DracoAttribute> inputs;
    inputs.reserve(attributes.size());
    for (const SliceAttribute& a : attributes) {
      inputs.push_back({a.kind, a.type, a.components, a.bytes, {}, a.quantization_bits});
    }
    auto bytes = encode_draco(slice.vertices.size(), slice.triangles, inputs);
    if (!bytes) return bytes.error();
    // The accessors must match the decoded data, and Draco may split or drop vertices.
    const auto decoded = DracoMesh::decode(*bytes);
    if (!decoded) return decoded.error();

    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = slice.material;
    tinygltf::Value::Object ids;
    for (std::size_t a = 0; a < attributes.size(); ++a) {
      primitive.attributes[attributes[a].name] = add_accessor(attributes[a], -1, decoded->point_count());
      ids.emplace(attributes[a].name, tinygltf::Value(static_cast<int>(a)));
    }
    tinygltf::Accessor indices;
    indices.type = TINYGLTF_TYPE_SCALAR;
    indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    indices.count = std::size_t{3} * decoded->triangle_count();
    primitive.indices = add(indices);
    tinygltf::Value::Object extension;
    extension.emplace("bufferView", tinygltf::Value(add_view(std::as_bytes(std::span(*bytes)), 0)));
    extension.emplace("attributes", tinygltf::Value(std::move(ids)));
    primitive.extensions["KHR_draco_mesh_compression"] = tinygltf::Value(std::move(extension));
    gltf_.meshes[0].primitives.push_back(std::move(primitive));
    use_extension("KHR_draco_mesh_compression", true);
    return Unit{};
  }

  void add_plain_primitive(const Slice& slice, std::span<const SliceAttribute> attributes) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = slice.material;
    for (const SliceAttribute& attribute : attributes) {
      const int view = add_view(attribute.bytes, TINYGLTF_TARGET_ARRAY_BUFFER);
      primitive.attributes[attribute.name] = add_accessor(attribute, view, slice.vertices.size());
    }
    tinygltf::Accessor indices;
    indices.type = TINYGLTF_TYPE_SCALAR;
    indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    indices.count = slice.triangles.size() * 3;
    indices.bufferView = add_view(std::as_bytes(std::span(slice.triangles)), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    primitive.indices = add(indices);
    gltf_.meshes[0].primitives.push_back(std::move(primitive));
  }

  void set_rig(const std::string& rig_json) {
    gltf_.scenes[0].extensions["SEMBLANTE_face"] = to_value(nlohmann::json::parse(rig_json));
    use_extension("SEMBLANTE_face", false);
  }

  void set_skin(std::span<const GltfJoint> joints) {
    first_joint_ = gltf_.nodes.size();
    tinygltf::Skin skin;
    std::vector<float> matrices;
    for (const GltfJoint& joint : joints) {
      const int node = static_cast<int>(gltf_.nodes.size());
      tinygltf::Node out;
      out.name = joint.name;
      out.translation = {joint.translation.x, joint.translation.y, joint.translation.z};
      const glm::quat& q = joint.rotation;
      if (q.w != 1.0F) out.rotation = {q.x, q.y, q.z, q.w};
      gltf_.nodes.push_back(std::move(out));
      skin.joints.push_back(node);
      const float* const matrix = glm::value_ptr(joint.inverse_bind);
      matrices.insert(matrices.end(), matrix, matrix + 16);
    }
    int root = static_cast<int>(first_joint_);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (joints[j].parent) {
        gltf_.nodes[first_joint_ + *joints[j].parent].children.push_back(skin.joints[j]);
      } else {
        root = skin.joints[j];
      }
    }
    tinygltf::Accessor accessor;
    accessor.bufferView = add_view(std::as_bytes(std::span(matrices)), 0);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.type = TINYGLTF_TYPE_MAT4;
    accessor.count = joints.size();
    skin.inverseBindMatrices = add(accessor);
    skin.skeleton = root;
    skin.name = "face";
    gltf_.skins.push_back(std::move(skin));
    gltf_.nodes[0].skin = 0;
    gltf_.scenes[0].nodes.push_back(root);
  }

  void add_animation(const std::string& name, std::span<const GltfChannel> channels) {
    std::vector<float> times;
    std::vector<float> values;
    for (const GltfChannel& channel : channels) {
      times.insert(times.end(), channel.times.begin(), channel.times.end());
      values.insert(values.end(), channel.values.begin(), channel.values.end());
    }
    const int time_view = add_view(std::as_bytes(std::span(times)), 0);
    const int value_view = add_view(std::as_bytes(std::span(values)), 0);
    tinygltf::Animation animation;
    animation.name = name;
    std::size_t times_before = 0;
    std::size_t values_before = 0;
    for (const GltfChannel& channel : channels) {
      tinygltf::Accessor input = floats(time_view, times_before, channel.times.size(), 1);
      input.minValues = {static_cast<double>(channel.times.front())};
      input.maxValues = {static_cast<double>(channel.times.back())};
      const bool turns = channel.path == GltfChannel::Path::rotation;
      tinygltf::AnimationSampler sampler;
      sampler.interpolation = "LINEAR";
      sampler.input = add(input);
      sampler.output = add(floats(value_view, values_before, channel.times.size(), turns ? 4 : 3));
      tinygltf::AnimationChannel out;
      out.sampler = static_cast<int>(animation.samplers.size());
      out.target_node = static_cast<int>(first_joint_ + channel.joint);
      constexpr std::array paths = {"translation", "rotation", "scale"};
      out.target_path = paths[static_cast<std::size_t>(channel.path)];
      animation.samplers.push_back(std::move(sampler));
      animation.channels.push_back(std::move(out));
      times_before += channel.times.size();
      values_before += channel.values.size();
    }
    gltf_.animations.push_back(std::move(animation));
  }

  void set_asset_extras(const std::string& json) { gltf_.asset.extras = to_value(nlohmann::json::parse(json)); }

  Result<std::vector<std::uint8_t>> finish() {
    std::ostringstream out;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&gltf_, out, false, true)) {
      return Error{ErrorCode::internal, "glb", "tinygltf could not write the document"};
    }
    const std::string bytes = std::move(out).str();
    return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
  }

 private:
  int add(const tinygltf::Accessor& accessor) {
    gltf_.accessors.push_back(accessor);
    return static_cast<int>(gltf_.accessors.size()) - 1;
  }

  int add_accessor(const SliceAttribute& attribute, int view, std::size_t count) {
    tinygltf::Accessor accessor;
    accessor.bufferView = view;
    accessor.count = count;
    accessor.componentType = component_type(attribute.type);
    accessor.normalized = attribute.normalized;
    accessor.type = vector_type(attribute.components);
    if (attribute.name == "POSITION") {  // glTF requires the bounds of positions
      accessor.minValues.assign(3, std::numeric_limits<double>::max());
      accessor.maxValues.assign(3, std::numeric_limits<double>::lowest());
      for (std::size_t i = 0; i < attribute.bytes.size() / sizeof(float); ++i) {
        float value = 0.0F;
        std::memcpy(&value, attribute.bytes.data() + i * sizeof(float), sizeof(float));
        accessor.minValues[i % 3] = std::min(accessor.minValues[i % 3], static_cast<double>(value));
        accessor.maxValues[i % 3] = std::max(accessor.maxValues[i % 3], static_cast<double>(value));
      }
    }
    return add(accessor);
  }

  /// `before`: number of earlier floats in the view.
  static tinygltf::Accessor floats(int view, std::size_t before, std::size_t count, int components) {
    tinygltf::Accessor accessor;
    accessor.bufferView = view;
    accessor.byteOffset = before * sizeof(float);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.type = vector_type(components);
    accessor.count = count;
    return accessor;
  }

  int add_view(std::span<const std::byte> bytes, int target) {
    std::vector<unsigned char>& data = gltf_.buffers[0].data;
    data.resize((data.size() + 3) / 4 * 4);  // accessors need alignment to their component size
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = bytes.size();
    view.target = target;
    const auto* const begin = reinterpret_cast<const unsigned char*>(bytes.data());
    data.insert(data.end(), begin, begin + bytes.size());
    gltf_.bufferViews.push_back(view);
    return static_cast<int>(gltf_.bufferViews.size()) - 1;
  }

  void add_image(const Image& image) {
    tinygltf::Image out;
    out.mimeType = image.mime_type;
    out.bufferView = add_view(std::as_bytes(std::span(image.bytes)), 0);
    gltf_.images.push_back(out);
    tinygltf::Texture texture;
    texture.source = static_cast<int>(gltf_.images.size()) - 1;
    gltf_.textures.push_back(texture);
  }

  void add_material(const Material& material) {
    tinygltf::Material out;
    out.name = material.name;
    const glm::vec4& color = material.base_color;
    out.pbrMetallicRoughness.baseColorFactor = {color.r, color.g, color.b, color.a};
    out.pbrMetallicRoughness.metallicFactor = material.metallic;
    out.pbrMetallicRoughness.roughnessFactor = material.roughness;
    out.pbrMetallicRoughness.baseColorTexture.index = material.base_color_image;
    out.normalTexture.index = material.normal_image;
    out.doubleSided = material.double_sided;
    if (material.alpha_mode == Material::AlphaMode::blend) out.alphaMode = "BLEND";
    if (material.alpha_mode == Material::AlphaMode::mask) {
      out.alphaMode = "MASK";
      out.alphaCutoff = material.alpha_cutoff;
    }
    gltf_.materials.push_back(std::move(out));
  }

  void use_extension(const std::string& name, bool required) {
    const auto add_once = [&](std::vector<std::string>& list) {
      if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
    };
    add_once(gltf_.extensionsUsed);
    if (required) add_once(gltf_.extensionsRequired);
  }

  tinygltf::Model gltf_;
  std::size_t first_joint_ = 0;  ///< node of the skin's first joint
};

GltfBuilder::GltfBuilder(const std::vector<Material>& materials, const std::vector<Image>& images)
    : content_(std::make_unique<Content>(materials, images)) {}

GltfBuilder::~GltfBuilder() = default;

Status GltfBuilder::add_draco_primitive(const Slice& slice, const std::vector<SliceAttribute>& attributes) {
  return content_->add_draco_primitive(slice, attributes);
}

void GltfBuilder::add_plain_primitive(const Slice& slice, const std::vector<SliceAttribute>& attributes) {
  content_->add_plain_primitive(slice, attributes);
}

void GltfBuilder::set_rig(const std::string& rig_json) { content_->set_rig(rig_json); }

void GltfBuilder::set_skin(std::span<const GltfJoint> joints) { content_->set_skin(joints); }

void GltfBuilder::add_animation(const std::string& name, std::span<const GltfChannel> channels) {
  content_->add_animation(name, channels);
}

void GltfBuilder::set_asset_extras(const std::string& json) { content_->set_asset_extras(json); }

Result<std::vector<std::uint8_t>> GltfBuilder::finish() { return content_->finish(); }

}  // namespace semblante
