// The loop of every frame beside a plain one, a sparse matrix product and the speed of memory.
//   bench_kernel [SECONDS]        our own head in three sizes with both kinds of weights, and the real heads
//   bench_kernel --write DIR      those heads as files for bench_wasm.mjs
//   bench_kernel --time FILE      seconds a frame of such a file, by the fastest variant

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Sparse>

#include "tests/bench/kernel/baselines.h"
#include "tests/bench/kernel/bench_head.h"
#include "tests/support/prepared_face.h"

namespace semblante::bench {
namespace {

using testing::Prepared;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Bytes that a frame reads of a prepared face.
std::size_t read_bytes(const semblante_prepared_face& face) {
  std::size_t points = 0;
  for (std::uint32_t r = 0; r < face.run_count; ++r) {
    points += std::size_t{face.runs[r].group_count} * face.runs[r].point_count;
  }
  return points * (face.group_size * sizeof(float) + 1) + face.run_count * sizeof(semblante_run) +
         face.group_count * (face.group_size * 3 * sizeof(float) + sizeof(std::uint32_t));
}

struct Way {
  std::string name;
  std::function<void()> frame;
  double best = std::numeric_limits<double>::infinity();
};

/// Each way once untimed and once timed, in turn, until the time is up: noise of a busy machine hits all alike, and
/// the best of many is near what a quiet one would give.
void race(std::vector<Way>& ways, double seconds) {
  for (const double end = now() + seconds; now() < end;) {
    for (Way& way : ways) {
      way.frame();
      const double begin = now();
      way.frame();
      way.best = std::min(way.best, now() - begin);
    }
  }
}

using Sparse = Eigen::SparseMatrix<float, Eigen::RowMajor>;
using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

Sparse matrix_of(const BenchHead& head) {
  std::vector<Eigen::Triplet<float>> entries;
  for (std::uint32_t v = 0; v < head.vertex_count(); ++v) {
    for (std::uint32_t k = head.offsets[v]; k < head.offsets[v + 1]; ++k) {
      entries.emplace_back(v, head.points[k], head.weights[k]);
    }
  }
  Sparse matrix(head.vertex_count(), SEMBLANTE_FP_COUNT);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// The plain loop against semblante_deform, which tests compare with the equations; it does not slide lids.
void check_scalar(const BenchHead& head, const std::vector<float>& scalar, const std::vector<float>& expected) {
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const bool slides =
        head.rigid[i / 3] == SEMBLANTE_RIGID_LEFT_LIDS || head.rigid[i / 3] == SEMBLANTE_RIGID_RIGHT_LIDS;
    if (!slides && !(std::abs(scalar[i] - expected[i]) <= 1e-4F * (1.0F + std::abs(expected[i])))) {
      std::printf("scalar is WRONG at vertex %zu\n", i / 3);
      return;
    }
  }
}

void print_row(const BenchHead& head, const char* method, double seconds) {
  const semblante_face face = head.face();
  const semblante_rig rig = head.rig.view();
  const Prepared eights(face, 8, &rig);
  const Prepared widest(face, &rig);
  std::uint32_t count = 0;
  const semblante_deform_variant* const variants = semblante_deform_variants(&count);
  const semblante_pose pose = talking_pose(head, true);
  const semblante_pose still = talking_pose(head, false);
  const semblante_pose neutral = [] {
    semblante_pose p{};
    p.head_rotation[3] = p.eye_rotation[0][3] = p.eye_rotation[1][3] = 1.0F;
    return p;
  }();
  std::vector<float> expected(head.rest.size());
  std::vector<float> out(head.rest.size() + 16);
  semblante_deform(&face, &pose, expected.data());

  const Sparse matrix = matrix_of(head);
  const Eigen::Map<const Rows> displacements(pose.fp, SEMBLANTE_FP_COUNT, 3);
  const Eigen::Map<const Rows> rest(head.rest.data(), head.vertex_count(), 3);
  Rows product(head.vertex_count(), 3);

  const std::size_t written = head.rest.size() * sizeof(float);
  volatile std::uint64_t sink = 0;
  std::vector<Way> ways;
  ways.push_back({"limit", [&] {
                    sink = sink + stream(static_cast<const std::byte*>(eights.memory.get()), read_bytes(*eights.face),
                                         reinterpret_cast<std::byte*>(out.data()), written);
                  }});
  ways.push_back({"scalar", [&] { scalar_deform(face, pose, out.data()); }});
  ways.push_back({"Eigen", [&] {
                    product.noalias() = matrix * displacements;
                    product += rest;
                  }});
  ways.push_back({"rows", [&] { semblante_deform(&face, &pose, out.data()); }});
  for (std::uint32_t v = 0; v < count; ++v) {
    const semblante_prepared_face* const prepared = variants[v].group_size == 8 ? eights.face : widest.face;
    ways.push_back(
        {variants[v].name, [&, v, prepared] { semblante_deform_by(&variants[v], prepared, &pose, out.data()); }});
  }
  ways.push_back({"changed", [&] { semblante_deform_changed(widest.face, &neutral, &still, out.data()); }});
  ways[1].frame();
  check_scalar(head, out, expected);
  for (std::size_t w = 4; w + 1 < ways.size(); ++w) {
    ways[w].frame();
    if (!std::equal(expected.begin(), expected.end(), out.begin())) std::printf("%s is WRONG\n", ways[w].name.c_str());
  }
  race(ways, seconds);

  std::printf("%-12s %-6s %7u %6.2f %5.1f | %6.1f |", head.name.c_str(), method, head.vertex_count(),
              static_cast<double>(head.points.size()) / head.vertex_count(),
              static_cast<double>(read_bytes(*eights.face)) / head.vertex_count(), 1e6 * ways[0].best);
  for (std::size_t w = 1; w < ways.size(); ++w)
    std::printf(" %s %.2f", ways[w].name.c_str(), ways[w].best / ways[0].best);
  std::printf("\n");
  std::fflush(stdout);
}

std::vector<BenchHead> heads_with(WeightMethod method) {
  std::vector<BenchHead> heads;
  for (const unsigned cuts : {0U, 1U, 2U}) heads.push_back(sample_bench_head(method, cuts));
  for (BenchHead& head : real_bench_heads(method)) heads.push_back(std::move(head));
  return heads;
}

constexpr std::pair<WeightMethod, const char*> methods[] = {{WeightMethod::paper, "paper"},
                                                            {WeightMethod::smooth, "smooth"}};

int time_file(const char* name) {
  std::ifstream in(name, std::ios::binary);
  char magic[4];
  std::uint32_t counts[3] = {};
  const auto get = [&in](auto& values, std::size_t count) {
    values.resize(count);
    in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(values[0])));
  };
  in.read(magic, 4).read(reinterpret_cast<char*>(counts), sizeof counts);
  BenchHead head;
  std::vector<float> pose_numbers;
  get(head.rest, std::size_t{counts[0]} * 3);
  get(head.offsets, std::size_t{counts[0]} + 1);
  get(head.weights, counts[1]);
  get(head.triangles, counts[2]);
  get(pose_numbers, sizeof(semblante_pose) / sizeof(float));
  get(head.points, counts[1]);
  get(head.rigid, counts[0]);
  get(head.turn, counts[0]);
  if (!in) return 1;
  semblante_pose pose;
  std::copy(pose_numbers.begin(), pose_numbers.end(), reinterpret_cast<float*>(&pose));
  semblante_rig rig{};  // only the eyes count here
  std::memcpy(rig.eye_pivot, pose.eye_pivot, sizeof rig.eye_pivot);
  std::memcpy(rig.lids, pose.lids, sizeof rig.lids);
  const Prepared prepared(head.face(), &rig);
  std::vector<float> out(head.rest.size());
  std::vector<Way> ways{{"native", [&] { semblante_deform_prepared(prepared.face, &pose, out.data()); }}};
  race(ways, 0.2);
  std::printf("%.9f\n", ways[0].best);
  return 0;
}

int run(int argc, char** argv) {
  const std::string_view first = argc > 1 ? argv[1] : "";
  if (first == "--time" && argc > 2) return time_file(argv[2]);
  if (first == "--write" && argc > 2) {
    for (const auto& [method, name] : methods) {
      for (const BenchHead& head : heads_with(method)) {
        write_bench_head(head, std::string(argv[2]) + "/" + head.name + "-" + name + "-" +
                                   std::to_string(head.vertex_count()) + ".head");
      }
    }
    return 0;
  }
  const double seconds = argc > 1 ? std::atof(argv[1]) : 1.0;
  std::printf("%-12s %-6s %7s %6s %5s | %6s | times the limit\n", "head", "method", "#V", "infl", "B/V", "limit us");
  for (const auto& [method, name] : methods) {
    for (const BenchHead& head : heads_with(method)) print_row(head, name, seconds);
  }
  return 0;
}

}  // namespace
}  // namespace semblante::bench

int main(int argc, char** argv) { return semblante::bench::run(argc, argv); }
