// Surface distances against nearly exact geodesics on a real head, and what they cost: a table on standard output.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <stdexcept>

#include "core/geometry/edge_path_search.h"
#include "core/geometry/unfolded_surface.h"
#include "tests/bench/weights/bench_main.h"
#include "tests/bench/weights/expression_study.h"
#include "tests/oracle/steiner_distances.h"

namespace semblante::bench {
namespace {

double search_all(const Surface& graph, const ExpressionStudy& study) {
  double best = 1e9;
  for (int turn = 0; turn < 3; ++turn) {
    const auto before = std::chrono::steady_clock::now();
    EdgePathSearch search(graph);
    for (const SurfacePoint& point : study.distances.points) search.from(point.vertex);
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count());
  }
  return best;
}

void print(const char* name, const Surface& graph, const ExpressionStudy& study,
           const std::vector<std::vector<double>>& exact, std::size_t every, double edge_seconds) {
  std::vector<double> errors;
  EdgePathSearch search(graph);
  for (std::size_t k = 0; k < exact.size(); ++k) {
    const auto found = search.from(study.distances.points[k * every].vertex);
    for (const SurfaceVertexId v : study.distances.members) {
      const double truth = exact[k][v.value()];
      if (truth > 0.0) errors.push_back(std::abs(found[v.value()] / truth - 1.0));
    }
  }
  std::sort(errors.begin(), errors.end());
  double mean = 0.0;
  for (const double e : errors) mean += e / static_cast<double>(errors.size());
  const double seconds = search_all(graph, study);
  std::printf("%-10s %8.2f%% %8.2f%% %8.2f%% %9zu %9.3f %7.2f\n", name, 100.0 * mean,
              100.0 * errors[errors.size() * 99 / 100], 100.0 * errors.back(), graph.steps.size() / 2, seconds,
              seconds / edge_seconds);
}

void run(const std::filesystem::path& folder) {
  const ExpressionStudy study = read_expression_study(folder);
  constexpr std::size_t every = 9;
  constexpr std::uint32_t per_edge = 6;
  const oracle::SteinerDistances oracle(study.surface.positions, study.model.triangles, study.surface.surface_of,
                                        per_edge);
  std::vector<std::vector<double>> exact;
  for (std::size_t p = 0; p < study.point_count(); p += every) {
    exact.push_back(oracle.from(study.distances.points[p].vertex.value()));
  }
  std::printf("%s: distances from %zu points against paths over %u extra nodes an edge\n\n", folder.filename().c_str(),
              exact.size(), per_edge);
  std::printf("%-10s %9s %9s %9s %9s %9s %7s\n", "metric", "mean", "99th", "greatest", "links", "seconds", "times");
  const double edge_seconds = search_all(study.surface, study);
  print("edge", study.surface, study, exact, every, edge_seconds);
  print("unfolded", with_unfolded_diagonals(study.surface, study.model.triangles), study, exact, every, edge_seconds);
}

}  // namespace
}  // namespace semblante::bench

int main() { return semblante::bench::run_on_ict_head("bench_metric", semblante::bench::run); }
