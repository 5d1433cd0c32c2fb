#include "core/parametrize/smooth_weights.h"

#include <numeric>

#include <gtest/gtest.h>

#include "core/parametrize/site_kriging.h"
#include "core/parametrize/surface_weights.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

using testing::fp;
using Marks = std::initializer_list<std::pair<std::string_view, std::uint32_t>>;

constexpr std::uint32_t side = 40;
constexpr std::uint32_t at(std::uint32_t column, std::uint32_t row) { return row * (side + 1) + column; }

WeightTable<double> smooth(const Model& model, Marks marks, double eye_separation) {
  const Surface surface = build_surface(model);
  auto table = surface_weights(surface, surface_points(surface, testing::points_at(model, marks)), {},
                               {WeightMethod::smooth, eye_separation, nullptr});
  EXPECT_TRUE(table);
  return rows_of_file_vertices(surface, table->rows);
}

double weight_of(const WeightTable<double>& table, std::uint32_t vertex, std::string_view name) {
  for (std::size_t k = 0; k < table.points_of(vertex).size(); ++k) {
    if (table.points_of(vertex)[k] == fp(name)) return table.weights_of(vertex)[k];
  }
  return 0.0;
}

double sum_of(const WeightTable<double>& table, std::uint32_t vertex) {
  const auto w = table.weights_of(vertex);
  return std::accumulate(w.begin(), w.end(), 0.0);
}

// Points that bound no lip and no lid.
const Marks crowd = {{"5.1", at(10, 10)},  {"5.2", at(14, 10)},  {"5.3", at(18, 11)},  {"5.4", at(11, 14)},
                     {"9.1", at(15, 15)},  {"9.2", at(19, 14)},  {"9.3", at(9, 18)},   {"9.4", at(14, 19)},
                     {"9.5", at(18, 18)},  {"9.12", at(22, 16)}, {"10.1", at(12, 12)}, {"10.2", at(16, 13)},
                     {"10.3", at(13, 16)}, {"10.4", at(17, 16)}, {"11.1", at(20, 20)}, {"11.2", at(16, 22)},
                     {"11.3", at(12, 22)}};

TEST(SmoothWeights_Rows, ArePositiveAtMostEightAndAtMostOne) {
  const auto table = smooth(testing::make_grid(side, side), crowd, 25.0);

  for (std::uint32_t v = 0; v < table.row_count(); ++v) {
    EXPECT_LE(table.points_of(v).size(), max_smooth_influences);
    for (const double w : table.weights_of(v)) EXPECT_GT(w, 0.0);
    EXPECT_LE(sum_of(table, v), 1.0 + 1e-12);
  }
  EXPECT_NEAR(sum_of(table, at(15, 14)), 1.0, 1e-12);  // amid the points
  EXPECT_TRUE(table.points_of(at(40, 40)).empty());
}

TEST(SmoothWeights_Rows, OfAModelledEyeAreEmptyAndTheOthersStay) {
  const Model model = testing::make_grid(side, side);
  const Surface surface = build_surface(model);
  const auto held = surface.surface_of[at(15, 14)];
  WeightOptions options{WeightMethod::smooth, 25.0, nullptr};
  options.modelled_eyes[1] = ModelledEye{{held}, {}, {}, {}, std::nullopt};
  const auto rows = surface_weights(surface, surface_points(surface, testing::points_at(model, crowd)), {}, options);
  ASSERT_TRUE(rows);
  const auto free = smooth(model, crowd, 25.0);
  EXPECT_GT(sum_of(free, at(15, 14)), 0.9);
  EXPECT_TRUE(rows->rows.points_of(held.value()).empty());
  for (const std::uint32_t v : {at(14, 14), at(16, 14), at(15, 13)})
    EXPECT_EQ(sum_of(rows->rows, surface.surface_of[v].value()), sum_of(free, v));
}

