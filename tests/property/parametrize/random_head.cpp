#include "tests/property/parametrize/random_head.h"

#include <algorithm>
#include <numeric>

#include "tests/support/meshes.h"

namespace semblante::testing {
namespace {

bool chance(std::mt19937& random, double p) { return std::uniform_real_distribution<double>(0, 1)(random) < p; }

std::uint32_t pick(std::mt19937& random, std::size_t count) {
  return std::uniform_int_distribution<std::uint32_t>(0, static_cast<std::uint32_t>(count - 1))(random);
}

/// Gives some corners a vertex of their own, as a seam of texture coordinates does.
void split_corners(std::mt19937& random, Model& model) {
  for (Triangle& t : model.triangles) {
    if (!chance(random, 0.1)) continue;
    for (std::uint32_t& corner : t) {
      model.positions.push_back(model.positions[corner]);
      corner = static_cast<std::uint32_t>(model.positions.size() - 1);
    }
  }
}

}  // namespace

Model make_landscape(std::mt19937& random, std::uint32_t side, int heights, const Roughness& roughness) {
  Model model = make_grid(side, side);
  std::uniform_int_distribution<int> up(0, heights);
  std::uniform_int_distribution<int> shift(-20, 20);
  for (glm::vec3& p : model.positions) {
    if (heights > 0) p += glm::vec3(shift(random), shift(random), up(random)) / 64.0F;
  }
  if (roughness.seams) split_corners(random, model);
  const std::size_t regular = model.triangles.size();
  for (std::size_t t = 0; t < regular; ++t) {
    const Triangle triangle = model.triangles[t];
    if (roughness.duplicates && chance(random, 0.1)) model.triangles.push_back({triangle[1], triangle[2], triangle[0]});
    if (roughness.degenerate && chance(random, 0.1)) {
      model.triangles.push_back({triangle[0], triangle[1], triangle[1]});
      const auto twin = static_cast<std::uint32_t>(model.positions.size());
      model.positions.push_back(model.positions[triangle[0]]);
      model.triangles.push_back({triangle[0], twin, triangle[1]});
      if (chance(random, 0.5)) model.triangles.push_back({twin, triangle[0], triangle[2]});
    }
    if (roughness.fins && chance(random, 0.05)) {
      const auto tip = static_cast<std::uint32_t>(model.positions.size());
      model.positions.push_back(model.positions[triangle[0]] + glm::vec3(0, 0, 1));
      model.triangles.push_back({triangle[0], triangle[1], tip});
    }
  }
  model.primitives.back().triangle_count = static_cast<std::uint32_t>(model.triangles.size());
  if (roughness.loose) {
    model.positions.emplace_back(1.5F, 1.5F, 0.25F);
    append(model, make_grid(2, 2), "");
  }
  return model;
}

FeaturePointSet mark_points(std::mt19937& random, const Model& model, std::size_t count) {
  std::vector<std::uint8_t> ids(feature_point_count);
  std::iota(ids.begin(), ids.end(), std::uint8_t{0});
  std::shuffle(ids.begin(), ids.end(), random);
  ids.resize(count);
  std::sort(ids.begin(), ids.end());
  FeaturePointSet points;
  for (const std::uint8_t id : ids) {
    const std::uint32_t vertex = pick(random, model.positions.size());
    points.push_back({FeaturePointId(id), VertexId(vertex), model.positions[vertex]});
  }
  return points;
}

}  // namespace semblante::testing
