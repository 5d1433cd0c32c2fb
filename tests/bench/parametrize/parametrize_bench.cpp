// Parametrization of generated landscapes, and its search beside the textbook one of the standard library.
//   bench_parametrize [--benchmark_filter=...]

#include <cmath>
#include <limits>
#include <queue>

#include <benchmark/benchmark.h>

#include "core/geometry/edge_path_search.h"
#include "core/parametrize/parametrize.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

/// side x side squares of waves, so that no path is straight.
Model make_waves(std::uint32_t side) {
  Model model = testing::make_grid(side, side);
  for (glm::vec3& p : model.positions) p.z = 2.0F * std::sin(0.3F * p.x) * std::cos(0.2F * p.y);
  return model;
}

/// All 84 points, spread over the model.
FeaturePointSet spread_points(const Model& model) {
  FeaturePointSet points;
  const std::size_t count = model.positions.size();
  for (std::uint8_t id = 0; id < feature_point_count; ++id) {
    const auto vertex = static_cast<std::uint32_t>((id * 2654435761ULL) % count);
    points.push_back({FeaturePointId(id), VertexId(vertex), model.positions[vertex]});
  }
  return points;
}

/// The baseline: Dijkstra as a textbook has it, on containers of its own.
std::vector<double> plain_distances(const Surface& surface, SurfaceVertexId source) {
  std::vector<double> distances(surface.vertex_count(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, SurfaceVertexId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> pending;
  distances[source.value()] = 0.0;
  pending.emplace(0.0, source);
  while (!pending.empty()) {
    const auto [d, at] = pending.top();
    pending.pop();
    if (d > distances[at.value()]) continue;
    for (const Surface::Step& step : surface.steps_from(at)) {
      if (d + step.length >= distances[step.to.value()]) continue;
      distances[step.to.value()] = d + step.length;
      pending.emplace(d + step.length, step.to);
    }
  }
  return distances;
}

void Distances_Plain(benchmark::State& state) {
  const Surface surface = build_surface(make_waves(static_cast<std::uint32_t>(state.range(0))));
  for (auto _ : state) benchmark::DoNotOptimize(plain_distances(surface, SurfaceVertexId(0)).back());
}

void Distances_EdgePathSearch(benchmark::State& state) {
  const Surface surface = build_surface(make_waves(static_cast<std::uint32_t>(state.range(0))));
  EdgePathSearch search(surface);
  for (auto _ : state) benchmark::DoNotOptimize(search.from(SurfaceVertexId(0)).back());
}

void Surface_Build(benchmark::State& state) {
  const Model model = make_waves(static_cast<std::uint32_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(build_surface(model).part_count());
}

void Parametrize_AllPoints(benchmark::State& state) {
  const Model model = make_waves(static_cast<std::uint32_t>(state.range(0)));
  const Surface surface = build_surface(model);
  const FeaturePointSet points = spread_points(model);
  for (auto _ : state) benchmark::DoNotOptimize(parametrize(model, surface, points)->weights.weights.size());
  state.counters["vertices"] = static_cast<double>(model.positions.size());
}

// 163 x 163 is the 26.7 thousand vertices of a detailed head.
BENCHMARK(Distances_Plain)->Arg(70)->Arg(163)->Arg(400)->Unit(benchmark::kMillisecond);
BENCHMARK(Distances_EdgePathSearch)->Arg(70)->Arg(163)->Arg(400)->Unit(benchmark::kMillisecond);
BENCHMARK(Surface_Build)->Arg(70)->Arg(163)->Arg(400)->Unit(benchmark::kMillisecond);
BENCHMARK(Parametrize_AllPoints)->Arg(70)->Arg(163)->Arg(400)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace semblante
