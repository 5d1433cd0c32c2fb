#include "core/geometry/sparse_cholesky.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/geometry/surface.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

/// The Laplacian of a grid's edges, plus a small diagonal.
struct GridSystem {
  Surface surface;
  SparseMatrix matrix;

  /// `strength`: of the edges between the vertices of the first rows.
  explicit GridSystem(std::uint32_t side, double strength = 1.0)
      : surface(build_surface(testing::make_grid(side, side))) {
    const std::uint32_t strong = 3 * side;
    for (std::uint32_t v = 0; v < surface.vertex_count(); ++v) {
      double sum = 0.01;
      for (const Surface::Step& step : surface.steps_from(SurfaceVertexId(v))) {
        const double weight = (1.0 + 0.1 * static_cast<double>((v + step.to.value()) % 7)) *
                              (std::max(v, step.to.value()) < strong ? strength : 1.0);
        sum += weight;
        matrix.entries.push_back({step.to.value(), -weight});
      }
      matrix.diagonal.push_back(sum);
      matrix.offsets.push_back(static_cast<std::uint32_t>(matrix.entries.size()));
    }
  }
};

/// The greatest difference of the matrix times its solutions from the right-hand sides, which are from 0 to 2.
double residual(const GridSystem& system) {
  const std::size_t count = system.matrix.diagonal.size();
  constexpr std::size_t width = 2;
  std::vector<glm::vec4> right;
  for (std::size_t i = 0; i < count * width; ++i) {
    const auto at = static_cast<float>(i);
    right.emplace_back(1.0F + std::sin(at), 1.0F + std::cos(at), static_cast<float>(i % 3), 1.0F);
  }
  std::vector<glm::vec4> rows = right;
  solve_by_cholesky(system.matrix, rows, width);
  double greatest = 0.0;
  for (std::size_t r = 0; r < count; ++r) {
    for (std::size_t b = 0; b < width; ++b) {
      glm::dvec4 sum = system.matrix.diagonal[r] * glm::dvec4(rows[r * width + b]);
      for (const SparseMatrix::Entry& e : system.matrix.row(r)) sum += e.value * glm::dvec4(rows[e.column * width + b]);
      for (int c = 0; c < 4; ++c)
        greatest = std::max(greatest, std::abs(sum[c] - static_cast<double>(right[r * width + b][c])));
    }
  }
  return greatest;
}

TEST(SparseCholesky, SolutionsOfAGrid_SolveTheEquations) {
  for (const std::uint32_t side : {1U, 2U, 20U}) {
    // The solutions are up to 100: single precision.
    EXPECT_LT(residual(GridSystem(side)), 1e-3) << side;
  }
}

TEST(SparseCholesky, EdgesAMillionTimesAsStrong_LeaveTheOthersExact) {
  const GridSystem system(20, 1e6);
  // What the diagonal has beyond a row's edges, so that each solution is one.
  std::vector<glm::vec4> rows(system.matrix.diagonal.size(), glm::vec4(0.01F));
  solve_by_cholesky(system.matrix, rows, 1);
  for (const glm::vec4& row : rows) EXPECT_NEAR(row.x, 1.0F, 1e-3F);
}

TEST(SparseCholesky, EdgesSoStrongThatRoundingTakesThePivots_GiveFiniteSolutions) {
  const GridSystem system(20, 1e20);
  std::vector<glm::vec4> rows(system.matrix.diagonal.size(), glm::vec4(0.01F));
  solve_by_cholesky(system.matrix, rows, 1);
  for (std::size_t r = 0; r < rows.size(); ++r) EXPECT_TRUE(std::isfinite(rows[r].x)) << r;
}

TEST(SparseCholesky, NoEquations_AreSolved) { solve_by_cholesky({}, {}, 1); }

}  // namespace
}  // namespace semblante
