// Weights against what real faces do, and what they cost: two tables on standard output.

#include <cstdio>
#include <filesystem>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

#include "core/geometry/unfolded_surface.h"
#include "core/parametrize/influence_regions.h"
#include "core/parametrize/smooth_weights.h"
#include "core/parametrize/weights.h"
#include "tests/bench/prior/training_head.h"
#include "tests/bench/weights/bench_main.h"
#include "tests/bench/weights/candidate_weights.h"
#include "tests/bench/weights/error_regions.h"
#include "tests/bench/weights/expression_study.h"
#include "tests/bench/weights/fitted_shares.h"
#include "tests/bench/weights/smooth_shares.h"
#include "tests/support/thread_time.h"

namespace semblante::bench {
namespace {

Shares to_shares(const ExpressionStudy& study, const WeightTable<double>& table, bool quotient) {
  const std::size_t points = study.point_count();
  Shares shares(study.member_count() * points, 0.0);
  for (std::size_t m = 0; m < study.member_count(); ++m) {
    double sum = quotient ? 0.0 : 1.0;
    for (const double w : table.weights_of(m)) sum += quotient ? w : 0.0;
    for (std::size_t k = 0; k < table.points_of(m).size(); ++k) {
      for (std::size_t f = 0; f < points; ++f) {
        if (study.distances.points[f].id != table.points_of(m)[k]) continue;
        shares[m * points + f] = sum > 0.0 ? table.weights_of(m)[k] / sum : 0.0;
      }
    }
  }
  return shares;
}

void print(const char* name, const ExpressionStudy& study, const Shares& shares) {
  const Figures f = measure(study, shares);
  std::printf("%-22s %6.3f %8.3f %9.4f %6.1f %5zu %9.3f %9.3f %9.3f\n", name, f.error, f.visible_error, f.roughness,
              f.mean_influences, f.max_influences, f.lip_leak, f.lid_leak, f.least);
  std::fflush(stdout);
}

void print_columns() {
  std::printf("%-22s %6s %8s %9s %6s %5s %9s %9s %9s\n", "weights", "E", "visible", "rough", "infl", "max", "lip leak",
              "lid leak", "least");
}

/// Fitted to all shapes, and the mean errors of each shape left out.
void print_fitted(const char* name, const ExpressionStudy& study, const ExpressionStudy& teacher,
                  const WeightPrior& prior) {
  const FittedShares fitted = fitted_shares(study, teacher, prior);
  print(name, study, fitted.shares);
  std::printf("  each shape left out: E %.3f, of smooth weights %.3f\n", fitted.fit.error(), fitted.fit.smooth_error());
}

constexpr WeightPrior::Entry without_measured[] = {
#include "tests/golden/parametrize/prior_without_measured.inc"
};
constexpr WeightPrior::Entry without_makehuman[] = {
#include "tests/golden/parametrize/prior_without_makehuman.inc"
};
constexpr WeightPrior::Entry without_ict[] = {
#include "tests/golden/parametrize/prior_without_ict.inc"
};

/// Each shape predicted by a fit to the others, with a prior that has not seen the head and with the product's.
void print_left_out(const char* name, const ExpressionStudy& study, const WeightPrior& unseen) {
  const WeightFit strange = fitted_shares(study, study, unseen).fit;
  const WeightFit known = fitted_shares(study, study, trained_weight_prior()).fit;
  std::printf("%-45s %6.3f %7.3f %7.3f\n", name, strange.smooth_error(), strange.error(), known.error());
  std::fflush(stdout);
}

void print_fits(const std::filesystem::path& folder, const ExpressionStudy& ict, const ExpressionStudy& makehuman) {
  std::printf("\nshapes that the fit has not seen %19s %7s %7s\n", "smooth", "fitted", "product");
  print_left_out("ict-facekit, each of the 14 by the other 13", ict, WeightPrior(without_ict));
  print_left_out("ict-facekit, each of the 53 by the other 52",
                 read_ict_shapes(folder, 0, [](const std::string&) { return true; }), WeightPrior(without_ict));
  const ExpressionStudy others =
      read_ict_shapes(folder, 0, [](const std::string& shape) { return !is_measured(shape); });
  const WeightPrior prior(without_measured);
  const Figures smooth = measure(ict, smooth_shares(ict, prior));
  const Figures fitted = measure(ict, fitted_shares(ict, others, prior).shares);
  std::printf("%-45s %6.3f %7.3f         visible %.3f %.3f\n", "ict-facekit, the 14 by the other shapes", smooth.error,
              fitted.error, smooth.visible_error, fitted.visible_error);
  print_left_out("makehuman, each of the 19 by the other 18", makehuman, WeightPrior(without_makehuman));
}

void print_region_row(const char* name, const ByRegion& values) {
  std::printf("%-22s %6.3f", name, std::accumulate(values.begin(), values.end(), 0.0));
  for (const double value : values) std::printf(" %8.4f", value);
  std::printf("\n");
  std::fflush(stdout);
}

/// Where the error of smooth weights lies, by a prior that has not seen the expressions, and where the least possible
/// one does.
void print_regions(const char* head, const ExpressionStudy& study, const WeightPrior& unseen) {
  std::printf("\n%s: what each region adds to E\n\n%-22s %6s", head, "", "E");
  for (const std::string_view name : region_names) std::printf(" %8s", std::string(name).c_str());
  std::printf("\n");
  print_region_row("no motion", motion_by_region(study));
  print_region_row("smooth, prior unseen", error_by_region(study, smooth_shares(study, unseen)));
  print_region_row("least of 8 influences", error_by_region(study, best_shares(study, 8)));
  print_region_row("least of 4 influences", error_by_region(study, best_shares(study, 4)));
}

template <class Work>
double seconds(Work work) {
  double best = 1e9;
  for (int turn = 0; turn < 3; ++turn) {
    const double before = test::thread_cpu_ms();
    work();
    best = std::min(best, 1e-3 * (test::thread_cpu_ms() - before));
  }
  return best;
}

/// The baseline: one Dijkstra with std::priority_queue a point.
double plain_distances(const Surface& surface, std::span<const SurfacePoint> points) {
  double check = 0.0;
  for (const SurfacePoint& point : points) {
    std::vector<double> distances(surface.vertex_count(), std::numeric_limits<double>::infinity());
    std::priority_queue<std::pair<double, std::uint32_t>, std::vector<std::pair<double, std::uint32_t>>, std::greater<>>
        queue;
    distances[point.vertex.value()] = 0.0;
    queue.emplace(0.0, point.vertex.value());
    while (!queue.empty()) {
      const auto [distance, at] = queue.top();
      queue.pop();
      if (distance > distances[at]) continue;
      check = distance;
      for (const Surface::Step& step : surface.steps_from(SurfaceVertexId(at))) {
        if (distance + step.length >= distances[step.to.value()]) continue;
        distances[step.to.value()] = distance + step.length;
        queue.emplace(distance + step.length, step.to.value());
      }
    }
  }
  return check;
}

/// Every triangle of the skin in four; points stay vertices.
Model refined_skin(const ExpressionStudy& study) {
  Model model;
  for (std::size_t m = 0; m < study.member_count(); ++m) model.positions.emplace_back(study.position(m));
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(model.positions.size()));
    if (is_new) model.positions.push_back((model.positions[a] + model.positions[b]) / 2.0F);
    return at->second;
  };
  for (const Triangle& t : study.triangles) {
    const std::uint32_t ab = middle(t[0], t[1]);
    const std::uint32_t bc = middle(t[1], t[2]);
    const std::uint32_t ca = middle(t[2], t[0]);
    for (const Triangle& part : {Triangle{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}}) {
      model.triangles.push_back(part);
    }
  }
  return model;
}

