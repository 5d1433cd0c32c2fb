#include "tests/bench/weights/fitted_shares.h"

#include <algorithm>
#include <utility>

#include "core/parametrize/fitted_weights.h"
#include "core/parametrize/smooth_weights.h"
#include "tests/bench/weights/smooth_shares.h"

namespace semblante::bench {
namespace {

std::vector<Example> shapes_of(const ExpressionStudy& study) {
  std::vector<Example> shapes;
  for (const Expression& expression : study.expressions) {
    Example& shape = shapes.emplace_back();
    shape.name = expression.name;
    for (std::uint32_t m = 0; m < expression.displacement.size(); ++m) {
      if (expression.displacement[m] == glm::dvec3(0.0)) continue;
      shape.vertices.push_back(m);
      shape.displacements.emplace_back(expression.displacement[m]);
    }
  }
  return shapes;
}

}  // namespace

FittedShares fitted_shares(const ExpressionStudy& study, const ExpressionStudy& teacher, const WeightPrior& prior) {
  constexpr std::size_t most_left_out = 100'000;
  const auto margins = margin_sites(study.surface, study.distances.points);
  const WeightTable<double> smooth =
      smooth_part_weights(study.surface, study.distances, study.eye_separation, margins, prior);
  const double unit = weight_unit(study.distances, study.eye_separation);
  const std::size_t sample_every =
      std::max(std::size_t{1}, study.member_count() * teacher.expressions.size() / most_left_out);
  auto fitted =
      fit_part_weights(study.distances, smooth, freedom_of_members(study.surface, study.distances, margins, unit),
                       shapes_of(teacher), unit, sample_every);
  return {shares_of_table(study, fitted.value().rows), WeightFit{std::move(fitted.value().errors), {}}};
}

}  // namespace semblante::bench
