#include "core/parametrize/fitted_weights.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "core/parametrize/own_shapes.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/smooth_weights.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

constexpr std::uint32_t columns = 20;
constexpr std::uint32_t place(std::uint32_t column, std::uint32_t row) { return row * (columns + 1) + column; }
constexpr double length_unit = 12.0;

/// A square of skin with four points. In its shapes each vertex follows the left point by a share that falls linearly
/// from left to right, which is not what smooth weights say.
class FittedWeights_OnSkin : public ::testing::Test {
 protected:
  FittedWeights_OnSkin() : model_(testing::make_grid(columns, columns)), surface_(build_surface(model_)) {
    points_ = testing::points_at(
        model_, {{"2.1", place(2, 10)}, {"2.2", place(18, 10)}, {"2.3", place(10, 2)}, {"3.1", place(10, 18)}});
    on_surface_ = surface_points(surface_, points_);
    distances_ = measure_distances(surface_, PartId(0), on_surface_);
    smooth_ = smooth_part_weights(surface_, distances_, length_unit, {}, {});
    free_.assign(smooth_.row_count(), 1.0);
    add_shape("left forward", {0.0F, 0.0F, 1.0F});
    add_shape("left up", {0.0F, 2.0F, 0.0F});
    add_shape("left aside", {1.0F, 0.5F, 0.0F});
  }

  [[nodiscard]] double truth(std::uint32_t vertex) const {
    const double x = static_cast<double>(vertex % (columns + 1));
    return std::clamp((18.0 - x) / 16.0, 0.0, 1.0);
  }

  void add_shape(const char* name, const glm::vec3& by) {
    Example shape{name, {}, {}};
    for (std::uint32_t v = 0; v < model_.positions.size(); ++v) {
      const bool is_other_point = v == place(10, 2) || v == place(10, 18);
      if (is_other_point || !(truth(v) > 0.0)) continue;
      shape.vertices.push_back(v);
      shape.displacements.push_back(static_cast<float>(truth(v)) * by);
    }
    model_.examples.push_back(std::move(shape));
  }

  [[nodiscard]] FittedWeights fit() const {
    const OwnShapes own = own_shapes(model_, surface_, on_surface_);
    return fit_part_weights(distances_, smooth_, free_, shapes_of_members(own.shapes, distances_.members), length_unit)
        .value();
  }

  static double weight_of(const WeightTable<double>& rows, std::size_t row, std::string_view name) {
    for (std::size_t k = 0; k < rows.points_of(row).size(); ++k) {
      if (rows.points_of(row)[k] == *parse_feature_point(name)) return rows.weights_of(row)[k];
    }
    return 0.0;
  }

  [[nodiscard]] double error_of(const WeightTable<double>& rows) const {
    double sum = 0.0;
    for (std::uint32_t v = 0; v < rows.row_count(); ++v) sum += std::abs(weight_of(rows, v, "2.1") - truth(v));
    return sum / static_cast<double>(rows.row_count());
  }

  Model model_;
  Surface surface_;
  FeaturePointSet points_;
  std::vector<SurfacePoint> on_surface_;
  PointDistances distances_;
  WeightTable<double> smooth_;
  std::vector<double> free_;
};

TEST_F(FittedWeights_OnSkin, ComeNearTheHeadsOwnMotion) {
  const FittedWeights fitted = fit();

  EXPECT_LT(error_of(fitted.rows), 0.5 * error_of(smooth_));
  ASSERT_EQ(fitted.errors.size(), 3U);
  for (const ShapeError& shape : fitted.errors) {
    EXPECT_GT(shape.moved, 0.0) << shape.name;
    // The other two shapes show the same motion.
    EXPECT_LT(shape.wrong, 0.5 * shape.smooth_wrong) << shape.name;
  }
}

TEST_F(FittedWeights_OnSkin, AreSharesOfAtMostEightPoints) {
  const FittedWeights fitted = fit();

  for (std::size_t row = 0; row < fitted.rows.row_count(); ++row) {
    const auto weights = fitted.rows.weights_of(row);
    EXPECT_LE(weights.size(), max_smooth_influences);
    for (const double w : weights) EXPECT_GT(w, 0.0);
    EXPECT_LE(std::accumulate(weights.begin(), weights.end(), 0.0), 1.0 + 1e-12);
  }
}

TEST_F(FittedWeights_OnSkin, AreExactAtPoints) {
  const FittedWeights fitted = fit();

  for (const auto& [name, vertex] : {std::pair{"2.1", place(2, 10)}, {"2.2", place(18, 10)}, {"3.1", place(10, 18)}}) {
    EXPECT_EQ(fitted.rows.points_of(vertex).size(), 1U) << name;
    EXPECT_NEAR(weight_of(fitted.rows, vertex, name), 1.0, 1e-4);
  }
}

