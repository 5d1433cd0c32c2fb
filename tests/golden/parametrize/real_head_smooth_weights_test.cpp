// Smooth weights against fourteen real expressions of a head made by others.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/anatomy/cavities.h"
#include "core/parametrize/smooth_weights.h"
#include "tests/bench/weights/expression_study.h"
#include "tests/oracle/real_heads.h"

namespace semblante {
namespace {

TEST(RealExpressions_SmoothWeights, PredictTheSkinFromItsPoints) {
  const auto faces = oracle::faces_folder();
  if (!faces) GTEST_SKIP() << "no folder of real heads";
  const bench::ExpressionStudy study = bench::read_expression_study(*faces / "ict-facekit");
  ASSERT_EQ(study.expressions.size(), 14U);
  const WeightTable<double> table = smooth_part_weights(study.surface, study.distances, study.eye_separation,
                                                        margin_sites(study.surface, study.distances.points));
  bench::Shares shares(study.member_count() * study.point_count(), 0.0);
  for (std::size_t m = 0; m < study.member_count(); ++m) {
    for (std::size_t k = 0; k < table.points_of(m).size(); ++k) {
      for (std::size_t f = 0; f < study.point_count(); ++f) {
        if (study.distances.points[f].id == table.points_of(m)[k]) {
          shares[m * study.point_count() + f] = table.weights_of(m)[k];
        }
      }
    }
  }

  const bench::Figures figures = bench::measure(study, shares);

  EXPECT_LE(figures.error, 0.20);
  EXPECT_LE(figures.roughness, 0.008);
  EXPECT_LE(figures.max_influences, 8U);
  EXPECT_LE(figures.lip_leak, 0.10);
  EXPECT_LE(figures.lid_leak, 0.10);
  EXPECT_GE(figures.least, 0.0);
}

// Sums are one between the points, and the root takes all where no point is near: the neck, the back of the head.
TEST(RealExpressions_SmoothWeights, SumToOneOnTheFaceAndToNothingBehind) {
  const auto faces = oracle::faces_folder();
  if (!faces) GTEST_SKIP() << "no folder of real heads";
  const bench::ExpressionStudy study = bench::read_expression_study(*faces / "ict-facekit");
  const WeightTable<double> table = smooth_part_weights(study.surface, study.distances, study.eye_separation,
                                                        margin_sites(study.surface, study.distances.points));
  std::vector<bool> in_cavity(study.surface.vertex_count(), false);
  const PartId skin = study.surface.part_of[study.distances.members[0].value()];
  for (const Cavity& cavity : find_cavities(study.surface, skin, study.distances.points)) {
    for (const SurfaceVertexId v : cavity.members) in_cavity[v.value()] = true;
  }
  std::size_t front = 0;
  std::size_t whole = 0;
  for (std::size_t m = 0; m < study.member_count(); ++m) {
    const auto weights = table.weights_of(m);
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    EXPECT_LE(sum, 1.0 + 1e-12);
    if (in_cavity[study.distances.members[m].value()]) continue;  // the jaw moves the inside of the mouth
    double nearest = std::numeric_limits<double>::infinity();
    for (const SurfacePoint& point : study.distances.points) {
      nearest = std::min(nearest, glm::distance(study.position(m), point.position));
    }
    if (nearest > 1.05 * study.eye_separation) {
      EXPECT_TRUE(weights.empty());
    }
    // From brows to chin boss and from eye corner to eye corner.
    const glm::dvec3 p = study.position(m);
    if (std::abs(p.x) < 4.5 && p.y > -5.5 && p.y < 6.0 && p.z > 8.5) {
      ++front;
      whole += sum > 0.999 ? 1 : 0;
    }
  }
  EXPECT_GT(whole, front * 85 / 100);
}

}  // namespace
}  // namespace semblante
