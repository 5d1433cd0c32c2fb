// What a user waits for from a file to a face package, stage by stage: a table on standard output.
//   bench_stages

#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <sys/resource.h>

#include "core/import/import.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/place_feature_points.h"
#include "protocol/package/package.h"
#include "tests/oracle/real_heads.h"

namespace semblante {
namespace {

/// Processor time of the process: some stages may use several threads.
double now() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// side x side squares of waves as an OBJ file, 0.2 m wide.
std::string waves_file(std::uint32_t side) {
  std::string text;
  std::array<char, 96> line{};
  const auto add = [&](int length) { text.append(line.data(), static_cast<std::size_t>(length)); };
  const double step = 0.2 / side;
  for (std::uint32_t row = 0; row <= side; ++row) {
    for (std::uint32_t column = 0; column <= side; ++column) {
      const double x = column * step;
      const double y = row * step;
      add(std::snprintf(line.data(), line.size(), "v %.6f %.6f %.6f\n", x, y,
                        0.02 * std::sin(40.0 * x) * std::cos(30.0 * y)));
    }
  }
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < side; ++column) {
      const std::uint32_t a = row * (side + 1) + column + 1;
      const std::uint32_t above = a + side + 1;
      add(std::snprintf(line.data(), line.size(), "f %u %u %u\nf %u %u %u\n", a, a + 1, above, a + 1, above + 1,
                        above));
    }
  }
  return text;
}

std::vector<MarkedPoint> spread_points(std::size_t vertices) {
  std::vector<MarkedPoint> points;
  for (std::uint8_t id = 0; id + 1U < feature_point_count; ++id) {
    MarkedPoint point;
    point.id = FeaturePointId(id);
    point.vertex = static_cast<std::uint32_t>((id * 2654435761ULL) % vertices);
    points.push_back(point);
  }
  return points;
}

template <class T>
T taken(Result<T> result) {
  if (result) return *std::move(result);
  std::fprintf(stderr, "bench_stages: %s\n", result.error().message.c_str());
  std::exit(1);
}

void print_stages(const char* name, std::span<const std::uint8_t> file, ModelFormat format,
                  std::vector<MarkedPoint> points) {
  std::array<double, 5> at{};
  at[0] = now();
  const Model model = taken(import_model(file, format));
  at[1] = now();
  const Surface surface = build_surface(model);
  at[2] = now();
  if (points.empty()) points = spread_points(model.positions.size());
  const Rig rig = taken(parametrize(model, surface, taken(place_feature_points(model, surface, points, nullptr))));
  at[3] = now();
  const FacePackage package = taken(build_package(model, surface, rig, {}));
  at[4] = now();
  const double all = at[4] - at[0];
  std::printf("%-6s %8zu %8.3f", name, model.positions.size(), all);
  for (std::size_t stage = 0; stage < 4; ++stage) std::printf(" %10.0f%%", 100.0 * (at[stage + 1] - at[stage]) / all);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf(" %9ld\n", usage.ru_maxrss / 1024);
  std::fflush(stdout);
}

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

void run() {
  std::printf("%-6s %8s %8s %11s %11s %11s %11s %9s\n", "mesh", "vertices", "seconds", "import", "surface",
              "parametrize", "package", "peak MiB");
  if (const auto faces = oracle::faces_folder()) {
    std::ifstream in(*faces / "ict-facekit/neutral.obj", std::ios::binary);
    const std::string file{std::istreambuf_iterator<char>(in), {}};
    print_stages("ICT", bytes_of(file), ModelFormat::obj,
                 oracle::read_trusted_points(*faces / "ict-facekit/ict-facekit.fps.json"));
  }
  for (const std::uint32_t side : {99U, 223U, 446U, 707U}) {
    print_stages("waves", bytes_of(waves_file(side)), ModelFormat::obj, {});
  }
}

}  // namespace
}  // namespace semblante

int main() {
  semblante::run();
  return 0;
}