TEST_F(FittedWeights_OnSkin, AreSmoothWhereShapesTeachNothing) {
  model_.examples.clear();
  Example shape{"far from all points", {place(0, 0)}, {glm::vec3(1.0F)}};
  const std::vector<Example> shapes = {shape};

  const FittedWeights fitted = fit_part_weights(distances_, smooth_, free_, shapes, length_unit).value();

  EXPECT_EQ(fitted.rows.offsets, smooth_.offsets);
  EXPECT_EQ(fitted.rows.weights, smooth_.weights);
  EXPECT_EQ(fitted.errors[0].moved, 0.0);
}

// The error of a shape does not see the shape: what moves only in it cannot be predicted.
TEST_F(FittedWeights_OnSkin, LeaveEachShapeOutOfItsOwnError) {
  model_.examples.resize(1);

  const FittedWeights fitted = fit();

  ASSERT_EQ(fitted.errors.size(), 1U);
  EXPECT_NEAR(fitted.errors[0].wrong, fitted.errors[0].smooth_wrong, 0.01 * fitted.errors[0].smooth_wrong);
}

TEST_F(FittedWeights_OnSkin, StaySmoothWhereTheyAreHeld) {
  free_.assign(smooth_.row_count(), 0.0);

  const FittedWeights fitted = fit();

  ASSERT_EQ(fitted.rows.offsets, smooth_.offsets);
  for (std::size_t k = 0; k < smooth_.weights.size(); ++k) {
    EXPECT_DOUBLE_EQ(fitted.rows.weights[k], smooth_.weights[k]);
  }
}

TEST_F(FittedWeights_OnSkin, AreHeldAtTheEdgesOfLipsAndLids) {
  const std::vector<MarginSite> margins = {{SurfaceVertexId(place(10, 10)), {}}};

  const std::vector<double> freedom = freedom_of_members(surface_, distances_, margins, 50.0);

  EXPECT_EQ(freedom[place(10, 10)], 0.0);
  EXPECT_GT(freedom[place(12, 10)], 0.1);
  EXPECT_LT(freedom[place(12, 10)], 0.9);
  EXPECT_EQ(freedom[place(17, 10)], 1.0);
}

TEST_F(FittedWeights_OnSkin, AreHeldOnAnEyeThatIsModelledInTheSkin) {
  ModelledEyes modelled;
  modelled[0] = ModelledEye{{SurfaceVertexId(place(10, 10))}, {}, {}, {}, std::nullopt};

  const std::vector<double> freedom = freedom_of_members(surface_, distances_, {}, 50.0, modelled);

  EXPECT_EQ(freedom[place(10, 10)], 0.0);
  EXPECT_EQ(freedom[place(11, 10)], 1.0);
}

TEST_F(FittedWeights_OnSkin, AreCancelled) {
  const auto stopped = fit_part_weights(distances_, smooth_, free_, model_.examples, length_unit, 1,
                                        [](double, std::string_view) { return false; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
}

TEST_F(FittedWeights_OnSkin, IgnoreShapesThatMoveNoPointOrAll) {
  Example all{"another person", {}, {}};
  for (std::uint32_t v = 0; v < model_.positions.size(); ++v) {
    all.vertices.push_back(v);
    all.displacements.emplace_back(0.1F);
  }
  model_.examples.push_back(all);
  model_.examples.push_back({"no point", {place(0, 0)}, {glm::vec3(1.0F)}});

  const OwnShapes own = own_shapes(model_, surface_, on_surface_);

  EXPECT_EQ(own.shapes.size(), 3U);
  EXPECT_EQ(own.ignored, (std::vector<std::string>{"another person", "no point"}));
}

TEST_F(FittedWeights_OnSkin, AreThoseOfTheRig) {
  ParametrizeOptions options;
  options.weights = WeightMethod::fitted;
  const auto rig = parametrize(model_, surface_, points_, options);
  ASSERT_TRUE(rig) << rig.error().message;
  ASSERT_TRUE(rig->fit);
  EXPECT_EQ(rig->fit->shapes.size(), 3U);
  EXPECT_LT(rig->fit->error(), rig->fit->smooth_error());

  model_.examples.clear();
  const auto refused = parametrize(model_, surface_, points_, options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::missing);
  EXPECT_EQ(refused.error().where, "/weights");
  EXPECT_NE(refused.error().message.find("morph targets"), std::string::npos);
}

}  // namespace
}  // namespace semblante