// Twelve points on a circle are equally far from its centre: only eight have a place, and the sum must not suffer.
TEST(SmoothWeights_Rows, KeepTheirSumWhereMoreThanEightPointsAreEquallyFar) {
  const auto table = smooth(testing::make_grid(side, side),
                            {{"5.1", at(25, 20)},
                             {"5.2", at(24, 23)},
                             {"5.3", at(23, 24)},
                             {"5.4", at(20, 25)},
                             {"9.1", at(17, 24)},
                             {"9.2", at(16, 23)},
                             {"9.3", at(15, 20)},
                             {"9.4", at(16, 17)},
                             {"9.5", at(17, 16)},
                             {"9.12", at(20, 15)},
                             {"10.1", at(23, 16)},
                             {"10.2", at(24, 17)}},
                            60.0);
  EXPECT_EQ(table.points_of(at(20, 20)).size(), max_smooth_influences);
  EXPECT_GT(sum_of(table, at(20, 20)), 0.9);
  EXPECT_NEAR(sum_of(table, at(20, 20)), sum_of(table, at(21, 20)), 0.05);
}

TEST(SmoothWeights_Rows, AreOneAtAPointsOwnVertex) {
  const auto table = smooth(testing::make_grid(side, side), crowd, 25.0);
  for (const auto& [name, vertex] : crowd) {
    ASSERT_EQ(table.points_of(vertex).size(), 1U);
    EXPECT_EQ(weight_of(table, vertex, name), 1.0);
  }
}

TEST(SmoothWeights_Rows, AreSharedByPointsAtOneVertex) {
  const auto table =
      smooth(testing::make_grid(side, side), {{"2.1", at(20, 20)}, {"2.10", at(20, 20)}, {"2.2", at(26, 20)}}, 25.0);
  EXPECT_EQ(weight_of(table, at(20, 20), "2.1"), 0.5);
  EXPECT_EQ(weight_of(table, at(20, 20), "2.10"), 0.5);
  // Beside the vertex the prior tells the two apart, by little.
  EXPECT_NEAR(weight_of(table, at(22, 20), "2.1"), weight_of(table, at(22, 20), "2.10"), 0.03);
}

// Otherwise a mouth that is a line of single vertices would become a zigzag when it opens.
TEST(SmoothWeights_Rows, AreThoseOfBothLipsAtPointsOnTheLineOfBoth) {
  const auto table = smooth(testing::make_grid(side, side),
                            {{"2.4", at(30, 20)},
                             {"2.5", at(10, 20)},
                             {"2.2", at(20, 20)},
                             {"2.3", at(20, 20)},
                             {"2.6", at(22, 20)},
                             {"2.7", at(18, 20)},
                             {"2.8", at(24, 20)},
                             {"2.9", at(16, 20)}},
                            20.0);
  EXPECT_EQ(weight_of(table, at(22, 20), "2.6"), 0.5);
  EXPECT_EQ(weight_of(table, at(22, 20), "2.3"), 0.25);
  EXPECT_EQ(weight_of(table, at(22, 20), "2.8"), 0.25);
  EXPECT_EQ(weight_of(table, at(20, 20), "2.2"), 0.5);
  EXPECT_EQ(weight_of(table, at(30, 20), "2.4"), 1.0);
}

// What lies behind a lip follows the lip less the deeper it lies, and the jaw on the lower side.
TEST(SmoothWeights_Rows, PassToJawAndSkullBehindALip) {
  const auto table = smooth(testing::make_grid(side, side),
                            {{"2.4", at(30, 20)},
                             {"2.5", at(10, 20)},
                             {"2.6", at(28, 28)},
                             {"2.7", at(12, 28)},
                             {"2.8", at(28, 12)},
                             {"2.9", at(12, 12)},
                             {"2.1", at(20, 3)}},
                            20.0);
  EXPECT_GT(weight_of(table, at(20, 15), "2.1"), weight_of(table, at(20, 25), "2.1") + 0.1);
  EXPECT_LT(sum_of(table, at(20, 24)), sum_of(table, at(20, 28)) - 0.1);
}

