#include "clients/native/client/face_package.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "clients/runtime/face_mesh.h"
#include "clients/runtime/sha256.h"
#include "protocol/cpp/rig_material.h"

namespace semblante::client {
namespace {

constexpr std::uint64_t max_rig_bytes = 16U << 20U;
constexpr std::uint64_t max_mesh_bytes = 128U << 20U;
constexpr std::uint64_t max_image_bytes = 64U << 20U;

std::span<const std::uint8_t> as_bytes(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

void mark_colored(Model& model) {
  for (Primitive& primitive : model.primitives) {
    const auto first = model.triangles.begin() + primitive.first_triangle;
    primitive.has_colors = std::any_of(first, first + primitive.triangle_count, [&](const Triangle& corners) {
      return std::any_of(corners.begin(), corners.end(), [&](auto v) { return model.colors[v] != white; });
    });
  }
}

/// Triangles in runs of one material each; vertices keep their numbers.
Result<Model> to_model(runtime::FaceMesh&& mesh, const RigDocument& rig) {
  Model model;
  model.format = "drc";
  for (const RigDocument::MaterialInfo& info : rig.materials) {
    model.materials.push_back(material_of(info, rig.images));
  }
  model.images.resize(rig.images.size());
  const auto material_of = [&](const Triangle& t) {
    return mesh.materials.empty() ? std::uint8_t{0} : mesh.materials[t[0]];
  };
  std::stable_sort(mesh.triangles.begin(), mesh.triangles.end(),
                   [&](const Triangle& a, const Triangle& b) { return material_of(a) < material_of(b); });
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint8_t material = material_of(mesh.triangles[t]);
    if (material >= model.materials.size() && !model.materials.empty()) {
      return Error{ErrorCode::out_of_range, "mesh.drc", "a vertex refers to a material that rig.json does not have"};
    }
    const int index = model.materials.empty() ? -1 : int{material};
    if (model.primitives.empty() || model.primitives.back().material != index) {
      model.primitives.push_back(
          {index < 0 ? std::string() : model.materials[material].name, index, static_cast<std::uint32_t>(t), 0});
    }
    ++model.primitives.back().triangle_count;
  }
  model.positions = std::move(mesh.positions);
  model.triangles = std::move(mesh.triangles);
  model.uvs = std::move(mesh.uvs);
  if (!model.uvs.empty()) {
    model.uv_triangles = model.triangles;
  }
  for (std::size_t i = 0; i + 2 < mesh.colors.size(); i += 3) {
    model.colors.push_back({mesh.colors[i], mesh.colors[i + 1], mesh.colors[i + 2]});
  }
  if (!model.colors.empty()) mark_colored(model);
  model.normals = std::move(mesh.normals);
  if (!model.normals.empty()) {
    model.normal_triangles = model.triangles;
  }
  return model;
}

ErrorCode code_of(semblante_result result) {
  switch (result) {
    case SEMBLANTE_MISMATCH:
      return ErrorCode::mismatch;
    case SEMBLANTE_UNSUPPORTED:
      return ErrorCode::unsupported;
    case SEMBLANTE_TOO_LARGE:
      return ErrorCode::too_large;
    case SEMBLANTE_INTERNAL:
    case SEMBLANTE_OUT_OF_MEMORY:
      return ErrorCode::internal;
    default:
      return ErrorCode::malformed;
  }
}

}  // namespace

Result<Face> Face::create(const PackageBytes& bytes) {
  auto rig = read_rig(bytes.rig_json);
  if (!rig) {
    Error error = std::move(rig).error();
    error.where = "rig.json" + error.where;
    return error;
  }
  const Sha256 mesh_hash = runtime::sha256(as_bytes(bytes.mesh_drc));
  if (mesh_hash != rig->mesh.sha256) {
    return Error{ErrorCode::mismatch, "mesh.drc", "the SHA-256 differs from the one in rig.json"};
  }
  auto mesh = runtime::decode_mesh(as_bytes(bytes.mesh_drc), rig->mesh);
  if (!mesh) {
    return std::move(mesh).error();
  }
  semblante_package package{};
  package.size = sizeof(package);
  package.positions = &mesh->positions[0].x;
  package.vertex_count = static_cast<std::uint32_t>(mesh->positions.size());
  package.mesh_sha256 = mesh_hash.data();
  package.weights = as_bytes(bytes.weights).data();
  package.weights_size = bytes.weights.size();
  package.rig_json = bytes.rig_json.data();
  package.rig_json_size = bytes.rig_json.size();
  semblante_head* head = nullptr;
  semblante_error error{};
  const semblante_result result = semblante_head_create(&package, nullptr, &head, &error);
  if (result != SEMBLANTE_OK) {
    return Error{code_of(result), error.where, error.message};
  }
  Face face;
  face.head_.reset(head);
  auto model = to_model(*std::move(mesh), *rig);
  if (!model) {
    return std::move(model).error();
  }
  face.model_ = *std::move(model);
  face.rig_ = *std::move(rig);
  const semblante_face* table = semblante_head_face(head);
  face.roles_.assign(face.model_.positions.size(), PartRole::rest);
  for (std::size_t v = 0; v < face.roles_.size(); ++v) {
    const auto motion = static_cast<RigidMotion>(table->rigid[v]);
    face.roles_[v] = is_left_eye(motion)             ? PartRole::left_eye
                     : is_eye(motion)                ? PartRole::right_eye
                     : motion == RigidMotion::tongue ? PartRole::tongue
                                                     : PartRole::rest;
  }
  return face;
}

FeaturePointSet Face::feature_points() const {
  FeaturePointSet points;
  for (const RigDocument::Point& point : rig_.feature_points) {
    FeaturePoint to{point.id, std::nullopt, point.position};
    if (point.vertex) {
      to.vertex = VertexId(*point.vertex);
    }
    points.push_back(to);
  }
  return points;
}

void Face::play_by(const Header& header) const {
  // Cannot fail: both readers check the range 0..1.
  static_cast<void>(semblante_head_set_viseme_share(
      head_.get(), static_cast<float>(header.viseme_share.value_or(rig_.viseme_share))));
}

std::vector<glm::vec3> Face::positions() const {
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  std::vector<glm::vec3> positions(model_.positions.size());
  // Cannot fail: the buffer has the head's size.
  static_cast<void>(semblante_head_positions(head_.get(), &positions[0].x, positions.size() * 3));
  return positions;
}

Result<PackageBytes> fetch_package(const HttpClient& http, std::string_view model, const LevelChoice& level) {
  const std::string query = level.lod            ? "?lod=" + std::to_string(*level.lod)
                            : level.max_vertices ? "?max_vertices=" + std::to_string(*level.max_vertices)
                                                 : "";
  const std::string base = "/v1/models/" + escape_segment(model);
  PackageBytes bytes;
  auto rig_json = http.fetch(base + "/rig.json" + query, max_rig_bytes);
  if (!rig_json) {
    return std::move(rig_json).error();
  }
  bytes.rig_json = *std::move(rig_json);
  const auto rig = read_rig(bytes.rig_json);
  if (!rig) {
    return Error{rig.error().code, "rig.json" + rig.error().where, rig.error().message};
  }
  if (rig->mesh.bytes > max_mesh_bytes || rig->weights.bytes > max_mesh_bytes) {
    return Error{ErrorCode::too_large, "rig.json", "declares a mesh or weights of more than 128 MiB"};
  }
  auto mesh_drc = http.fetch(base + "/mesh.drc" + query, rig->mesh.bytes);
  if (!mesh_drc) {
    return std::move(mesh_drc).error();
  }
  auto weights = http.fetch(base + "/weights" + query, rig->weights.bytes);
  if (!weights) {
    return std::move(weights).error();
  }
  bytes.mesh_drc = *std::move(mesh_drc);
  bytes.weights = *std::move(weights);
  return bytes;
}

std::vector<std::string> fetch_images(const HttpClient& http, Face& face) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < face.rig().images.size(); ++i) {
    const RigDocument::ImageInfo& info = face.rig().images[i];
    auto bytes = http.fetch("/v1/artefacts/" + to_hex(info.sha256), std::min(info.bytes, max_image_bytes));
    if (!bytes) {
      warnings.push_back("image " + std::to_string(i) + ": " + bytes.error().message);
    } else if (runtime::sha256(as_bytes(*bytes)) != info.sha256) {
      warnings.push_back("image " + std::to_string(i) + ": the SHA-256 differs from the one in rig.json");
    } else {
      face.model().images[i] = {info.mime_type, {bytes->begin(), bytes->end()}};
    }
  }
  return warnings;
}

Result<Face> load_face(const HttpClient& http, std::string_view model, const LevelChoice& level) {
  for (bool again : {true, false}) {
    auto bytes = fetch_package(http, model, level);
    auto face = bytes ? Face::create(*bytes) : Result<Face>(bytes.error());
    if (face || !again || face.error().code != ErrorCode::mismatch) {
      return face;
    }
  }
  return Error{ErrorCode::mismatch, std::string(model), "the files of the package do not belong together"};
}

}  // namespace semblante::client
