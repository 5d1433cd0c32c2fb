#include "core/import/gltf_reader.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include "core/draco/draco_mesh.h"
#include "core/import/gltf_document.h"
#include "core/import/gltf_materials.h"
#include "core/import/gltf_morph_targets.h"
#include "core/import/gltf_neck_joints.h"
#include "core/import/gltf_scene.h"
#include "core/import/gltf_vertex_transform.h"
#include "core/import/model_builder.h"
#include "core/import/text.h"
#include "core/import/vertex_colors.h"
#include "core/json/json_tree.h"
#include "core/types/printable.h"

namespace semblante::import {
namespace {

enum PrimitiveMode : std::uint64_t { points, lines, line_loop, line_strip, triangles, triangle_strip, triangle_fan };

/// Extensions that are read, or change only the look of a surface. Any other *required* extension is refused: without
/// it the geometry would be wrong.
constexpr std::array<std::string_view, 12> known_extensions = {
    "KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization",
    "KHR_texture_transform",      "KHR_animation_pointer",   "EXT_lights_image_based",
    "KHR_lights_punctual",        "KHR_texture_basisu",      "EXT_texture_webp",
    "EXT_texture_avif",           "KHR_xmp_json_ld",         "KHR_materials_pbrSpecularGlossiness"};

bool is_known_extension(std::string_view name) {
  return name.starts_with("KHR_materials_") ||
         std::find(known_extensions.begin(), known_extensions.end(), name) != known_extensions.end();
}

void check_asset(GltfDocument& document) {
  const JsonCursor root = document.root();
  root.must_be_object();
  if (document.failed()) return;
  const JsonCursor version = root.member("asset").member("version");
  if (const std::string text = version.text(); !document.failed() && !text.starts_with("2.")) {
    version.fail(ErrorCode::unsupported, "is " + shown(text) + ", but only glTF 2 is supported");
  }
  for (std::size_t i = 0; i < root.size_of("extensionsRequired"); ++i) {
    const JsonCursor name = root.member("extensionsRequired").element(i);
    if (const std::string text = name.text(); !document.failed() && !is_known_extension(text)) {
      name.fail(ErrorCode::unsupported, "requires the extension " + shown(text) + ", which is not supported");
    }
  }
}

/// The source of a primitive's attributes: accessors, or the Draco data that replaces them.
class PrimitiveData {
 public:
  PrimitiveData(GltfDocument& document, JsonCursor primitive, const ImportLimits& limits)
      : document_(document), primitive_(std::move(primitive)), attributes_(primitive_.member("attributes")) {
    constexpr const char* name = "KHR_draco_mesh_compression";
    if (!primitive_.has("extensions") || !primitive_.member("extensions").has(name) || document_.failed()) return;
    draco_place_ = primitive_.member("extensions").member(name);
    const std::size_t view = draco_place_->required_index("bufferView", document_.count("bufferViews"));
    if (document_.failed()) return;
    const auto bytes = document_.draco_view(view, *draco_place_);
    if (document_.failed()) return;
    auto decoded = DracoMesh::decode(bytes, {limits.max_vertices, limits.max_triangles});
    if (!decoded) {
      draco_place_->fail(decoded.error().code, decoded.error().message);
    } else {
      draco_ = std::move(*decoded);
    }
    // The decoded triangles index the decoded points, so other positions cannot be used.
    if (draco_ && !in_draco("POSITION")) draco_place_->fail(ErrorCode::missing, "has no attribute POSITION");
  }

  [[nodiscard]] bool has(const char* attribute) const { return attributes_.has(attribute); }

  /// Of this primitive; what the file may still have is not checked.
  [[nodiscard]] std::size_t vertex_count(std::size_t max) const {
    if (draco_ && in_draco("POSITION")) return draco_->point_count();
    const auto accessor = accessor_of("POSITION");
    return accessor ? document_.accessor_count(*accessor, max) : 0;
  }

  using NotFinite = GltfDocument::NotFinite;

