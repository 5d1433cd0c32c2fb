#include "server/package/glb_writer.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>
#include <sstream>
#include <tiny_gltf.h>

#include <nlohmann/json.hpp>

#include "server/package/draco_mesh.h"
#include "server/package/quantization.h"

namespace semblante {
namespace {

constexpr int weights_bits = 12;

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

/// One glTF primitive: the vertices and triangles of one material.
struct Slice {
  std::uint8_t material = 0;
  std::vector<std::uint32_t> vertices;  ///< render vertices, rising
  std::vector<Triangle> triangles;      ///< into `vertices`
};

std::vector<Slice> slice_by_material(const RenderMesh& mesh, std::size_t material_count) {
  std::vector<Slice> slices(material_count);
  std::vector<std::uint32_t> local(mesh.positions.size());
  for (std::size_t m = 0; m < material_count; ++m) slices[m].material = static_cast<std::uint8_t>(m);
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    Slice& slice = slices[mesh.materials[v]];
    local[v] = static_cast<std::uint32_t>(slice.vertices.size());
    slice.vertices.push_back(v);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    slices[mesh.triangle_materials[t]].triangles.push_back(
        {local[triangle[0]], local[triangle[1]], local[triangle[2]]});
  }
  std::erase_if(slices, [](const Slice& s) { return s.triangles.empty(); });
  return slices;
}

/// Gathers per-vertex data of a slice into one tightly packed block.
template <class T, class Get>
std::vector<std::byte> gather(const Slice& slice, std::size_t components, Get get) {
  std::vector<std::byte> bytes(slice.vertices.size() * components * sizeof(T));
  std::byte* out = bytes.data();
  for (const std::uint32_t vertex : slice.vertices) {
    for (std::size_t c = 0; c < components; ++c, out += sizeof(T)) {
      const T value = get(vertex, c);
      std::memcpy(out, &value, sizeof(T));
    }
  }
  return bytes;
}

/// A named attribute of a slice, ready for either writer.
struct SliceAttribute {
  std::string name;
  DracoAttribute::Kind kind;
  DracoAttribute::Type type;
  int components;
  int quantization_bits;
  std::vector<std::byte> bytes;
};

std::vector<SliceAttribute> geometry_attributes(const RenderMesh& mesh, const Slice& slice) {
  using Kind = DracoAttribute::Kind;
  using Type = DracoAttribute::Type;
  std::vector<SliceAttribute> attributes;
  attributes.push_back(
      {"POSITION", Kind::position, Type::float32, 3, position_bits,
       gather<float>(slice, 3, [&](auto v, auto c) { return mesh.positions[v][static_cast<int>(c)]; })});
  attributes.push_back({"NORMAL", Kind::normal, Type::float32, 3, normal_bits,
                        gather<float>(slice, 3, [&](auto v, auto c) { return mesh.normals[v][static_cast<int>(c)]; })});
  if (!mesh.uvs.empty()) {
    attributes.push_back({"TEXCOORD_0", Kind::uv, Type::float32, 2, uv_bits,
                          gather<float>(slice, 2, [&](auto v, auto c) { return mesh.uvs[v][static_cast<int>(c)]; })});
  }
  return attributes;
}

std::vector<SliceAttribute> influence_attributes(const Slice& slice, const GlbFace& face) {
  using Kind = DracoAttribute::Kind;
  using Type = DracoAttribute::Type;
  std::size_t most = 0;
  for (const std::uint32_t v : slice.vertices) most = std::max(most, face.rows->points_of(v).size());
  std::vector<SliceAttribute> attributes;
  for (std::size_t set = 0; set * 4 < most; ++set) {
    const auto at = [&](std::size_t c) { return set * 4 + c; };
    attributes.push_back({"_FP_INDEX_" + std::to_string(set), Kind::generic, Type::uint8, 4, 0,
                          gather<std::uint8_t>(slice, 4, [&](auto v, auto c) {
                            const auto row = face.rows->points_of(v);
                            return at(c) < row.size() ? row[at(c)].value() : std::uint8_t{0};
                          })});
    attributes.push_back({"_FP_WEIGHT_" + std::to_string(set), Kind::generic, Type::float32, 4, weights_bits,
                          gather<float>(slice, 4, [&](auto v, auto c) {
                            const auto row = face.rows->weights_of(v);
                            return at(c) < row.size() ? row[at(c)] : 0.0F;
                          })});
  }
  attributes.push_back({"_RIGID", Kind::generic, Type::uint8, 1, 0,
                        gather<std::uint8_t>(slice, 1, [&](auto v, auto) { return face.rigid[v]; })});
  return attributes;
}

/// Builds the glTF document; tinygltf's types stay in this file.
class Document {
 public:
  Document(const std::vector<Material>& materials, const std::vector<Image>& images) {
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

  Status add_draco_primitive(const Slice& slice, const std::vector<SliceAttribute>& attributes) {
    std::vector<DracoAttribute> inputs;
    inputs.reserve(attributes.size());
    for (const SliceAttribute& a : attributes) {
      inputs.push_back({a.kind, a.type, a.components, a.bytes, {}, a.quantization_bits});
    }
    auto bytes = encode_draco(slice.vertices.size(), slice.triangles, inputs);
    if (!bytes) return bytes.error();
    // The accessors must state what a decoder will find, and Draco may split or drop vertices.
    const auto counts = count_decoded(*bytes);
    if (!counts) return counts.error();

    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = slice.material;
    tinygltf::Value::Object ids;
    for (std::size_t a = 0; a < attributes.size(); ++a) {
      primitive.attributes[attributes[a].name] = add_accessor(attributes[a], -1, counts->points);
      ids.emplace(attributes[a].name, tinygltf::Value(static_cast<int>(a)));
    }
    tinygltf::Accessor indices;
    indices.type = TINYGLTF_TYPE_SCALAR;
    indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    indices.count = counts->triangles * 3;
    primitive.indices = add(indices);
    tinygltf::Value::Object extension;
    extension.emplace("bufferView", tinygltf::Value(add_view(std::as_bytes(std::span(*bytes)), 0)));
    extension.emplace("attributes", tinygltf::Value(std::move(ids)));
    primitive.extensions["KHR_draco_mesh_compression"] = tinygltf::Value(std::move(extension));
    gltf_.meshes[0].primitives.push_back(std::move(primitive));
    use_extension("KHR_draco_mesh_compression", true);
    return Unit{};
  }

  void add_plain_primitive(const Slice& slice, const std::vector<SliceAttribute>& attributes) {
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

  Result<std::vector<std::uint8_t>> finish() {
    std::ostringstream out;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&gltf_, out, false, true)) {
      return Error{ErrorCode::internal, "face.glb", "tinygltf could not write the document"};
    }
    const std::string bytes = std::move(out).str();
    return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
  }

