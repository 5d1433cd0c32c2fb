#include "tests/support/meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>

namespace semblante::testing {

Model make_model(std::vector<glm::vec3> positions, std::vector<Triangle> triangles, std::string name) {
  Model model;
  model.positions = std::move(positions);
  model.triangles = std::move(triangles);
  model.primitives.push_back({std::move(name), -1, 0, static_cast<std::uint32_t>(model.triangles.size())});
  return model;
}

Model make_strip(std::uint32_t squares) {
  std::vector<glm::vec3> positions;
  std::vector<Triangle> triangles;
  for (std::uint32_t row = 0; row < 2; ++row) {
    for (std::uint32_t k = 0; k <= squares; ++k) positions.emplace_back(k, row, 0);
  }
  const std::uint32_t top = squares + 1;
  for (std::uint32_t k = 0; k < squares; ++k) {
    triangles.push_back({k, k + 1, top + k});
    triangles.push_back({k + 1, top + k + 1, top + k});
  }
  return make_model(std::move(positions), std::move(triangles));
}

Model make_grid(std::uint32_t columns, std::uint32_t rows) {
  std::vector<glm::vec3> positions;
  std::vector<Triangle> triangles;
  for (std::uint32_t r = 0; r <= rows; ++r) {
    for (std::uint32_t c = 0; c <= columns; ++c) positions.emplace_back(c, r, 0);
  }
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) {
      const std::uint32_t low = r * (columns + 1) + c;
      const std::uint32_t high = low + columns + 1;
      triangles.push_back({low, low + 1, high});
      triangles.push_back({low + 1, high + 1, high});
    }
  }
  return make_model(std::move(positions), std::move(triangles));
}

Model make_ball(const glm::vec3& center, float radius, std::uint32_t slices, std::uint32_t stacks) {
  std::vector<glm::vec3> positions;
  std::vector<Triangle> triangles;
  positions.push_back(center + glm::vec3(0, radius, 0));
  for (std::uint32_t i = 1; i < stacks; ++i) {
    const double down = std::numbers::pi * i / stacks;
    for (std::uint32_t j = 0; j < slices; ++j) {
      const double round = 2.0 * std::numbers::pi * j / slices;
      positions.push_back(center + radius * glm::vec3(std::sin(down) * std::sin(round), std::cos(down),
                                                      std::sin(down) * std::cos(round)));
    }
  }
  positions.push_back(center - glm::vec3(0, radius, 0));
  const auto at = [&](std::uint32_t ring, std::uint32_t j) { return 1 + (ring - 1) * slices + j % slices; };
  const auto south = static_cast<std::uint32_t>(positions.size() - 1);
  for (std::uint32_t j = 0; j < slices; ++j) {
    triangles.push_back({0, at(1, j), at(1, j + 1)});
    for (std::uint32_t i = 1; i + 1 < stacks; ++i) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    triangles.push_back({at(stacks - 1, j), south, at(stacks - 1, j + 1)});
  }
  return make_model(std::move(positions), std::move(triangles));
}