  [[nodiscard]] std::vector<float> floats(const char* attribute, std::size_t components, std::size_t count,
                                          NotFinite not_finite = NotFinite::refused) const {
    const auto accessor = accessor_of(attribute);
    if (!accessor) return {};
    if (!draco_ || !in_draco(attribute)) return document_.floats(*accessor, components, count, not_finite);
    const bool normalized = document_.item("accessors", *accessor).boolean_or("normalized", false);
    const JsonCursor id = draco_place_->member("attributes").member(attribute);
    auto values = draco_->floats(static_cast<std::uint32_t>(id.integer(0, 0xFFFFFFFFU)), components, normalized);
    if (values && !document_.failed()) return std::move(*values);
    if (!values) id.fail(values.error().code, values.error().message);
    return {};
  }

  /// Of COLOR_0: three components, or four with an opacity, and the number that is full light. Whole numbers that are
  /// not marked as normalized, against the standard, are bytes or shorts all the same.
  struct ColorLayout {
    std::size_t components;
    float full;
  };
  [[nodiscard]] ColorLayout color_layout() const {
    const auto accessor = accessor_of("COLOR_0");
    if (!accessor) return {3, 1.0F};
    const JsonCursor item = document_.item("accessors", *accessor);
    const std::size_t components = item.text_or("type", "") == "VEC4" ? 4 : 3;
    if (item.boolean_or("normalized", false)) return {components, 1.0F};
    constexpr std::uint64_t u8 = 5121;
    constexpr std::uint64_t u16 = 5123;
    const std::uint64_t type = item.integer_or("componentType", 0);
    return {components, type == u8 ? 255.0F : type == u16 ? 65535.0F : 1.0F};
  }

  [[nodiscard]] std::vector<std::uint32_t> indices(std::size_t vertex_count, std::size_t max_count) const {
    if (draco_) {
      std::vector<std::uint32_t> indices;
      indices.reserve(std::size_t{3} * draco_->triangle_count());
      for (const Triangle& triangle : draco_->triangles()) {
        indices.insert(indices.end(), triangle.begin(), triangle.end());
      }
      return indices;
    }
    const auto accessor = primitive_.index("indices", document_.count("accessors"));
    if (document_.failed()) return {};
    if (accessor) return document_.indices(*accessor, vertex_count, max_count);
    std::vector<std::uint32_t> in_order(vertex_count);
    for (std::size_t i = 0; i < vertex_count; ++i) in_order[i] = static_cast<std::uint32_t>(i);
    return in_order;
  }

  /// Draco data always has triangles, independent of `mode`.
  [[nodiscard]] std::uint64_t mode() const { return draco_ ? triangles : primitive_.integer_or("mode", triangles); }

 private:
  [[nodiscard]] std::optional<std::size_t> accessor_of(const char* attribute) const {
    return attributes_.index(attribute, document_.count("accessors"));
  }
  [[nodiscard]] bool in_draco(const char* attribute) const {
    return draco_place_->has("attributes") && draco_place_->member("attributes").has(attribute);
  }

  GltfDocument& document_;
  JsonCursor primitive_;
  JsonCursor attributes_;
  std::optional<JsonCursor> draco_place_;
  std::optional<DracoMesh> draco_;
};

class GltfReader {
 public:
  GltfReader(GltfDocument& document, const ImportLimits& limits)
      : document_(document), builder_(limits), morph_targets_(document, builder_) {}

  Result<Model> read(const char* format) {
    check_asset(document_);
    if (!document_.failed()) uv_sources_ = read_materials(document_, builder_);
    if (!document_.failed()) {
      GltfScene scene = read_scene(document_);
      placements_ = std::move(scene.meshes);
      if (!document_.failed()) builder_.model.neck_joints = find_neck_joints(document_, scene.world);
    }
    sizes_.resize(placements_.size());
    for (std::size_t mesh = 0; !document_.failed() && mesh < placements_.size(); ++mesh) read_mesh(mesh);
    if (!document_.failed()) read_further_places();
    if (!builder_.model.examples.empty()) morph_targets_.warn_of_shown();
    if (document_.failed()) return document_.fault();
    pad(builder_.model.uvs);
    pad(builder_.model.normals);
    return std::move(builder_).finish(format);
  }

