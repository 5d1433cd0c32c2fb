#include "tests/bench/kernel/bench_head.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <span>

#include "core/draco/draco_mesh.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/place_feature_points.h"
#include "protocol/cpp/weights_format.h"
#include "protocol/package/mesh_encoding.h"
#include "protocol/package/package.h"
#include "tests/oracle/real_heads.h"
#include "tests/support/sample_head_model.h"

namespace semblante::bench {
namespace {

template <class T>
T taken(Result<T> result) {
  if (result) return *std::move(result);
  std::fprintf(stderr, "bench_kernel: %s %s\n", result.error().where.c_str(), result.error().message.c_str());
  std::exit(1);
}

/// Cuts the triangles of one index array into four about the middles of their edges. Middles are shared.
template <class Point>
void cut(std::vector<Point>& points, std::vector<Triangle>& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    if (a == Model::no_index || b == Model::no_index) return Model::no_index;
    const auto [at, made] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
    if (made) points.push_back(0.5F * (points[a] + points[b]));
    return at->second;
  };
  std::vector<Triangle> parts;
  parts.reserve(triangles.size() * 4);
  for (const auto& [a, b, c] : triangles) {
    const std::uint32_t ab = middle(a, b);
    const std::uint32_t bc = middle(b, c);
    const std::uint32_t ca = middle(c, a);
    parts.insert(parts.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  triangles = std::move(parts);
}

BenchHead head_of(std::string name, const Model& model, const Surface& surface, const FeaturePointSet& points,
                  WeightMethod method) {
  ParametrizeOptions options;
  options.weights = method;
  const Rig rig = taken(parametrize(model, surface, points, options));
  const FacePackage package = taken(build_package(model, surface, rig, {}));
  const DracoMesh mesh = taken(DracoMesh::decode(package.mesh_drc.bytes));
  InfluenceTable table = taken(decode_weights(package.weights.bytes));

  BenchHead head;
  head.name = std::move(name);
  head.rig = make_kernel_rig(rig);
  head.rest = taken(mesh.floats(MeshAttributeIds{}.position, 3));
  head.offsets = std::move(table.rows.offsets);
  for (const FeaturePointId id : table.rows.points) head.points.push_back(id.value());
  head.weights = std::move(table.rows.weights);
  head.rigid = std::move(table.rigid);
  head.turn = std::move(table.turn);
  if (head.turn.empty()) head.turn.assign(head.rigid.size(), SEMBLANTE_TURN_FULL);
  head.triangles = mesh.triangles();
  return head;
}

}  // namespace

semblante_face BenchHead::face() const {
  semblante_face face{};
  face.vertex_count = vertex_count();
  face.rest = rest.data();
  face.row_offsets = offsets.data();
  face.row_points = points.data();
  face.row_weights = weights.data();
  face.rigid = rigid.data();
  face.turn = turn.data();
  return face;
}

BenchHead sample_bench_head(WeightMethod method, unsigned cuts) {
  Model model = testing::sample_head_model();
  for (unsigned i = 0; i < cuts; ++i) {
    cut(model.positions, model.triangles);
    cut(model.uvs, model.uv_triangles);
    cut(model.normals, model.normal_triangles);
    for (Primitive& primitive : model.primitives) {
      primitive.first_triangle *= 4;
      primitive.triangle_count *= 4;
    }
  }
  return head_of("sample head", model, build_surface(model), testing::sample_head_points(), method);
}

std::vector<BenchHead> real_bench_heads(WeightMethod method) {
  std::vector<BenchHead> heads;
  const auto faces = oracle::faces_folder();
  if (!faces) return heads;
  const auto add = [&](const char* name, const char* file, const char* points) {
    const Model model = oracle::import_head(*faces / name / file);
    const Surface surface = build_surface(model);
    const auto placed =
        taken(place_feature_points(model, surface, oracle::read_trusted_points(*faces / name / points), nullptr));
    heads.push_back(head_of(name, model, surface, placed, method));
  };
  add("ict-facekit", "neutral.obj", "ict-facekit.fps.json");
  add("makehuman", "head.glb", "makehuman.fps.json");
  return heads;
}

semblante_pose talking_pose(const BenchHead& head, bool head_and_eyes) {
  semblante_frame frame{};
  frame.viseme1 = 10;
  frame.viseme_blend = SEMBLANTE_BLEND_MAX;
  frame.expression1 = 1;
  frame.intensity1 = 40;
  frame.fap[31] = 200.0F;
  if (head_and_eyes) {
    frame.fap[23] = frame.fap[24] = 9000.0F;
    frame.fap[48] = 5000.0F;
    frame.fap[49] = -15000.0F;
  }
  const semblante_rig rig = head.rig.view();
  semblante_pose pose{};
  semblante_evaluate(&rig, &frame, &pose);
  return pose;
}

void write_bench_head(const BenchHead& head, const std::string& file) {
  std::ofstream out(file, std::ios::binary);
  const auto put = [&](const void* from, std::size_t bytes) {
    out.write(static_cast<const char*>(from), static_cast<std::streamsize>(bytes));
  };
  const std::uint32_t counts[3] = {head.vertex_count(), static_cast<std::uint32_t>(head.points.size()),
                                   static_cast<std::uint32_t>(head.triangles.size())};
  put("SBH2", 4);
  put(counts, sizeof counts);
  put(head.rest.data(), head.rest.size() * 4);
  put(head.offsets.data(), head.offsets.size() * 4);
  put(head.weights.data(), head.weights.size() * 4);
  put(head.triangles.data(), head.triangles.size() * 12);
  const semblante_pose pose = talking_pose(head, true);
  put(&pose, sizeof pose);
  put(head.points.data(), head.points.size());
  put(head.rigid.data(), head.rigid.size());
  put(head.turn.data(), head.turn.size());
}

}  // namespace semblante::bench
