// What must hold for weights whatever the mesh: they equal the literal reading of the text, lie in (0, 1], are 1 at
// their point, and know nothing of vertex order, size or place.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "core/geometry/insert_vertices.h"
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

/// A mesh by the positions of its triangles' corners.
using Soup = std::vector<std::array<std::array<float, 3>, 3>>;

std::array<float, 3> key_of(const glm::vec3& p) { return {p.x, p.y, p.z}; }

/// Splits each triangle that has all corners with a share: the same mesh, but with the vertex in the file.
void draw_vertex(Soup& soup, const std::vector<std::array<float, 3>>& around, const std::array<float, 3>& vertex) {
  Soup drawn;
  for (const auto& triangle : soup) {
    const auto has = [&](const auto& corner) {
      return std::find(triangle.begin(), triangle.end(), corner) != triangle.end();
    };
    if (!std::all_of(around.begin(), around.end(), has)) {
      drawn.push_back(triangle);
      continue;
    }
    for (const auto& corner : around) {
      auto part = triangle;
      *std::find(part.begin(), part.end(), corner) = vertex;
      drawn.push_back(part);
    }
  }
  soup = std::move(drawn);
}

/// A model of the soup, one vertex a place, numbered at random.
Model model_of(Soup soup, std::mt19937& random, std::map<std::array<float, 3>, std::uint32_t>& numbers) {
  std::vector<std::array<float, 3>> places;
  for (const auto& triangle : soup) places.insert(places.end(), triangle.begin(), triangle.end());
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::shuffle(places.begin(), places.end(), random);
  std::shuffle(soup.begin(), soup.end(), random);
  Model model;
  for (const auto& p : places) {
    numbers[p] = static_cast<std::uint32_t>(model.positions.size());
    model.positions.emplace_back(p[0], p[1], p[2]);
  }
  for (const auto& t : soup) model.triangles.push_back({numbers[t[0]], numbers[t[1]], numbers[t[2]]});
  return model;
}

/// Triangles without a common place.
std::vector<std::uint32_t> separate_triangles(const Model& model, std::mt19937& random, std::size_t count) {
  std::vector<std::uint32_t> all(model.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  std::shuffle(all.begin(), all.end(), random);
  std::vector<std::uint32_t> chosen;
  std::vector<glm::vec3> taken;
  for (const std::uint32_t t : all) {
    const auto is_taken = [&](std::uint32_t v) {
      return std::find(taken.begin(), taken.end(), model.positions[v]) != taken.end();
    };
    if (chosen.size() == count || std::any_of(model.triangles[t].begin(), model.triangles[t].end(), is_taken)) continue;
    chosen.push_back(t);
    for (const std::uint32_t v : model.triangles[t]) taken.push_back(model.positions[v]);
  }
  return chosen;
}

TEST(WeightProperties, PointsBetweenVertices_WeighAsOnAMeshThatHadTheirVerticesFromTheStart) {
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(static_cast<unsigned>(seed));
    Roughness seams;
    seams.seams = seed % 3 == 0;
    Model model = make_landscape(random, 9, seed % 2 == 0 ? 64 : 0, seams);
    FeaturePointSet points = mark_points(random, model, 12);
    Soup soup;
    for (const Triangle& t : model.triangles)
      soup.push_back({key_of(model.positions[t[0]]), key_of(model.positions[t[1]]), key_of(model.positions[t[2]])});

    // The first points move between vertices: one in three onto an edge. Eighths are exact in float32.
    std::vector<TrianglePlace> places;
    for (const std::uint32_t t : separate_triangles(model, random, 5)) {
      const glm::dvec3 inside[] = {{0.25, 0.5, 0.25}, {0.625, 0.25, 0.125}};
      const glm::dvec3 shares = places.size() % 3 == 2 ? glm::dvec3(0.0, 0.375, 0.625) : inside[places.size() % 3];
      std::vector<std::array<float, 3>> around;
      glm::dvec3 position(0.0);
      for (int c = 0; c < 3; ++c) {
        const glm::vec3& corner = model.positions[model.triangles[t][static_cast<std::size_t>(c)]];
        position += shares[c] * glm::dvec3(corner);
        if (shares[c] > 0.0) around.push_back(key_of(corner));
      }
      draw_vertex(soup, around, key_of(glm::vec3(position)));
      places.push_back({t, shares});
    }
    const std::size_t before = build_surface(model).vertex_count();
    const Insertion inserted = insert_vertices(model, build_surface(model), places);
    ASSERT_EQ(build_surface(model).vertex_count(), before + places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      points[i].vertex = VertexId(inserted.vertex_of_place[i]);
      points[i].position = model.positions[inserted.vertex_of_place[i]];
    }

    std::map<std::array<float, 3>, std::uint32_t> numbers;
    const Model drawn = model_of(soup, random, numbers);
    FeaturePointSet on_drawn = points;
    for (FeaturePoint& point : on_drawn) {
      ASSERT_TRUE(numbers.contains(key_of(point.position)));
      point.vertex = VertexId(numbers[key_of(point.position)]);
    }
    const WeightTable<double> ours = weights_of(model, points);
    const WeightTable<double> theirs = weights_of(drawn, on_drawn);
    for (std::size_t v = 0; v < model.positions.size(); ++v)
      ASSERT_NO_FATAL_FAILURE(expect_same_row(ours, v, theirs, numbers[key_of(model.positions[v])], 1e-9));
    for (std::size_t i = 0; i < places.size(); ++i)
      ASSERT_EQ(row_of(ours, points[i].vertex->value()), (std::map{std::pair(points[i].id, 1.0)}));
    ASSERT_NO_FATAL_FAILURE(expect_oracle(model, points));
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
