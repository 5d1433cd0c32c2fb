#include <algorithm>
#include <memory>
#include <optional>
#include <span>

#include "clients/runtime/border.h"
#include "clients/runtime/face_mesh.h"
#include "clients/runtime/head.h"
#include "clients/runtime/sha256.h"
#include "protocol/cpp/rig_document.h"

namespace semblante::runtime {
namespace {

/// Triangles that a package may have, given the greatest number of its vertices.
constexpr std::size_t max_triangles = std::size_t{3} * max_weights_vertices;

/// The mesh of a package in the caller's memory, or decoded from its bytes.
struct Mesh {
  std::size_t vertices = 0;
  std::span<const float> positions, normals, uvs;
  std::span<const std::uint32_t> corners;
};

void fill_rig(semblante_head& head, const RigDocument& document, const semblante_head_options& options) {
  head.kernel = to_kernel_rig(document);
  head.rig = head.kernel.view();
  if (options.viseme_share > 0.0F) head.rig.viseme_share = options.viseme_share;
  if (options.jaw_takes_lip != 0) head.rig.lip_share = 1.0F;
}

void fill_face(semblante_head& head, bool computes_vertices) {
  head.points.reserve(head.table.rows.points.size());
  for (const FeaturePointId id : head.table.rows.points) head.points.push_back(id.value());
  head.face.vertex_count = head.table.vertex_count;
  head.face.rest = head.rest.empty() ? nullptr : head.rest.data();
  head.face.row_offsets = head.table.rows.offsets.data();
  head.face.row_points = head.points.data();
  head.face.row_weights = head.table.rows.weights.data();
  head.face.rigid = head.table.rigid.data();
  head.face.turn = head.table.turn.empty() ? nullptr : head.table.turn.data();
  if (!computes_vertices) return;
  // Cannot be 0: decode_weights refuses rows whose points are not rising.
  head.prepared_memory.reset(::operator new (semblante_prepared_size(&head.face), std::align_val_t{64}));
  head.prepared = semblante_prepare_for(&head.face, &head.rig, head.prepared_memory.get());
}

void fill_triangles(semblante_head& head, const Mesh& mesh, bool computes_vertices) {
  if (mesh.corners.empty()) return;
  head.corners.assign(mesh.corners.begin(), mesh.corners.end());
  const auto vertices = static_cast<std::uint32_t>(mesh.vertices);
  head.triangles = {vertices, static_cast<std::uint32_t>(head.corners.size() / 3), head.corners.data(), nullptr};
  if (mesh.normals.empty() || mesh.positions.empty() || !computes_vertices) return;
  head.joined.resize(vertices);
  std::vector<std::uint32_t> scratch(semblante_join_scratch(vertices));
  semblante_join_seams(vertices, mesh.positions.data(), mesh.normals.data(), scratch.data(), head.joined.data());
  head.triangles.joined = head.joined.data();
  head.own_normals.assign(mesh.normals.begin(), mesh.normals.end());
  head.rest_normals.resize(head.own_normals.size());
  semblante_rest_normals(&head.triangles, mesh.positions.data(), head.own_normals.data(), head.rest_normals.data());
}

semblante_result check_triangles(const semblante_package& package, semblante_error* error) {
  if (package.triangles == nullptr && package.normals == nullptr && package.triangle_count == 0) return SEMBLANTE_OK;
  if (package.triangles == nullptr || package.normals == nullptr) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "package.triangles", "triangles and normals must be given together");
  }
  if (package.triangle_count > max_triangles) {
    return fail(error, SEMBLANTE_TOO_LARGE, "package.triangle_count", "more than 12 million triangles");
  }
  const std::span corners(package.triangles, std::size_t{package.triangle_count} * 3);
  if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t v) { return v >= package.vertex_count; })) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "package.triangles", "a corner is not the number of a vertex");
  }
  if (!all_finite({package.normals, std::size_t{package.vertex_count} * 3})) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "package.normals", "a normal is not a finite number");
  }
  return SEMBLANTE_OK;
}

/// Of a mesh that the caller decoded.
semblante_result check_mesh(const semblante_package& package, const semblante_head_options& options,
                            semblante_error* error) {
  if (package.vertex_count == 0) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "package.vertex_count", "a head must have at least one vertex");
  }
  if (package.vertex_count > max_weights_vertices) {
    return fail(error, SEMBLANTE_TOO_LARGE, "package.vertex_count", "more than 4 million vertices");
  }
  if (package.positions == nullptr && (options.flags & SEMBLANTE_HEAD_NO_VERTICES) == 0) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "package.positions", "neither positions nor mesh_drc are given");
  }
  if (package.positions != nullptr && !all_finite({package.positions, std::size_t{package.vertex_count} * 3})) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "package.positions", "a position is not a finite number");
  }
  return check_triangles(package, error);
}

semblante_result check_arguments(const semblante_package& package, const semblante_head_options& options,
                                 semblante_error* error) {
  if (package.weights == nullptr || package.rig_json == nullptr) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "package", "weights and rig_json must be given");
  }
  if ((options.flags & ~SEMBLANTE_HEAD_NO_VERTICES) != 0) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "options.flags", "an unknown flag");
  }
  if (!(options.viseme_share >= 0.0F && options.viseme_share <= 1.0F)) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "options.viseme_share", "the share must be 0 to 1");
  }
  if (package.mesh_drc == nullptr) return check_mesh(package, options, error);
  if (package.vertex_count != 0 || package.positions != nullptr || package.mesh_sha256 != nullptr ||
      package.triangles != nullptr || package.normals != nullptr || package.triangle_count != 0) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "package.mesh_drc", "the mesh is given both decoded and as bytes");
  }
  return SEMBLANTE_OK;
}

