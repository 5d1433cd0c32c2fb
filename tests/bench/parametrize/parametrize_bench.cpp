// What a parametrization costs beside a textbook baseline measured in the same run: tables on standard output.
//   bench_parametrize [greatest number of thousand vertices]

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/distances_from_all.h"
#include "core/geometry/unfolded_surface.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/place_feature_points.h"
#include "tests/oracle/real_heads.h"
#include "tests/support/meshes.h"
#include "tests/support/thread_time.h"

namespace semblante {
namespace {

double best_of(int turns, const std::function<void()>& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < turns; ++turn) {
    const double before = test::thread_cpu_ms();
    work();
    best = std::min(best, 1e-3 * (test::thread_cpu_ms() - before));
  }
  return best;
}

/// The baseline's own graph, as compact as the product's.
struct PlainGraph {
  std::vector<std::uint32_t> offsets, to;
  std::vector<double> lengths;

  explicit PlainGraph(const Surface& surface) : offsets(surface.step_offsets) {
    for (const Surface::Step& step : surface.steps) {
      to.push_back(step.to.value());
      lengths.push_back(step.length);
    }
  }
};

/// The baseline: Dijkstra with std::priority_queue as a textbook has it, stale entries left out.
std::vector<double> plain_distances(const PlainGraph& graph, std::uint32_t source) {
  std::vector<double> distances(graph.offsets.size() - 1, std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> pending;
  distances[source] = 0.0;
  pending.emplace(0.0, source);
  while (!pending.empty()) {
    const auto [d, at] = pending.top();
    pending.pop();
    if (d > distances[at]) continue;
    for (std::uint32_t k = graph.offsets[at]; k < graph.offsets[at + 1]; ++k) {
      const double further = d + graph.lengths[k];
      if (further >= distances[graph.to[k]]) continue;
      distances[graph.to[k]] = further;
      pending.emplace(further, graph.to[k]);
    }
  }
  return distances;
}

struct Head {
  std::string name;
  Model model;
  FeaturePointSet points;
};

/// side x side squares of waves, so that no path is straight; 83 points spread over them.
Head make_waves(std::uint32_t side) {
  Head head{"waves", testing::make_grid(side, side), {}};
  for (glm::vec3& p : head.model.positions) p.z = 2.0F * std::sin(0.3F * p.x) * std::cos(0.2F * p.y);
  const std::size_t count = head.model.positions.size();
  for (std::uint8_t id = 0; id + 1U < feature_point_count; ++id) {
    const auto vertex = static_cast<std::uint32_t>((id * 2654435761ULL) % count);
    head.points.push_back({FeaturePointId(id), VertexId(vertex), head.model.positions[vertex]});
  }
  return head;
}

/// The sources of every part that holds points.
struct PartSources {
  PartId part;
  std::vector<SurfaceVertexId> sources;
};

std::vector<PartSources> sources_by_part(const Surface& surface, const FeaturePointSet& points) {
  std::vector<PartSources> parts;
  for (const SurfacePoint& point : surface_points(surface, points)) {
    const PartId part = surface.part_of[point.vertex.value()];
    auto at = std::find_if(parts.begin(), parts.end(), [&](const PartSources& p) { return p.part == part; });
    if (at == parts.end()) at = parts.insert(parts.end(), {part, {}});
    at->sources.push_back(point.vertex);
  }
  return parts;
}

bool same_bits(const Surface& graph, const PlainGraph& plain, const std::vector<PartSources>& parts,
               const DistanceKernel& kernel) {
  for (const PartSources& part : parts) {
    const DistancesFromAll ours = distances_from_all(graph, part.part, part.sources, kernel);
    const auto members = graph.members_of(part.part);
    for (std::size_t i = 0; i < part.sources.size(); ++i) {
      const std::vector<double> expected = plain_distances(plain, part.sources[i].value());
      for (std::size_t m = 0; m < members.size(); ++m) {
        const double wanted = expected[members[m].value()];
        if (std::bit_cast<std::uint64_t>(ours.at(i, m)) != std::bit_cast<std::uint64_t>(wanted)) return false;
      }
    }
  }
  return true;
}

void print_row(const Head& head, const char* metric, const Surface& surface, const Surface& graph) {
  const PlainGraph plain(graph);
  const std::vector<PartSources> parts = sources_by_part(surface, head.points);
  const double baseline = best_of(3, [&] {
    for (const PartSources& part : parts) {
      for (const SurfaceVertexId source : part.sources) plain_distances(plain, source.value());
    }
  });
  std::printf("%-8s %-8s %8zu %9.4f", head.name.c_str(), metric, surface.vertex_count(), baseline);
  for (const DistanceKernel& kernel : distance_kernels()) {
    const double ours = best_of(7, [&] {
      for (const PartSources& part : parts) distances_from_all(graph, part.part, part.sources, kernel);
    });
    std::printf(" %8.4f %5.1fx%s", ours, baseline / ours, same_bits(graph, plain, parts, kernel) ? "" : " WRONG");
  }
  ParametrizeOptions options;
  options.metric = *parse_distance_metric(metric);
  for (const WeightMethod method : {WeightMethod::paper, WeightMethod::smooth}) {
    options.weights = method;
    const double whole = best_of(7, [&] { (void)parametrize(head.model, surface, head.points, options); });
    std::printf(" %8.2f", whole / baseline);
  }
  std::printf("\n");
  std::fflush(stdout);
}

void print_head(const Head& head) {
  const Surface surface = build_surface(head.model);
  print_row(head, "edge", surface, surface);
  print_row(head, "unfolded", surface, with_unfolded_diagonals(surface, head.model.triangles));
}

void run(std::uint32_t greatest) {
  std::printf("seconds for the distances of all points, and how many times faster than the baseline;\n");
  std::printf("whole parametrizations as multiples of the baseline's distances\n\n");
  std::printf("%-8s %-8s %8s %9s", "mesh", "metric", "vertices", "baseline");
  for (const DistanceKernel& kernel : distance_kernels()) std::printf(" %15s", kernel.name);
  std::printf(" %8s %8s\n", "paper", "smooth");
  for (const std::uint32_t side : {99U, 223U, 446U}) {
    if ((side + 1) * (side + 1) <= greatest * 1000U) print_head(make_waves(side));
  }
  const auto faces = oracle::faces_folder();
  if (!faces) {
    std::puts("no folder of real heads: set SEMBLANTE_FACES_DIR");
  } else {
    Head head{"ICT", oracle::import_head(*faces / "ict-facekit/neutral.obj"), {}};
    const auto marked = oracle::read_trusted_points(*faces / "ict-facekit/ict-facekit.fps.json");
    const auto placed = place_feature_points(head.model, build_surface(head.model), marked, nullptr);
    if (placed) head.points = *placed;
    print_head(head);
  }

  std::printf("\nwhole parametrizations, edge and paper, against size\n\n%8s %9s\n", "vertices", "seconds");
  std::vector<std::pair<double, double>> logs;
  for (const std::uint32_t side : {99U, 223U, 446U, 707U}) {
    if ((side + 1) * (side + 1) > greatest * 1000U) continue;
    const Head head = make_waves(side);
    const Surface surface = build_surface(head.model);
    const double seconds = best_of(3, [&] { (void)parametrize(head.model, surface, head.points); });
    std::printf("%8zu %9.4f\n", surface.vertex_count(), seconds);
    std::fflush(stdout);
    logs.emplace_back(std::log(static_cast<double>(surface.vertex_count())), std::log(seconds));
  }
  double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0;
  for (const auto& [x, y] : logs)
    mean_x += x / static_cast<double>(logs.size()), mean_y += y / static_cast<double>(logs.size());
  for (const auto& [x, y] : logs) xx += (x - mean_x) * (x - mean_x), xy += (x - mean_x) * (y - mean_y);
  if (logs.size() > 1) std::printf("exponent %.2f\n", xy / xx);
}

}  // namespace
}  // namespace semblante

int main(int argc, char** argv) {
  semblante::run(argc > 1 ? static_cast<std::uint32_t>(std::atoi(argv[1])) : 502);
  return 0;
}