 private:
  /// A mesh with its vertices in their place among the file's, where its first node puts it.
  void read_mesh(std::size_t index) {
    const auto& places = placements_[index].kept;
    if (places.empty()) {
      builder_.warn("mesh " + std::to_string(index) + " " + shown_name(index) +
                    " is in no node of the scene: its vertices keep their numbers, its triangles are omitted");
    }
    const std::size_t first = builder_.model.positions.size();
    const std::size_t triangles_before = builder_.triangles_left();
    read_primitives(index, places.empty() ? nullptr : &places.front());
    const auto added = std::span(builder_.model.positions).subspan(first);
    MeshSize& size = sizes_[index];
    size = {added.size(), triangles_before - builder_.triangles_left(), {}};
    for (const glm::vec3& position : added) size.box.add(glm::dvec3(position));
    if (!places.empty()) scene_box_.add(size.box);
  }

  /// The other places of meshes that are in several nodes, such as the second eye. Their vertices follow those of all
  /// meshes, so that no vertex number depends on them.
  void read_further_places() {
    for (std::size_t mesh = 0; !document_.failed() && mesh < placements_.size(); ++mesh) {
      const auto& [places, count] = placements_[mesh];
      std::size_t kept = std::min<std::size_t>(places.size(), 1);
      for (std::size_t i = 1; !document_.failed() && i < places.size(); ++i) {
        if (!belongs_to_head(mesh, places[i]) || !has_room_for(sizes_[mesh])) continue;
        read_primitives(mesh, &places[i]);
        ++kept;
      }
      if (kept == count) continue;
      builder_.warn("mesh " + std::to_string(mesh) + " " + shown_name(mesh) + " is in " + std::to_string(count) +
                    " nodes; only " + (kept == 1 ? "the first is kept" : std::to_string(kept) + " are kept"));
    }
  }

  /// Whether the middle of a mesh in this place lies within the box of all meshes in their first places, or close
  /// beside it, as the other ear does. That of a second head, which stands beside this one, does not.
  [[nodiscard]] bool belongs_to_head(std::size_t mesh, const MeshPlacement& place) const {
    const MeshPlacement& first = placements_[mesh].kept.front();
    if (first.joints || place.joints) return false;  // no matrix tells where
    constexpr double margin = 0.1;
    const glm::dvec4 middle((sizes_[mesh].box.low + sizes_[mesh].box.high) / 2.0, 1.0);
    const glm::dvec3 there(place.to_world * glm::inverse(first.to_world) * middle);
    const glm::dvec3 beside = margin * (scene_box_.high - scene_box_.low);
    return glm::all(glm::greaterThanEqual(there, scene_box_.low - beside)) &&
           glm::all(glm::lessThanEqual(there, scene_box_.high + beside));
  }

  struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& place) {
      low = glm::min(low, place);
      high = glm::max(high, place);
    }
    void add(const Box& other) {
      low = glm::min(low, other.low);
      high = glm::max(high, other.high);
    }
  };

  /// Of a mesh in its first place.
  struct MeshSize {
    std::size_t vertices = 0;
    std::size_t triangles = 0;  ///< omitted ones count
    Box box;
  };

  [[nodiscard]] bool has_room_for(const MeshSize& size) const {
    return size.vertices <= builder_.limits().max_vertices - builder_.model.positions.size() &&
           size.triangles < builder_.triangles_left();
  }

  [[nodiscard]] std::string shown_name(std::size_t mesh) { return shown(name_of(document_.item("meshes", mesh))); }

  /// Truncated, because every primitive keeps a copy.
  static std::string name_of(const JsonCursor& mesh) { return printable(mesh.text_or("name", "")); }

  /// A null placement reads vertices alone.
  void read_primitives(std::size_t index, const MeshPlacement* placement) {
    const JsonCursor mesh = document_.item("meshes", index);
    const std::string name = name_of(mesh);
    const JsonCursor primitives = mesh.member("primitives");
    for (std::size_t i = 0; !document_.failed() && i < primitives.size(); ++i) {
      read_primitive(mesh, primitives.element(i), name, placement);
    }
  }

