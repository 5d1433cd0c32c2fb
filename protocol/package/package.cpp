#include "protocol/package/package.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "core/expressions/companions.h"
#include "core/expressions/contact.h"
#include "core/expressions/library.h"
#include "core/geometry/smooth_normals.h"
#include "core/materials/materials.h"
#include "protocol/cpp/rig_document.h"
#include "protocol/cpp/weights_format.h"
#include "protocol/package/glb_writer.h"
#include "protocol/package/mesh_encoding.h"
#include "protocol/package/render_mesh.h"

namespace semblante {
namespace {

Artefact make_artefact(std::vector<std::uint8_t> bytes) {
  Artefact artefact;
  artefact.sha256 = sha256(bytes);
  artefact.bytes = std::move(bytes);
  return artefact;
}

/// The rows of the file vertices, laid out for a mesh whose vertex i is file vertex `file_vertex[i]`.
WeightTable<float> lay_out(const WeightTable<float>& by_file_vertex, std::span<const std::uint32_t> file_vertex) {
  WeightTable<float> rows;
  for (const std::uint32_t vertex : file_vertex) {
    const auto points = by_file_vertex.points_of(vertex);
    const auto weights = by_file_vertex.weights_of(vertex);
    for (std::size_t i = 0; i < points.size(); ++i) rows.push(points[i], weights[i]);
    rows.end_row();
  }
  return rows;
}

/// Likewise the value of each vertex as a byte; empty stays empty.
template <class T>
std::vector<std::uint8_t> lay_out(const std::vector<T>& by_file_vertex, std::span<const std::uint32_t> file_vertex) {
  std::vector<std::uint8_t> result;
  if (by_file_vertex.empty()) return result;
  result.reserve(file_vertex.size());
  for (const std::uint32_t vertex : file_vertex) result.push_back(static_cast<std::uint8_t>(by_file_vertex[vertex]));
  return result;
}

/// A level may have another file vertex of the same surface vertex as the point: then uses that one.
std::vector<RigDocument::Point> name_points(const Surface& surface, const FeaturePointSet& points,
                                            std::span<const std::uint32_t> file_vertex) {
  std::vector<RigDocument::Point> named;
  for (const FeaturePoint& point : points) {
    RigDocument::Point out{point.id, std::nullopt, point.position};
    if (point.vertex) {
      auto at = std::find(file_vertex.begin(), file_vertex.end(), point.vertex->value());
      const SurfaceVertexId place = surface.surface_of[point.vertex->value()];
      if (at == file_vertex.end())
        at = std::find_if(file_vertex.begin(), file_vertex.end(),
                          [&](std::uint32_t v) { return surface.surface_of[v] == place; });
      if (at != file_vertex.end()) out.vertex = static_cast<std::uint32_t>(at - file_vertex.begin());
    }
    named.push_back(out);
  }
  return named;
}

RigDocument::MaterialInfo describe(const Material& material, std::span<const ImageArtefact> images) {
  const auto image_hash = [&](int index) -> std::optional<Sha256> {
    if (index < 0 || static_cast<std::size_t>(index) >= images.size()) return std::nullopt;
    return images[static_cast<std::size_t>(index)].sha256;
  };
  RigDocument::MaterialInfo out;
  out.name = material.name;
  out.base_color = material.base_color;
  out.metallic = material.metallic;
  out.roughness = material.roughness;
  out.alpha_mode = static_cast<RigDocument::MaterialInfo::AlphaMode>(material.alpha_mode);
  out.alpha_cutoff = material.alpha_cutoff;
  out.double_sided = material.double_sided;
  out.base_color_image = image_hash(material.base_color_image);
  out.normal_image = image_hash(material.normal_image);
  return out;
}

/// A set on this face: converted from FAPUs to model units, without points that are not marked.
RigDocument::DisplacementSet on_this_face(const DisplacementSet& set, const Rig& rig) {
  RigDocument::DisplacementSet out;
  out.name = set.name;
  for (const Displacement& displacement :
       on_face(set, rig.fapu, rig.points, rig.lip_gaps, rig.articulation).displacements) {
    const bool marked = std::any_of(rig.points.begin(), rig.points.end(),
                                    [&](const FeaturePoint& p) { return p.id == displacement.point; });
    if (marked) out.displacements.push_back({displacement.point, displacement.value});
  }
  return out;
}

/// The face's set of that name: its own, or the library's.
DisplacementSet worn_as(const DisplacementSet& of_library, std::span<const NamedSet> worn) {
  const auto own = std::find_if(worn.begin(), worn.end(), [&](const NamedSet& s) { return s.name == of_library.name; });
  return own == worn.end() ? of_library : own->view();
}

void describe_influence(const InfluenceTable& table, const Artefact& weights, int bits, double max_error,
                        RigDocument::Weights& out) {
  std::size_t influenced = 0;
  for (std::size_t v = 0; v < table.rows.row_count(); ++v) {
    const auto count = static_cast<std::uint32_t>(table.rows.points_of(v).size());
    out.max_influences = std::max(out.max_influences, count);
    influenced += count > 0 ? 1 : 0;
  }
  out.sha256 = weights.sha256;
  out.bytes = weights.bytes.size();
  out.bits = bits;
  out.max_error = max_error;
  out.mean_influences =
      influenced == 0 ? 0.0 : static_cast<double>(table.rows.weights.size()) / static_cast<double>(influenced);
}

/// The model of a level: a copy without the images, which can be large.
Model model_of_level(const Model& model, const LevelOfDetail& level) {
  Model out;
  out.positions = model.positions;
  out.uvs = model.uvs;
  out.normals = model.normals;
  out.colors = model.colors;
  out.primitives = model.primitives;
  out.materials = model.materials;
  apply_level(out, level);
  return out;
}

/// An unfinished package: rig.json of each level needs the sizes of all levels.
struct Draft {
  RenderMesh mesh;
  EncodedMesh encoded;
  InfluenceTable table;
  std::vector<Part> parts;
  double weight_error = 0.0;
  FacePackage package;
};

Result<Draft> encode(RenderMesh mesh, const Rig& rig, std::vector<Part> parts, int weight_bits) {
  Draft draft;
  draft.mesh = std::move(mesh);
  draft.parts = std::move(parts);
  if (!draft.mesh.positions.empty()) {
    const auto [low, high] = bounds_of(draft.mesh);
    draft.mesh.position_bits = position_bits(longest_side(low, high), rig.fapu);
  }
  auto encoded = encode_mesh(draft.mesh);
  if (!encoded) return encoded.error();
  draft.encoded = std::move(*encoded);
  draft.package.mesh_drc = make_artefact(std::move(draft.encoded.bytes));
  draft.package.vertices = static_cast<std::uint32_t>(draft.encoded.file_vertex.size());
  draft.package.triangles = static_cast<std::uint32_t>(draft.encoded.triangle_count);
  draft.table.vertex_count = draft.package.vertices;
  draft.table.mesh_sha256 = draft.package.mesh_drc.sha256;
  draft.table.rows = lay_out(rig.influence, draft.encoded.file_vertex);
  draft.table.rigid = lay_out(rig.rigid_of_vertex, draft.encoded.file_vertex);
  draft.table.turn = lay_out(rig.turn_of_vertex, draft.encoded.file_vertex);
  draft.package.weights = make_artefact(encode_weights(draft.table, {weight_bits}));
  const auto decoded = decode_weights(draft.package.weights.bytes);
  if (!decoded) return decoded.error();
  draft.weight_error = max_quantization_error(draft.table, *decoded);
  return draft;
}

/// The members that all levels have in common.
RigDocument common_document(const Rig& rig, const MaterialAssignment& materials, std::span<const ImageArtefact> images,
                            const PackageOptions& options) {
  RigDocument document;
  document.name = options.name;
  document.fapu = rig.fapu;
  document.eye_pivots = {rig.left_eye_pivot, rig.right_eye_pivot};
  document.head_pivot = rig.head_pivot;
  document.articulation = rig.articulation;
  document.irises = rig.irises;
  document.tongue = rig.tongue;
  document.lids = rig.lids;
  document.companions = companions_of(rig.points);
  for (std::size_t v = 0; v < mpeg4::viseme_count; ++v)
    document.visemes[v] = on_this_face(worn_as(viseme_library()[v], options.worn), rig);
  for (std::size_t e = 0; e < mpeg4::expression_count; ++e)
    document.expressions[e] = on_this_face(worn_as(expression_library()[e], options.worn), rig);
  for (const Material& material : materials.materials) document.materials.push_back(describe(material, images));
  for (const ImageArtefact& image : images)
    document.images.push_back({image.sha256, image.mime_type, image.bytes.size()});
  document.warnings = options.warnings;
  return document;
}

/// Sets the members specific to this level.
void describe_level(const Draft& draft, const Surface& surface, const Rig& rig, int weight_bits,
                    RigDocument& document) {
  document.mesh.sha256 = draft.package.mesh_drc.sha256;
  document.mesh.vertices = draft.package.vertices;
  document.mesh.triangles = draft.package.triangles;
  document.mesh.bytes = draft.package.mesh_drc.bytes.size();
  document.mesh.attributes.position = draft.encoded.attributes.position;
  document.mesh.attributes.normal = draft.encoded.attributes.normal;
  document.mesh.attributes.uv = draft.encoded.attributes.uv;
  document.mesh.attributes.material = draft.encoded.attributes.material;
  document.mesh.attributes.color = draft.encoded.attributes.color;
  describe_influence(draft.table, draft.package.weights, weight_bits, draft.weight_error, document.weights);
  document.feature_points = name_points(surface, rig.points, draft.encoded.file_vertex);
  for (const Part& part : draft.parts) {
    document.parts.push_back({part.name, part.role, part.vertex_count, part.triangle_count});
  }
  std::tie(document.bounds_min, document.bounds_max) = bounds_of(draft.mesh);
}

Status finish(Draft& draft, const Model& model, const Rig& rig, const MaterialAssignment& materials,
              RigDocument document) {
  const std::string rig_json = write_rig(document);
  draft.package.rig_json = make_artefact({rig_json.begin(), rig_json.end()});

  // face.glb has its own vertex numbers, so its copy of the rig must not refer to mesh.drc.
  for (RigDocument::Point& point : document.feature_points) point.vertex.reset();
  GlbFace face;
  const WeightTable<float> render_rows = lay_out(rig.influence, draft.mesh.file_vertex);
  const std::vector<std::uint8_t> render_rigid = lay_out(rig.rigid_of_vertex, draft.mesh.file_vertex);
  face.rows = &render_rows;
  const std::vector<std::uint8_t> render_turn = lay_out(rig.turn_of_vertex, draft.mesh.file_vertex);
  face.rigid = render_rigid;
  face.turn = render_turn;
  face.rig_json = write_rig(document);
  auto glb = write_face_glb(draft.mesh, materials.materials, model.images, face);
  if (!glb) return glb.error();
  draft.package.face_glb = make_artefact(std::move(*glb));
  return Unit{};
}

}  // namespace

Result<std::vector<FacePackage>> build_packages(const Model& model, const Surface& surface, const Rig& rig,
                                                const MaterialAssignment& materials,
                                                std::span<const LevelOfDetail> levels, const PackageOptions& options) {
  const std::vector<glm::vec3> normals = smooth_normals(model, surface);
  std::vector<Draft> drafts;
  auto full =
      encode(make_render_mesh(model, surface, materials.of_triangle, normals), rig, rig.parts, options.weight_bits);
  if (!full) return full.error();
  drafts.push_back(std::move(*full));
  for (const LevelOfDetail& level : levels) {
    std::vector<std::uint8_t> of_triangle;
    for (const std::uint32_t source : level.source_triangles) of_triangle.push_back(materials.of_triangle[source]);
    auto draft = encode(make_render_mesh(model_of_level(model, level), surface, of_triangle, normals), rig,
                        parts_of_level(rig, level), options.weight_bits);
    if (!draft) return draft.error();
    drafts.push_back(std::move(*draft));
  }

  for (const Image& image : model.images)
    drafts[0].package.images.push_back({make_artefact(image.bytes), image.mime_type});
  RigDocument common = common_document(rig, materials, drafts[0].package.images, options);
  if (!levels.empty()) {
    for (const Draft& draft : drafts) {
      common.levels.push_back({draft.package.vertices, draft.package.triangles,
                               draft.package.mesh_drc.bytes.size() + draft.package.weights.bytes.size()});
    }
  }
  std::vector<FacePackage> packages;
  for (Draft& draft : drafts) {
    RigDocument document = common;
    document.lod = static_cast<std::uint32_t>(packages.size());
    describe_level(draft, surface, rig, options.weight_bits, document);
    if (const Status made = finish(draft, model, rig, materials, std::move(document)); !made) return made.error();
    packages.push_back(std::move(draft.package));
  }
  return packages;
}

Result<FacePackage> build_package(const Model& model, const Surface& surface, const Rig& rig,
                                  const PackageOptions& options) {
  auto packages = build_packages(model, surface, rig, assign_materials(model, surface, rig.parts), {}, options);
  if (!packages) return packages.error();
  return std::move(packages->front());
}

Result<std::vector<std::uint8_t>> build_preview(const Model& model, const Surface& surface,
                                                std::span<const Part> parts) {
  const MaterialAssignment materials = assign_materials(model, surface, parts);
  const RenderMesh mesh = make_render_mesh(model, surface, materials.of_triangle, smooth_normals(model, surface));
  std::vector<std::uint32_t> part_of;
  part_of.reserve(mesh.file_vertex.size());
  for (const std::uint32_t vertex : mesh.file_vertex)
    part_of.push_back(surface.part_of[surface.surface_of[vertex].value()].value());
  return write_preview_glb(mesh, materials.materials, model.images, part_of);
}

}  // namespace semblante