Mesh given_mesh(const semblante_package& package) {
  const std::size_t numbers = std::size_t{package.vertex_count} * 3;
  Mesh mesh;
  mesh.vertices = package.vertex_count;
  if (package.positions != nullptr) mesh.positions = {package.positions, numbers};
  if (package.triangles != nullptr) {
    mesh.normals = {package.normals, numbers};
    mesh.corners = {package.triangles, std::size_t{package.triangle_count} * 3};
  }
  return mesh;
}

Mesh decoded_mesh(const FaceMesh& decoded) {
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float) && sizeof(Triangle) == 3 * sizeof(std::uint32_t));
  const auto floats = [](const auto& vectors) {
    return vectors.empty() ? std::span<const float>()
                           : std::span(&vectors[0].x, vectors.size() * (sizeof(vectors[0]) / sizeof(float)));
  };
  return {decoded.positions.size(),
          floats(decoded.positions),
          floats(decoded.normals),
          floats(decoded.uvs),
          {decoded.triangles[0].data(), decoded.triangles.size() * 3}};
}

semblante_result check_pairing(const Sha256* mesh_hash, std::size_t vertices, const semblante_package& package,
                               const InfluenceTable& table, const RigDocument& document, semblante_error* error) {
  const auto mismatch = [&](const char* where, const char* message) {
    return fail(error, SEMBLANTE_MISMATCH, where, message);
  };
  if (table.vertex_count != vertices) {
    return mismatch("weights", "the weight table has a different number of vertices than the mesh");
  }
  if (document.mesh.vertices != vertices) {
    return mismatch("rig.json", "the rig belongs to a mesh with a different number of vertices");
  }
  if (document.mesh.sha256 != table.mesh_sha256) {
    return mismatch("weights", "the weight table and the rig refer to different meshes");
  }
  if (mesh_hash != nullptr && *mesh_hash != table.mesh_sha256) {
    return mismatch("weights", "the weight table belongs to another mesh.drc");
  }
  if (sha256({package.weights, package.weights_size}) != document.weights.sha256) {
    return mismatch("weights", "the SHA-256 differs from the one in rig.json");
  }
  return SEMBLANTE_OK;
}

semblante_result create(const semblante_package& package, const semblante_head_options& options,
                        std::unique_ptr<semblante_head>& made, semblante_error* error) {
  auto table = decode_weights({package.weights, package.weights_size});
  if (!table) return fail(error, table.error(), "weights/");
  auto document = read_rig({package.rig_json, package.rig_json_size});
  if (!document) return fail(error, document.error(), "rig.json");

  std::optional<Sha256> mesh_hash;
  FaceMesh decoded;
  Mesh mesh;
  if (package.mesh_drc != nullptr) {
    const std::span bytes(package.mesh_drc, package.mesh_drc_size);
    mesh_hash = sha256(bytes);
    if (*mesh_hash != document->mesh.sha256) {
      return fail(error, SEMBLANTE_MISMATCH, "mesh.drc", "the SHA-256 differs from the one in rig.json");
    }
    auto read = decode_mesh(bytes, document->mesh);
    if (!read) return fail(error, read.error());
    decoded = *std::move(read);
    mesh = decoded_mesh(decoded);
  } else {
    mesh = given_mesh(package);
    if (package.mesh_sha256 != nullptr) std::copy_n(package.mesh_sha256, 32, mesh_hash.emplace().begin());
  }
  const semblante_result paired =
      check_pairing(mesh_hash ? &*mesh_hash : nullptr, mesh.vertices, package, *table, *document, error);
  if (paired != SEMBLANTE_OK) return paired;

  const bool computes_vertices = (options.flags & SEMBLANTE_HEAD_NO_VERTICES) == 0;
  made = std::make_unique<semblante_head>();
  made->rest.assign(mesh.positions.begin(), mesh.positions.end());
  made->uvs.assign(mesh.uvs.begin(), mesh.uvs.end());
  made->colors = std::move(decoded.colors);
  made->table = *std::move(table);
  fill_rig(*made, *document, options);
  fill_face(*made, computes_vertices);
  fill_triangles(*made, mesh, computes_vertices);
  const semblante_frame neutral{};
  semblante_evaluate(&made->rig, &neutral, &made->pose);
  return SEMBLANTE_OK;
}

}  // namespace
}  // namespace semblante::runtime

using namespace semblante::runtime;

extern "C" {

semblante_result semblante_head_create(const semblante_package* package, const semblante_head_options* options,
                                       semblante_head** head, semblante_error* error) {
  if (head == nullptr) return fail(error, SEMBLANTE_INVALID_ARGUMENT, "head", "the pointer for the new head is null");
  *head = nullptr;
  semblante_package parts;
  semblante_head_options chosen;
  if (package == nullptr || !read_struct(package, parts)) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "package", "is null, or its size is not set");
  }
  if (!read_struct(options, chosen)) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "options", "its size is not set");
  }
  return guarded(error, [&] {
    if (const semblante_result checked = check_arguments(parts, chosen, error); checked != SEMBLANTE_OK) return checked;
    std::unique_ptr<semblante_head> made;
    const semblante_result result = create(parts, chosen, made, error);
    *head = made.release();
    return result;
  });
}

void semblante_head_destroy(semblante_head* head) { delete head; }

}  // extern "C"