  void read_primitive(const JsonCursor& mesh, const JsonCursor& primitive, const std::string& name,
                      const MeshPlacement* placement) {
    const PrimitiveData data(document_, primitive, builder_.limits());
    if (document_.failed()) return;
    if (!data.has("POSITION")) {
      builder_.warn(primitive.pointer() + " has no positions and is omitted");
      return;
    }
    const std::size_t vertices_left = builder_.limits().max_vertices - builder_.model.positions.size();
    const std::size_t count = data.vertex_count(builder_.limits().max_vertices);
    if (count > vertices_left)
      primitive.fail(ErrorCode::too_large, "has " + std::to_string(count) + " vertices, only " +
                                               std::to_string(vertices_left) + " more are allowed");
    const auto material = primitive.index("material", builder_.model.materials.size());
    if (document_.failed()) return;

    const auto first = static_cast<std::uint32_t>(builder_.model.positions.size());
    const std::vector<float> positions = data.floats("POSITION", 3, count);
    VertexTransform transform(placement);
    for (int set = 0; transform.wants_joints() && set < 4; ++set) {
      const std::string joints = "JOINTS_" + std::to_string(set);
      const std::string weights = "WEIGHTS_" + std::to_string(set);
      if (!data.has(joints.c_str()) || !data.has(weights.c_str())) break;
      transform.add_joints(data.floats(joints.c_str(), 4, count), data.floats(weights.c_str(), 4, count));
    }
    if (document_.failed()) return;
    for (std::size_t i = 0; i < count; ++i) {
      builder_.model.positions.push_back(
          transform.position(i, glm::vec3(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2])));
    }
    const bool has_colors = read_colors(data, count);
    const bool has_uvs = read_uvs(data, material, count);
    const bool has_normals = read_normals(data, transform, count);
    if (document_.failed() || placement == nullptr) return;
    morph_targets_.read(mesh, primitive, first, count, transform);