Model make_box(const glm::vec3& low, const glm::vec3& high) {
  std::vector<glm::vec3> positions;
  for (int corner = 0; corner < 8; ++corner) {
    positions.emplace_back((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                           (corner & 4) != 0 ? high.z : low.z);
  }
  return make_model(std::move(positions), {{0, 2, 1},
                                           {1, 2, 3},
                                           {4, 5, 6},
                                           {5, 7, 6},
                                           {0, 1, 4},
                                           {1, 5, 4},
                                           {2, 6, 3},
                                           {3, 6, 7},
                                           {0, 4, 2},
                                           {2, 4, 6},
                                           {1, 3, 5},
                                           {3, 7, 5}});
}

namespace {

constexpr int mouth_columns = 6;  ///< either side of the middle
constexpr int mouth_rows = 4;
constexpr int mouth_corner = 2;
constexpr int mouth_depth = 4;

bool is_rim(int column, int row) { return row == 0 && std::abs(column) < mouth_corner; }

}  // namespace

std::uint32_t ClosedMouth::at(int column, int row, bool of_upper) const {
  const glm::vec3 place(column, row, 0.0F);
  const auto first = std::find(model.positions.begin(), model.positions.end(), place);
  // The lower rim's vertex comes right before the upper one's.
  return static_cast<std::uint32_t>(first - model.positions.begin()) + (of_upper && is_rim(column, row) ? 1U : 0U);
}

ClosedMouth make_closed_mouth() {
  ClosedMouth mouth{make_model({}, {})};
  for (int row = -mouth_rows; row <= mouth_rows; ++row) {
    for (int column = -mouth_columns; column <= mouth_columns; ++column) {
      for (int copies = is_rim(column, row) ? 2 : 1; copies > 0; --copies)
        mouth.model.positions.emplace_back(column, row, 0.0F);
    }
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mouth.model.triangles.push_back({a, b, c});
    mouth.model.triangles.push_back({a, c, d});
  };
  for (int row = -mouth_rows; row < mouth_rows; ++row) {
    for (int column = -mouth_columns; column < mouth_columns; ++column) {
      const bool above = row >= 0;
      add(mouth.at(column, row, above), mouth.at(column + 1, row, above), mouth.at(column + 1, row + 1, above),
          mouth.at(column, row + 1, above));
    }
  }
  // Behind the rims: two sheets that share the columns of the corners and the row at the bottom.
  std::map<std::array<int, 3>, std::uint32_t> behind;
  const auto at_depth = [&](int column, int depth, bool upper) {
    if (depth == 0) return mouth.at(column, 0, upper);
    const bool shared = std::abs(column) == mouth_corner || depth == mouth_depth;
    const auto [entry, is_new] = behind.try_emplace({column, depth, shared || upper ? 1 : 0},
                                                    static_cast<std::uint32_t>(mouth.model.positions.size()));
    if (is_new) mouth.model.positions.emplace_back(column, 0.0F, -depth);
    return entry->second;
  };
  for (const bool upper : {false, true}) {
    for (int depth = 0; depth < mouth_depth; ++depth) {
      for (int column = -mouth_corner; column < mouth_corner; ++column) {
        add(at_depth(column, depth, upper), at_depth(column + 1, depth, upper), at_depth(column + 1, depth + 1, upper),
            at_depth(column, depth + 1, upper));
      }
    }
  }
  mouth.model.primitives[0].triangle_count = static_cast<std::uint32_t>(mouth.model.triangles.size());
  return mouth;
}

Model shifted(Model model, const glm::vec3& by) {
  for (glm::vec3& p : model.positions) p += by;
  return model;
}

std::uint32_t append(Model& model, const Model& more, std::string name) {
  const auto first = static_cast<std::uint32_t>(model.positions.size());
  model.primitives.push_back({std::move(name), -1, static_cast<std::uint32_t>(model.triangles.size()),
                              static_cast<std::uint32_t>(more.triangles.size())});
  model.positions.insert(model.positions.end(), more.positions.begin(), more.positions.end());
  for (const Triangle& t : more.triangles) model.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return first;
}

FeaturePointId fp(std::string_view name) { return parse_feature_point(name).value(); }

MarkedPoint at_vertex(std::string_view name, std::uint32_t vertex) { return {fp(name), vertex, std::nullopt}; }

MarkedPoint at_position(std::string_view name, const glm::dvec3& position) {
  return {fp(name), std::nullopt, position};
}

FeaturePointSet points_at(const Model& model, const Marks& marks) {
  FeaturePointSet points;
  for (const auto& [name, vertex] : marks) {
    std::erase_if(points, [id = fp(name)](const FeaturePoint& p) { return p.id == id; });
    points.push_back({fp(name), VertexId(vertex), model.positions.at(vertex)});
  }
  std::sort(points.begin(), points.end(), [](const FeaturePoint& a, const FeaturePoint& b) { return a.id < b.id; });
  return points;
}

Marks with(Marks marks, const Marks& more) {
  marks.insert(marks.end(), more.begin(), more.end());
  return marks;
}

}  // namespace semblante::testing