// On a mesh four times finer, steps between neighbours shrink: a jump would not.
TEST(SmoothWeights_Rows, HaveNoSteps) {
  const auto greatest_step = [](std::uint32_t fine) {
    Model model = testing::make_grid(side * fine, side * fine);
    for (glm::vec3& p : model.positions) p /= static_cast<float>(fine);
    const auto fine_at = [&](std::uint32_t v) {
      return (v / (side + 1)) * fine * (side * fine + 1) + (v % (side + 1)) * fine;
    };
    FeaturePointSet points = testing::points_at(testing::make_grid(side, side), crowd);
    for (FeaturePoint& p : points) p.vertex = VertexId(fine_at(p.vertex->value()));
    const Surface surface = build_surface(model);
    const auto table =
        surface_weights(surface, surface_points(surface, points), {}, {WeightMethod::smooth, 25.0, nullptr})
            .value()
            .rows;
    double greatest = 0.0;
    for (std::uint32_t v = 0; v < table.row_count(); ++v) {
      for (const Surface::Step& step : surface.steps_from(SurfaceVertexId(v))) {
        for (const auto& [name, vertex] : crowd) {
          const double change = weight_of(table, v, name) - weight_of(table, step.to.value(), name);
          greatest = std::max(greatest, std::abs(change) / (step.length * fine));
        }
      }
    }
    return greatest;
  };
  EXPECT_LT(greatest_step(4), 0.45 * greatest_step(1));
}

TEST(SmoothWeights_Rows, DoNotDependOnScaleOrPlace) {
  const Model model = testing::make_grid(side, side);
  Model moved = model;
  for (glm::vec3& p : moved.positions) p = p * 8.0F + glm::vec3(3.0F, -2.0F, 9.0F);

  for (const bool known : {true, false}) {
    const auto here = smooth(model, crowd, known ? 25.0 : 0.0);
    const auto there = smooth(moved, crowd, known ? 200.0 : 0.0);
    for (std::uint32_t v = 0; v < here.row_count(); ++v) {
      for (const auto& [name, vertex] : crowd) {
        ASSERT_NEAR(weight_of(here, v, name), weight_of(there, v, name), 2e-4) << name << " at " << v;
      }
    }
  }
}

// Two lips: a grid cut between its middle rows from column 10 to column 30, open by a hundredth.
TEST(SmoothWeights_Rows, DoNotCrossACut) {
  Model model = testing::make_grid(side, side);
  constexpr std::uint32_t row = 20;
  std::vector<std::uint32_t> below(side + 1);
  for (std::uint32_t column = 11; column < 30; ++column) {
    below[column] = static_cast<std::uint32_t>(model.positions.size());
    model.positions.push_back(model.positions[at(column, row)] - glm::vec3(0.0F, 0.01F, 0.0F));
  }
  for (Triangle& t : model.triangles) {
    const float middle = (model.positions[t[0]].y + model.positions[t[1]].y + model.positions[t[2]].y) / 3.0F;
    if (middle > static_cast<float>(row)) continue;
    for (std::uint32_t& corner : t) {
      if (corner / (side + 1) == row && corner < at(side, side) && below[corner % (side + 1)] != 0) {
        corner = below[corner % (side + 1)];
      }
    }
  }
  const auto table =
      smooth(model, {{"2.2", at(20, row)}, {"2.3", below[20]}, {"2.5", at(10, row)}, {"2.4", at(30, row)}}, 30.0);

  for (std::uint32_t column = 16; column <= 24; ++column) {
    EXPECT_LT(weight_of(table, at(column, row), "2.3"), 0.02) << column;
    EXPECT_GT(weight_of(table, at(column, row), "2.2"), 0.4) << column;
    EXPECT_LT(weight_of(table, below[column], "2.2"), 0.02) << column;
    EXPECT_GT(weight_of(table, below[column], "2.3"), 0.4) << column;
  }
}

TEST(KernelTable, AnyDistance_IsTheKernels) {
  const KrigingKernel kernel = {0.4, 1.2, 0.05};
  const KernelTable table(kernel);
  for (int i = 0; i < 100'000; ++i) {
    const double distance = kernel.reach() * i / 100'000.0;
    ASSERT_NEAR(table.at(distance), kernel.at(distance), 1e-8) << distance;
  }
}

}  // namespace
}  // namespace semblante
