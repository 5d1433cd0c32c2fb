#include "tests/bench/weights/expression_study.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <glm/geometric.hpp>

#include "core/anatomy/cavities.h"
#include "core/anatomy/point_lookup.h"
#include "core/parametrize/fapu.h"
#include "core/parametrize/place_feature_points.h"
#include "tests/oracle/real_heads.h"

namespace semblante::bench {
namespace {

/// A share below this is no influence.
constexpr double least_share = 1e-6;

std::vector<std::size_t> slots_of(const ExpressionStudy& study, std::initializer_list<const char*> names) {
  std::vector<std::size_t> slots;
  for (const char* const name : names) {
    for (std::size_t i = 0; i < study.point_count(); ++i) {
      if (study.distances.points[i].id == parse_feature_point(name)) slots.push_back(i);
    }
  }
  return slots;
}

/// How much the points `moved` move the surroundings of the points `still`: vertices within 0.14 ES0 of one of those
/// along the surface, and at most half as far from it as from any of `moved`.
double leak(const ExpressionStudy& study, const Shares& shares, std::initializer_list<const char*> moved_names,
            std::initializer_list<const char*> still_names) {
  const auto moved = slots_of(study, moved_names);
  const auto still = slots_of(study, still_names);
  double worst = 0.0;
  std::vector<double> row;
  for (std::size_t m = 0; m < study.member_count(); ++m) {
    const auto distances = study.distances.of_member(m, row);
    const auto nearest = [&](const std::vector<std::size_t>& slots) {
      double least = std::numeric_limits<double>::infinity();
      for (const std::size_t s : slots) least = std::min(least, distances[s]);
      return least;
    };
    const double near = nearest(still);
    if (near > 0.14 * study.eye_separation || near > 0.5 * nearest(moved)) continue;
    double sum = 0.0;
    for (const std::size_t s : moved) sum += shares[m * study.point_count() + s];
    worst = std::max(worst, std::abs(sum));
  }
  return worst;
}

}  // namespace

std::vector<CotangentEdge> cotangent_edges(const ExpressionStudy& study) {
  std::vector<CotangentEdge> edges;
  for (const Triangle& t : study.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = t[c];
      const std::uint32_t b = t[(c + 1) % 3];
      const glm::dvec3 to_a = study.position(a) - study.position(t[(c + 2) % 3]);
      const glm::dvec3 to_b = study.position(b) - study.position(t[(c + 2) % 3]);
      const double sine = glm::length(glm::cross(to_a, to_b));
      if (sine > 1e-12) edges.push_back({a, b, glm::dot(to_a, to_b) / sine / 2.0});
    }
  }
  return edges;
}

ExpressionStudy study_of(Model model, const std::vector<MarkedPoint>& marked) {
  ExpressionStudy study;
  study.model = std::move(model);
  study.surface = build_surface(study.model);
  const auto points = place_feature_points(study.model, study.surface, marked, nullptr);
  if (!points) throw std::runtime_error(points.error().message);
  study.eye_separation = 1024.0 * compute_fapu(*points)[FapuUnit::es].value();
  const PartId skin =
      study.surface.part_of[find_point(*points, "2.1")->vertex.has_value()
                                ? study.surface.surface_of[find_point(*points, "2.1")->vertex->value()].value()
                                : 0];
  study.distances = measure_distances(study.surface, skin, surface_points(study.surface, *points));

  std::vector<std::uint32_t> member_of(study.surface.vertex_count(), Model::no_index);
  for (std::uint32_t m = 0; m < study.member_count(); ++m) member_of[study.distances.members[m].value()] = m;
  for (const Triangle& t : study.model.triangles) {
    Triangle of_members{};
    for (std::size_t c = 0; c < 3; ++c) of_members[c] = member_of[study.surface.surface_of[t[c]].value()];
    if (of_members[0] != Model::no_index) study.triangles.push_back(of_members);
  }
  for (const SurfacePoint& p : study.distances.points) study.member_of_point.push_back(member_of[p.vertex.value()]);
  study.hidden.assign(study.member_count(), false);
  for (const Cavity& cavity : find_cavities(study.surface, skin, study.distances.points)) {
    for (const SurfaceVertexId v : cavity.members) study.hidden[member_of[v.value()]] = true;
  }
  return study;
}

