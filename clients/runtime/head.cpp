#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <string_view>
#include <vector>

#include "clients/runtime/copy_text.h"
#include "clients/runtime/semblante.h"
#include "protocol/cpp/rig_document.h"
#include "protocol/cpp/rig_kernel.h"
#include "protocol/cpp/weights_format.h"

namespace {
struct FreeAligned {
  void operator()(void* memory) const { ::operator delete (memory, std::align_val_t{64}); }
};
}  // namespace

/// Owned by the caller through the opaque handle. `rig` and `face` point into the vectors beside them.
struct semblante_head {
  std::vector<float> rest;
  semblante::KernelRig kernel;
  semblante::InfluenceTable table;
  std::vector<std::uint8_t> points;
  semblante_rig rig{};
  semblante_face face{};
  semblante_pose pose{};
  std::unique_ptr<void, FreeAligned> prepared_memory;
  const semblante_prepared_face* prepared = nullptr;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> joined;  ///< empty: the package had no triangles
  semblante_triangles triangles{};
};

namespace {

using semblante::runtime::copy_text;

using semblante::ErrorCode;
using semblante::RigDocument;

semblante_result fail(semblante_error* error, semblante_result result, std::string_view where,
                      std::string_view message) {
  if (error != nullptr) {
    copy_text(error->where, where);
    copy_text(error->message, message);
  }
  return result;
}

semblante_result result_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::unsupported:
      return SEMBLANTE_UNSUPPORTED;
    case ErrorCode::mismatch:
      return SEMBLANTE_MISMATCH;
    case ErrorCode::too_large:
      return SEMBLANTE_TOO_LARGE;
    case ErrorCode::internal:
    case ErrorCode::io:
    case ErrorCode::cancelled:
      return SEMBLANTE_INTERNAL;
    default:
      return SEMBLANTE_MALFORMED;
  }
}

bool all_finite(std::span<const float> values) {
  return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

bool is_finite(const semblante_frame& frame) { return all_finite(frame.fap); }

bool is_finite(const semblante_pose& pose) {
  // All members are floats without padding, so the struct reads as one array.
  static_assert(sizeof(semblante_pose) % sizeof(float) == 0);
  std::array<float, sizeof(semblante_pose) / sizeof(float)> values{};
  std::memcpy(values.data(), &pose, sizeof(pose));
  return all_finite(values);
}

void fill_rig(semblante_head& head, const RigDocument& document, const semblante_head_options* options) {
  head.kernel = semblante::to_kernel_rig(document);
  head.rig = head.kernel.view();
  if (options != nullptr && options->viseme_share > 0.0F) head.rig.viseme_share = options->viseme_share;
  if (options != nullptr && options->jaw_takes_lip != 0) head.rig.lip_share = 1.0F;
}

void fill_face(semblante_head& head) {
  head.points.reserve(head.table.rows.points.size());
  for (const semblante::FeaturePointId id : head.table.rows.points) {
    head.points.push_back(id.value());
  }
  head.face.vertex_count = head.table.vertex_count;
  head.face.rest = head.rest.data();
  head.face.row_offsets = head.table.rows.offsets.data();
  head.face.row_points = head.points.data();
  head.face.row_weights = head.table.rows.weights.data();
  head.face.rigid = head.table.rigid.data();
  head.face.turn = head.table.turn.empty() ? nullptr : head.table.turn.data();
  // Cannot be 0: decode_weights refuses rows whose points are not rising.
  head.prepared_memory.reset(::operator new (semblante_prepared_size(&head.face), std::align_val_t{64}));
  head.prepared = semblante_prepare(&head.face, head.prepared_memory.get());
}

void fill_triangles(semblante_head& head, const semblante_package& package) {
  if (package.triangles == nullptr) {
    return;
  }
  head.corners.assign(package.triangles, package.triangles + std::size_t{package.triangle_count} * 3);
  head.joined.resize(package.vertex_count);
  std::vector<std::uint32_t> scratch(semblante_join_scratch(package.vertex_count));
  semblante_join_seams(package.vertex_count, package.positions, package.normals, scratch.data(), head.joined.data());
  head.triangles = {package.vertex_count, package.triangle_count, head.corners.data(), head.joined.data()};
}

semblante_result check_triangles(const semblante_package& package, semblante_error* error) {
  if (package.triangles == nullptr && package.normals == nullptr && package.triangle_count == 0) {
    return SEMBLANTE_OK;
  }
  if (package.triangles == nullptr || package.normals == nullptr) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "package.triangles", "triangles and normals must be given together");
  }
  if (package.triangle_count > 3 * semblante::max_weights_vertices) {
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

semblante_result check_pairing(const semblante_package& package, const semblante::InfluenceTable& table,
                               const RigDocument& document, semblante_error* error) {
  if (table.vertex_count != package.vertex_count) {
    return fail(error, SEMBLANTE_MISMATCH, "weights",
                "the weight table has a different number of vertices than the mesh");
  }
  if (document.mesh.vertices != package.vertex_count) {
    return fail(error, SEMBLANTE_MISMATCH, "rig.json", "the rig belongs to a mesh with a different number of vertices");
  }
  if (document.mesh.sha256 != table.mesh_sha256) {
    return fail(error, SEMBLANTE_MISMATCH, "weights", "the weight table and the rig refer to different meshes");
  }
  if (package.mesh_sha256 != nullptr &&
      !std::equal(table.mesh_sha256.begin(), table.mesh_sha256.end(), package.mesh_sha256)) {
    return fail(error, SEMBLANTE_MISMATCH, "weights", "the weight table belongs to another mesh.drc");
  }
  return SEMBLANTE_OK;
}

semblante_result check_arguments(const semblante_package* package, const semblante_head_options* options,
                                 semblante_error* error) {
  if (package == nullptr || package->positions == nullptr || package->weights == nullptr ||
      package->rig_json == nullptr) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "package", "positions, weights and rig_json must be given");
  }
  if (package->vertex_count == 0) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "package.vertex_count", "a head must have at least one vertex");
  }
  if (package->vertex_count > semblante::max_weights_vertices) {
    return fail(error, SEMBLANTE_TOO_LARGE, "package.vertex_count", "more than 4 million vertices");
  }
  if (!all_finite({package->positions, std::size_t{package->vertex_count} * 3})) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "package.positions", "a position is not a finite number");
  }
  if (options != nullptr && !(options->viseme_share >= 0.0F && options->viseme_share <= 1.0F)) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "options.viseme_share", "the share must be 0 to 1");
  }
  return check_triangles(*package, error);
}

