// What must hold for weights whatever the mesh: they equal the literal reading of the text, lie in (0, 1], are 1 at
// their point, and know nothing of vertex order, size or place.

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "core/parametrize/surface_weights.h"
#include "tests/oracle/literal_weights.h"
#include "tests/property/parametrize/random_head.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

using testing::make_landscape;
using testing::mark_points;
using testing::Roughness;

constexpr int seeds = 25;

WeightTable<double> weights_of(const Model& model, const FeaturePointSet& points) {
  const Surface surface = build_surface(model);
  const auto weights = surface_weights(surface, surface_points(surface, points));
  EXPECT_TRUE(weights);
  return rows_of_file_vertices(surface, weights->rows);
}

std::map<FeaturePointId, double> row_of(const WeightTable<double>& table, std::size_t vertex) {
  std::map<FeaturePointId, double> row;
  const auto ids = table.points_of(vertex);
  for (std::size_t k = 0; k < ids.size(); ++k) row[ids[k]] = table.weights_of(vertex)[k];
  return row;
}

void expect_same_row(const WeightTable<double>& a, std::size_t in_a, const WeightTable<double>& b, std::size_t in_b,
                     double tolerance) {
  const auto left = row_of(a, in_a);
  const auto right = row_of(b, in_b);
  ASSERT_EQ(left.size(), right.size()) << "vertex " << in_a;
  for (const auto& [id, weight] : left) {
    ASSERT_TRUE(right.contains(id)) << "vertex " << in_a << ", point " << to_string(id);
    ASSERT_NEAR(weight, right.at(id), tolerance) << "vertex " << in_a << ", point " << to_string(id);
  }
}

void expect_oracle(const Model& model, const FeaturePointSet& points) {
  oracle::Mesh mesh;
  for (const glm::vec3& p : model.positions) mesh.positions.push_back({p.x, p.y, p.z});
  mesh.triangles.assign(model.triangles.begin(), model.triangles.end());
  std::map<oracle::PointName, std::uint32_t> marked;
  for (const FeaturePoint& p : points) marked[{group_of(p.id), number_of(p.id)}] = p.vertex->value();
  const oracle::LiteralResult expected = oracle::literal_weights(mesh, marked);

  const WeightTable<double> table = weights_of(model, points);
  for (std::size_t v = 0; v < model.positions.size(); ++v) {
    // On a lattice d_iP and d of Eq. 4 are often equal but for the order of a sum: such a weight is zero up to
    // rounding, and may be in one row and not in the other.
    std::map<oracle::PointName, double> row;
    for (const auto& [id, weight] : row_of(table, v)) {
      if (weight > 1e-12) row[{group_of(id), number_of(id)}] = weight;
    }
    std::size_t expected_count = 0;
    for (const auto& [name, weight] : expected.weights[v]) {
      if (weight <= 1e-12) continue;
      ++expected_count;
      ASSERT_TRUE(row.contains(name)) << "vertex " << v << ", point " << name.first << "." << name.second;
      ASSERT_NEAR(row.at(name), weight, 1e-9) << "vertex " << v;
    }
    ASSERT_EQ(row.size(), expected_count) << "vertex " << v;
  }
}

TEST(WeightProperties, RandomLandscapes_EqualTheOracle) {
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(static_cast<unsigned>(seed));
    const Model model = make_landscape(random, 12, 64);
    ASSERT_NO_FATAL_FAILURE(expect_oracle(model, mark_points(random, model, 15)));
  }
}

TEST(WeightProperties, FlatGridsFullOfTiesAndRightAngles_EqualTheOracle) {
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(static_cast<unsigned>(seed));
    const Model model = make_landscape(random, 10, 0);
    ASSERT_NO_FATAL_FAILURE(expect_oracle(model, mark_points(random, model, 20)));
  }
}

TEST(WeightProperties, RoughMeshes_EqualTheOracle) {
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(static_cast<unsigned>(seed));
    const Roughness roughness{true, true, true, true, true};
    const Model model = make_landscape(random, 8, seed % 2 == 0 ? 64 : 0, roughness);
    ASSERT_NO_FATAL_FAILURE(expect_oracle(model, mark_points(random, model, 12)));
  }
}