Expression expression_of(const ExpressionStudy& study, std::string name,
                         const std::function<glm::dvec3(std::uint32_t file_vertex)>& displacement) {
  Expression expression{std::move(name), {}};
  for (const SurfaceVertexId vertex : study.distances.members) {
    expression.displacement.push_back(displacement(study.surface.file_vertex_of[vertex.value()].value()));
  }
  return expression;
}

ExpressionStudy read_target_study(const std::filesystem::path& model, const std::filesystem::path& points) {
  std::vector<MarkedPoint> marked = oracle::read_trusted_points(points);
  for (MarkedPoint& point : marked) point.vertex.reset();
  return target_study(oracle::import_head(model), marked);
}

ExpressionStudy target_study(Model model, const std::vector<MarkedPoint>& marked) {
  ExpressionStudy study = study_of(std::move(model), marked);
  for (const Example& example : study.model.examples) {
    study.expressions.push_back(
        expression_of(study, example.name, [&](std::uint32_t v) { return glm::dvec3(example.at(v)); }));
  }
  return study;
}

ExpressionStudy read_expression_study(const std::filesystem::path& folder) {
  ExpressionStudy study = study_of(oracle::import_head(folder / "neutral.obj"),
                                   oracle::read_trusted_points(folder / "ict-facekit.fps.json"));
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "expressions")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    const Model moved = oracle::read_trusted_obj(file);
    study.expressions.push_back(expression_of(study, file.stem().string(), [&](std::uint32_t v) {
      return glm::dvec3(moved.positions.at(v)) - glm::dvec3(study.model.positions[v]);
    }));
  }
  return study;
}

Figures measure(const ExpressionStudy& study, const Shares& shares) {
  const std::size_t points = study.point_count();
  const std::vector<CotangentEdge> edges = cotangent_edges(study);
  Figures figures;
  for (const Expression& expression : study.expressions) {
    const std::vector<glm::dvec3>& truth = expression.displacement;
    std::vector<glm::dvec3> error(study.member_count());
    double wrong = 0.0;
    double all = 0.0;
    double visibly_wrong = 0.0;
    double visible = 0.0;
    double largest = 0.0;
    for (std::size_t m = 0; m < error.size(); ++m) {
      glm::dvec3 predicted(0.0);
      for (std::size_t f = 0; f < points; ++f) predicted += shares[m * points + f] * truth[study.member_of_point[f]];
      error[m] = predicted - truth[m];
      wrong += glm::dot(error[m], error[m]);
      all += glm::dot(truth[m], truth[m]);
      if (!study.hidden[m]) {
        visibly_wrong += glm::dot(error[m], error[m]);
        visible += glm::dot(truth[m], truth[m]);
      }
      largest = std::max(largest, glm::length(truth[m]));
    }
    std::vector<glm::dvec3> laplacian(error.size());
    for (const CotangentEdge& edge : edges) {
      laplacian[edge.a] += edge.weight * (error[edge.b] - error[edge.a]);
      laplacian[edge.b] += edge.weight * (error[edge.a] - error[edge.b]);
    }
    double rough = 0.0;
    for (const glm::dvec3& l : laplacian) rough += glm::length(l);
    figures.error += wrong / all / static_cast<double>(study.expressions.size());
    figures.visible_error += visibly_wrong / visible / static_cast<double>(study.expressions.size());
    figures.roughness +=
        rough / static_cast<double>(error.size()) / largest / static_cast<double>(study.expressions.size());
  }
  std::size_t influenced = 0;
  std::size_t influences = 0;
  for (std::size_t m = 0; m < study.member_count(); ++m) {
    std::size_t count = 0;
    for (std::size_t f = 0; f < points; ++f) {
      const double share = shares[m * points + f];
      figures.least = std::min(figures.least, share);
      if (std::abs(share) > least_share) ++count;
    }
    influenced += count > 0 ? 1 : 0;
    influences += count;
    figures.max_influences = std::max(figures.max_influences, count);
  }
  figures.mean_influences = static_cast<double>(influences) / static_cast<double>(std::max<std::size_t>(influenced, 1));
  figures.lip_leak = leak(study, shares, {"2.3", "2.8", "2.9", "8.2", "8.7", "8.8"},
                          {"2.2", "2.6", "2.7", "8.1", "8.5", "8.6", "8.9", "8.10"});
  figures.lid_leak = leak(study, shares, {"3.3", "3.4"}, {"3.1", "3.2"});
  return figures;
}

}  // namespace semblante::bench