    builder_.begin_primitive(name, material ? static_cast<int>(*material) : -1, has_colors);
    add_triangles(primitive, data,
                  Range{first, static_cast<std::uint32_t>(count), has_uvs, has_normals, transform.mirrors()});
  }

  bool read_uvs(const PrimitiveData& data, std::optional<std::size_t> material, std::size_t count) {
    const UvSource source = material && *material < uv_sources_.size() ? uv_sources_[*material] : UvSource{};
    const std::string name = "TEXCOORD_" + std::to_string(source.set);
    if (!data.has(name.c_str())) return false;
    const std::vector<float> values = data.floats(name.c_str(), 2, count);
    if (document_.failed()) return false;
    pad_before(builder_.model.uvs, count);
    for (std::size_t i = 0; i < count; ++i) {
      glm::vec2 uv(values[2 * i], values[2 * i + 1]);
      if (!source.is_identity) uv = glm::vec2(glm::dvec2(source.transform * glm::dvec3(uv, 1.0)));
      builder_.model.uvs.push_back(uv);
    }
    return true;
  }

  /// Their opacity is that of the material alone.
  bool read_colors(const PrimitiveData& data, std::size_t count) {
    if (!data.has("COLOR_0")) return false;
    const auto [components, full] = data.color_layout();
    const std::vector<float> values = data.floats("COLOR_0", components, count, PrimitiveData::NotFinite::zero);
    if (document_.failed()) return false;
    GivenColors given;
    given.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const float* const at = values.data() + i * components;
      given.emplace_back(at[0], at[1], at[2]);
    }
    builder_.model.colors.resize(builder_.model.positions.size() - count, white);
    append_colors(given, full, ColorSpace::linear, builder_.model.colors);
    return true;
  }

  bool read_normals(const PrimitiveData& data, const VertexTransform& transform, std::size_t count) {
    if (!data.has("NORMAL")) return false;
    // Exporters write normals that are no numbers where triangles have no area: they are none, like those without
    // length.
    const std::vector<float> values = data.floats("NORMAL", 3, count, PrimitiveData::NotFinite::zero);
    if (document_.failed()) return false;
    pad_before(builder_.model.normals, count);
    for (std::size_t i = 0; i < count; ++i) {
      builder_.model.normals.push_back(
          transform.normal(i, glm::vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2])));
    }
    return true;
  }

  /// UVs and normals are parallel to the positions; primitives without them get zeros that no corner uses.
  template <class V>
  void pad_before(std::vector<V>& values, std::size_t count) {
    values.resize(builder_.model.positions.size() - count, V(0.0F));
  }
  template <class V>
  void pad(std::vector<V>& values) {
    if (!values.empty()) values.resize(builder_.model.positions.size(), V(0.0F));
  }

  /// The range of file vertices of a primitive, and the attributes of its corners.
  struct Range {
    std::uint32_t first, count;
    bool has_uvs, has_normals, mirrored;
  };

  void add_triangles(const JsonCursor& primitive, const PrimitiveData& data, const Range& range) {
    const std::uint64_t mode = data.mode();
    if (mode > triangle_fan) primitive.member("mode").fail(ErrorCode::out_of_range, "must be a glTF mode, 0 to 6");
    if (document_.failed()) return;
    if (mode < triangles) {
      builder_.warn(primitive.pointer() + " has points or lines: its vertices keep their numbers, nothing is drawn");
      return;
    }
    const std::size_t left = builder_.triangles_left();
    const std::vector<std::uint32_t> indices = data.indices(range.count, mode == triangles ? 3 * left : left + 2);
    if (document_.failed() || indices.size() < 3) return;
    if (mode == triangles && indices.size() % 3 != 0) {
      builder_.warn(primitive.pointer() + " has " + std::to_string(indices.size()) +
                    " indices, not a multiple of 3; the last are omitted");
    }
    const std::size_t triangle_count = mode == triangles ? indices.size() / 3 : indices.size() - 2;
    if (triangle_count > left) {
      primitive.fail(ErrorCode::too_large,
                     "more than " + std::to_string(builder_.limits().max_triangles) + " triangles");
      return;
    }
    for (std::size_t i = 0; i < triangle_count; ++i) {
      std::array<std::size_t, 3> corners = {3 * i, 3 * i + 1, 3 * i + 2};
      if (mode == triangle_strip) corners = {i, i + 1 + i % 2, i + 2 - i % 2};
      if (mode == triangle_fan) corners = {i + 1, i + 2, 0};
      if (range.mirrored) std::swap(corners[1], corners[2]);
      builder_.add_triangle(corner(indices[corners[0]], range), corner(indices[corners[1]], range),
                            corner(indices[corners[2]], range));
    }
  }

  static Corner corner(std::uint32_t index, const Range& range) {
    const std::uint32_t vertex = range.first + index;
    return {vertex, range.has_uvs ? vertex : Model::no_index, range.has_normals ? vertex : Model::no_index};
  }

  GltfDocument& document_;
  ModelBuilder builder_;
  MorphTargets morph_targets_;
  std::vector<UvSource> uv_sources_;
  std::vector<MeshPlacements> placements_;  ///< per mesh
  std::vector<MeshSize> sizes_;             ///< per mesh
  Box scene_box_;                           ///< of all meshes in their first places
};

Result<Model> read_document(std::string_view text, std::span<const std::uint8_t> binary,
                            const ResourceReader& resources, const ImportLimits& limits, const char* format) {
  auto tree = read_json_tree(text);
  if (!tree) return tree.error();
  GltfDocument document(std::move(*tree), binary, resources, limits);
  return GltfReader(document, limits).read(format);
}

}  // namespace

Result<Model> read_glb(std::span<const std::uint8_t> bytes, const ImportLimits& limits,
                       const ResourceReader& resources) {
  const auto chunks = split_glb(bytes);
  if (!chunks) return chunks.error();
  return read_document(chunks->json, chunks->binary, resources, limits, "glb");
}

Result<Model> read_gltf(std::string_view json, const ImportLimits& limits, const ResourceReader& resources) {
  return read_document(json, {}, resources, limits, "gltf");
}

}  // namespace semblante::import