TEST(WeightProperties, LieAboveZeroUpToOne_AndAreOneAtTheirPoint) {
  for (int seed = 0; seed < seeds; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    const Model model = make_landscape(random, 15, 64, {true, true, true, true, true});
    const FeaturePointSet points = mark_points(random, model, 30);
    const WeightTable<double> table = weights_of(model, points);
    for (const double w : table.weights) {
      ASSERT_GT(w, 0.0);
      ASSERT_LE(w, 1.0);
    }
    for (const FeaturePoint& point : points) {
      const auto row = row_of(table, point.vertex->value());
      ASSERT_TRUE(row.contains(point.id));
      for (const auto& [id, weight] : row) ASSERT_EQ(weight, 1.0);
    }
  }
}

TEST(WeightProperties, OrderOfVerticesAndTriangles_ChangesNothing) {
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(static_cast<unsigned>(seed));
    // Flat ones too: exact ties are where an order would show.
    const Model model = make_landscape(random, 12, seed % 2 == 0 ? 64 : 0, {true, true, false, true, true});
    const FeaturePointSet points = mark_points(random, model, 15);

    std::vector<std::uint32_t> new_of(model.positions.size());
    std::iota(new_of.begin(), new_of.end(), 0U);
    std::shuffle(new_of.begin(), new_of.end(), random);
    Model shuffled;
    shuffled.positions.resize(model.positions.size());
    for (std::uint32_t v = 0; v < new_of.size(); ++v) shuffled.positions[new_of[v]] = model.positions[v];
    for (const Triangle& t : model.triangles) shuffled.triangles.push_back({new_of[t[1]], new_of[t[2]], new_of[t[0]]});
    std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), random);
    FeaturePointSet moved = points;
    for (FeaturePoint& p : moved) p.vertex = VertexId(new_of[p.vertex->value()]);

    const WeightTable<double> before = weights_of(model, points);
    const WeightTable<double> after = weights_of(shuffled, moved);
    for (std::uint32_t v = 0; v < new_of.size(); ++v) {
      ASSERT_NO_FATAL_FAILURE(expect_same_row(before, v, after, new_of[v], 1e-12));
    }
  }
}

TEST(WeightProperties, SizePlaceAndAttitude_ChangeNothing) {
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(static_cast<unsigned>(seed));
    const Model model = make_landscape(random, 12, seed % 2 == 0 ? 64 : 0, {true, false, false, true, true});
    const FeaturePointSet points = mark_points(random, model, 15);
    const WeightTable<double> before = weights_of(model, points);
    // All exact in float32: these test the method, not the rounding of a moved file.
    const std::vector<std::function<glm::vec3(glm::vec3)>> motions = {
        [](glm::vec3 p) { return 1024.0F * p; },
        [](glm::vec3 p) { return p / 4096.0F; },
        [](glm::vec3 p) { return p + glm::vec3(32, -64, 16); },
        [](glm::vec3 p) { return glm::vec3(p.y, p.z, p.x); },
        [](glm::vec3 p) { return glm::vec3(-p.y, p.x, p.z); },
    };
    for (std::size_t m = 0; m < motions.size(); ++m) {
      SCOPED_TRACE(m);
      Model moved = model;
      for (glm::vec3& p : moved.positions) p = motions[m](p);
      const WeightTable<double> after = weights_of(moved, points);
      for (std::size_t v = 0; v < model.positions.size(); ++v) {
        ASSERT_NO_FATAL_FAILURE(expect_same_row(before, v, after, v, 1e-12));
      }
    }
  }
}

TEST(WeightProperties, MirrorImage_HasMirroredWeights) {
  // With the ids kept on their own vertices: no exact tie, so ids decide nothing.
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(static_cast<unsigned>(seed));
    const Model model = make_landscape(random, 12, 64);
    const FeaturePointSet points = mark_points(random, model, 15);
    Model mirrored = model;
    for (glm::vec3& p : mirrored.positions) p.x = -p.x;
    const WeightTable<double> before = weights_of(model, points);
    const WeightTable<double> after = weights_of(mirrored, points);
    for (std::size_t v = 0; v < model.positions.size(); ++v) {
      ASSERT_NO_FATAL_FAILURE(expect_same_row(before, v, after, v, 1e-12));
    }
  }
}

}  // namespace
}  // namespace semblante