void print_cost(const char* name, const ExpressionStudy& study, const Model& model) {
  const Surface surface = build_surface(model);
  std::vector<SurfacePoint> points = study.distances.points;
  for (std::size_t i = 0; i < points.size(); ++i) points[i].vertex = surface.surface_of[study.member_of_point[i]];
  const PartId part = surface.part_of[points[0].vertex.value()];
  const double baseline = seconds([&] { plain_distances(surface, points); });
  PointDistances distances;
  const double measured = seconds([&] { distances = measure_distances(surface, part, points); });
  const double paper = seconds([&] { part_weights(surface, distances, influence_regions(surface, distances)); });
  const double smooth = seconds([&] {
    const auto margins = margin_sites(surface, points);
    smooth_part_weights(surface, distances, study.eye_separation, margins);
  });
  std::printf("%-14s %8zu %8zu %9.3f %9.3f %7.2f %7.2f\n", name, surface.vertex_count(), points.size(), baseline,
              measured, (measured + paper) / baseline, (measured + smooth) / baseline);
}

void run(const std::filesystem::path& folder) {
  const ExpressionStudy study = read_expression_study(folder);
  std::printf("%s: skin of %zu vertices, %zu points, %zu expressions\n\n", folder.filename().c_str(),
              study.member_count(), study.point_count(), study.expressions.size());
  print_columns();
  const auto regions = influence_regions(study.surface, study.distances);
  print("paper", study, to_shares(study, part_weights(study.surface, study.distances, regions), true));
  const auto margins = margin_sites(study.surface, study.distances.points);
  const auto smooth = smooth_part_weights(study.surface, study.distances, study.eye_separation, margins);
  print("smooth", study, to_shares(study, smooth, false));
  print("smooth, no prior", study, smooth_shares(study, {}));
  print_fitted("fitted", study, study, trained_weight_prior());
  const Surface unfolded = with_unfolded_diagonals(study.surface, study.model.triangles);
  const PartId part = study.surface.part_of[study.distances.members[0].value()];
  const PointDistances nearer = measure_distances(unfolded, part, study.distances.points);
  print("paper, unfolded", study,
        to_shares(study, part_weights(study.surface, nearer, influence_regions(study.surface, nearer)), true));
  print("smooth, unfolded", study,
        to_shares(study, smooth_part_weights(study.surface, nearer, study.eye_separation, margins), false));
  print("harmonic", study, harmonic_shares(study));
  print("linear RBF", study, linear_rbf_shares(study));
  for (const double length : {0.3, 0.5, 0.7}) {
    print(("kriging, " + std::to_string(length).substr(0, 3) + " ES0").c_str(), study, kriging_shares(study, length));
  }
  const ExpressionStudy other = read_target_study(folder.parent_path() / "makehuman/head.glb",
                                                  folder.parent_path() / "makehuman/makehuman.fps.json");
  std::printf("\nmakehuman: skin of %zu vertices, %zu points, %zu expressions\n\n", other.member_count(),
              other.point_count(), other.expressions.size());
  print_columns();
  print(
      "paper", other,
      to_shares(other, part_weights(other.surface, other.distances, influence_regions(other.surface, other.distances)),
                true));
  print("smooth", other, smooth_shares(other, trained_weight_prior()));
  print("smooth, no prior", other, smooth_shares(other, {}));
  print_fitted("fitted", other, other, trained_weight_prior());
  print_fits(folder, study, other);
  print_regions("ict-facekit", study, WeightPrior(without_measured));
  print_regions("makehuman", other, WeightPrior(without_makehuman));
  std::printf("\nseconds for all points, and whole parametrizations as multiples of the baseline's distances\n");
  std::printf("%-14s %8s %8s %9s %9s %7s %7s\n", "mesh", "vertices", "points", "baseline", "distances", "paper",
              "smooth");
  Model skin;
  for (std::size_t m = 0; m < study.member_count(); ++m) skin.positions.emplace_back(study.position(m));
  skin.triangles = study.triangles;
  print_cost("skin", study, skin);
  print_cost("skin, refined", study, refined_skin(study));
}

}  // namespace
}  // namespace semblante::bench

int main() { return semblante::bench::run_on_ict_head("bench_weights", semblante::bench::run); }