semblante_result create(const semblante_package& package, const semblante_head_options* options,
                        std::unique_ptr<semblante_head>& made, semblante_error* error) {
  auto table = semblante::decode_weights({package.weights, package.weights_size});
  if (!table) {
    return fail(error, result_of(table.error().code), "weights" + table.error().where, table.error().message);
  }
  auto document = semblante::read_rig({package.rig_json, package.rig_json_size});
  if (!document) {
    return fail(error, result_of(document.error().code), "rig.json" + document.error().where, document.error().message);
  }
  if (const semblante_result paired = check_pairing(package, *table, *document, error); paired != SEMBLANTE_OK) {
    return paired;
  }
  made = std::make_unique<semblante_head>();
  made->rest.assign(package.positions, package.positions + std::size_t{package.vertex_count} * 3);
  made->table = *std::move(table);
  fill_rig(*made, *document, options);
  fill_face(*made);
  fill_triangles(*made, package);
  const semblante_frame neutral{};
  semblante_evaluate(&made->rig, &neutral, &made->pose);
  return SEMBLANTE_OK;
}

}  // namespace

extern "C" {

uint32_t semblante_sdk_version(void) { return SEMBLANTE_SDK_VERSION; }

const char* semblante_result_name(semblante_result result) {
  switch (result) {
    case SEMBLANTE_OK:
      return "ok";
    case SEMBLANTE_INVALID_ARGUMENT:
      return "invalid argument";
    case SEMBLANTE_MALFORMED:
      return "malformed";
    case SEMBLANTE_UNSUPPORTED:
      return "unsupported";
    case SEMBLANTE_MISMATCH:
      return "mismatch";
    case SEMBLANTE_TOO_LARGE:
      return "too large";
    case SEMBLANTE_BUFFER_TOO_SMALL:
      return "buffer too small";
    case SEMBLANTE_OUT_OF_MEMORY:
      return "out of memory";
    case SEMBLANTE_INTERNAL:
      return "internal";
  }
  return "unknown";
}

semblante_result semblante_head_create(const semblante_package* package, const semblante_head_options* options,
                                       semblante_head** head, semblante_error* error) {
  if (head == nullptr) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "head", "the pointer for the new head is null");
  }
  *head = nullptr;
  // JSON and containers throw; no exception may cross the C boundary.
  try {
    if (const semblante_result checked = check_arguments(package, options, error); checked != SEMBLANTE_OK) {
      return checked;
    }
    std::unique_ptr<semblante_head> made;
    const semblante_result result = create(*package, options, made, error);
    *head = made.release();
    return result;
  } catch (const std::bad_alloc&) {
    return fail(error, SEMBLANTE_OUT_OF_MEMORY, "", "not enough memory for this head");
  } catch (...) {
    return fail(error, SEMBLANTE_INTERNAL, "", "unexpected error inside the SDK");
  }
}