 private:
  struct Counts {
    std::size_t points, triangles;
  };

  static Result<Counts> count_decoded(std::span<const std::uint8_t> bytes) {
    const auto decoded = decode_draco(bytes);
    if (!decoded) return decoded.error();
    return Counts{decoded->point_count, decoded->triangles.size()};
  }

  int add(const tinygltf::Accessor& accessor) {
    gltf_.accessors.push_back(accessor);
    return static_cast<int>(gltf_.accessors.size()) - 1;
  }

  int add_accessor(const SliceAttribute& attribute, int view, std::size_t count) {
    tinygltf::Accessor accessor;
    accessor.bufferView = view;
    accessor.count = count;
    accessor.componentType = attribute.type == DracoAttribute::Type::uint8 ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE
                                                                           : TINYGLTF_COMPONENT_TYPE_FLOAT;
    constexpr std::array types = {TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4};
    accessor.type = types[static_cast<std::size_t>(attribute.components) - 1];
    if (attribute.name == "POSITION") {  // glTF demands the bounds of positions
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

  int add_view(std::span<const std::byte> bytes, int target) {
    std::vector<unsigned char>& data = gltf_.buffers[0].data;
    data.resize((data.size() + 3) / 4 * 4);  // accessors want their component size, images do not mind
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
};

}  // namespace

Result<std::vector<std::uint8_t>> write_face_glb(const RenderMesh& mesh, const std::vector<Material>& materials,
                                                 const std::vector<Image>& images, const GlbFace& face) {
  Document document(materials, images);
  for (const Slice& slice : slice_by_material(mesh, materials.size())) {
    std::vector<SliceAttribute> attributes = geometry_attributes(mesh, slice);
    for (SliceAttribute& attribute : influence_attributes(slice, face)) attributes.push_back(std::move(attribute));
    const Status added = document.add_draco_primitive(slice, attributes);
    if (!added) return added.error();
  }
  document.set_rig(face.rig_json);
  return document.finish();
}

Result<std::vector<std::uint8_t>> write_preview_glb(const RenderMesh& mesh, const std::vector<Material>& materials,
                                                    const std::vector<Image>& images,
                                                    std::span<const std::uint32_t> part_of) {
  Document document(materials, images);
  for (const Slice& slice : slice_by_material(mesh, materials.size())) {
    std::vector<SliceAttribute> attributes = geometry_attributes(mesh, slice);
    attributes.push_back(
        {"_FILE_VERTEX", DracoAttribute::Kind::generic, DracoAttribute::Type::float32, 1, 0,
         gather<float>(slice, 1, [&](auto v, auto) { return static_cast<float>(mesh.file_vertex[v]); })});
    attributes.push_back({"_PART", DracoAttribute::Kind::generic, DracoAttribute::Type::float32, 1, 0,
                          gather<float>(slice, 1, [&](auto v, auto) { return static_cast<float>(part_of[v]); })});
    document.add_plain_primitive(slice, attributes);
  }
  return document.finish();
}

}  // namespace semblante