void semblante_head_destroy(semblante_head* head) { delete head; }

uint32_t semblante_head_vertex_count(const semblante_head* head) {
  return head == nullptr ? 0 : head->face.vertex_count;
}

const semblante_rig* semblante_head_rig(const semblante_head* head) { return head == nullptr ? nullptr : &head->rig; }

const semblante_face* semblante_head_face(const semblante_head* head) {
  return head == nullptr ? nullptr : &head->face;
}

semblante_result semblante_head_set_viseme_share(semblante_head* head, float viseme_share) {
  if (head == nullptr || !(viseme_share >= 0.0F && viseme_share <= 1.0F)) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  head->rig.viseme_share = viseme_share;
  return SEMBLANTE_OK;
}

semblante_result semblante_head_set_frame(semblante_head* head, const semblante_frame* frame) {
  if (head == nullptr || frame == nullptr || !is_finite(*frame)) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  semblante_evaluate(&head->rig, frame, &head->pose);
  return SEMBLANTE_OK;
}

semblante_result semblante_head_set_interpolated(semblante_head* head, const semblante_frame* from,
                                                 const semblante_frame* to, float t) {
  if (head == nullptr || from == nullptr || to == nullptr || !std::isfinite(t) || !is_finite(*from) ||
      !is_finite(*to)) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  semblante_pose first;
  semblante_pose second;
  semblante_evaluate(&head->rig, from, &first);
  semblante_evaluate(&head->rig, to, &second);
  semblante_interpolate(&first, &second, t, &head->pose);
  return SEMBLANTE_OK;
}

semblante_result semblante_head_get_pose(const semblante_head* head, semblante_pose* pose) {
  if (head == nullptr || pose == nullptr) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  *pose = head->pose;
  return SEMBLANTE_OK;
}

semblante_result semblante_head_set_pose(semblante_head* head, const semblante_pose* pose) {
  if (head == nullptr || pose == nullptr || !is_finite(*pose)) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  head->pose = *pose;
  return SEMBLANTE_OK;
}

semblante_result semblante_head_positions(const semblante_head* head, float* positions, size_t capacity) {
  if (head == nullptr || positions == nullptr) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  if (capacity < std::size_t{head->face.vertex_count} * 3) {
    return SEMBLANTE_BUFFER_TOO_SMALL;
  }
  semblante_deform_prepared(head->prepared, &head->pose, positions);
  return SEMBLANTE_OK;
}

semblante_result semblante_head_update_positions(const semblante_head* head, const semblante_pose* before,
                                                 float* positions, size_t capacity) {
  if (head == nullptr || before == nullptr || positions == nullptr || !is_finite(*before)) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  if (capacity < std::size_t{head->face.vertex_count} * 3) {
    return SEMBLANTE_BUFFER_TOO_SMALL;
  }
  semblante_deform_changed(head->prepared, before, &head->pose, positions);
  return SEMBLANTE_OK;
}

semblante_result semblante_head_normals(const semblante_head* head, const float* positions, float* normals,
                                        size_t capacity) {
  if (head == nullptr || positions == nullptr || normals == nullptr || head->joined.empty()) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  if (capacity < std::size_t{head->face.vertex_count} * 3) {
    return SEMBLANTE_BUFFER_TOO_SMALL;
  }
  semblante_normals(&head->triangles, positions, normals);
  return SEMBLANTE_OK;
}

}  // extern "C"
