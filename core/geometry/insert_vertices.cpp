#include "core/geometry/insert_vertices.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

#include "core/geometry/nearest_weights.h"
#include "core/geometry/smooth_normals.h"
#include "core/geometry/stitch.h"

namespace semblante {
namespace {

constexpr double at_vertex = 0.1;  ///< of the shorter edge at it
constexpr double at_edge = 0.05;   ///< of the opposite corner

template <class Vector>
Vector sum_of(const std::vector<Vector>& values, const InsertedVertex& vertex) {
  using Exact = glm::vec<Vector::length(), double>;
  Exact sum(0.0);
  // Without the corners of no share: they may have no value.
  for (std::size_t c = 0; c < 3; ++c) {
    if (vertex.shares[static_cast<int>(c)] != 0.0)
      sum += vertex.shares[static_cast<int>(c)] * Exact(values[vertex.corners[c]]);
  }
  return Vector(sum);
}

/// The corners with a share, in an order that does not depend on the triangle: equal for all triangles at an edge that
/// have these corners there.
Triangle key_of(Triangle corners, const glm::dvec3& shares) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (shares[static_cast<int>(c)] == 0.0) corners[c] = Model::no_index;
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

void make_smooth_normals(Model& model, const Surface& surface) {
  model.normals = smooth_normals(model, surface);
  model.normal_triangles.clear();
  for (const Triangle& t : model.triangles) {
    model.normal_triangles.push_back(
        {surface.surface_of[t[0]].value(), surface.surface_of[t[1]].value(), surface.surface_of[t[2]].value()});
  }
}

/// A model while vertices are inserted; `finish` puts its triangles in order.
class Splitter {
 public:
  Splitter(Model& model, const Surface& surface)
      : model_(model), given_(model.triangles), surface_of_(surface.surface_of), origins_(model.triangles.size()) {
    std::iota(origins_.begin(), origins_.end(), 0U);
    next_surface_vertex_ = static_cast<std::uint32_t>(surface.vertex_count());
  }

  std::uint32_t insert(const TrianglePlace& place) {
    const glm::dvec3 position = place_on(given_[place.triangle], place.shares);
    const auto [triangle, nearest] = part_at(place.triangle, position);
    const Triangle corners = model_.triangles[triangle];
    if (const auto corner = meant_corner(nearest, at(corners[0]), at(corners[1]), at(corners[2])))
      return corners[*corner];
    const glm::dvec3 shares = moved_to_edge(nearest);
    for (std::size_t c = 0; c < 3; ++c) {
      if (shares[static_cast<int>(c)] == 0.0) return split_edge(triangle, c, shares);
    }
    return split_inside(triangle, shares);
  }

  Insertion finish() && {
    put_in_order();
    for (Example& example : model_.examples) add_to(example);
    if (!model_.colors.empty()) add_colors();
    return std::move(result_);
  }

 private:
  [[nodiscard]] glm::dvec3 at(std::uint32_t vertex) const { return glm::dvec3(model_.positions[vertex]); }

  [[nodiscard]] glm::dvec3 place_on(const Triangle& t, const glm::dvec3& shares) const {
    return shares.x * at(t[0]) + shares.y * at(t[1]) + shares.z * at(t[2]);
  }

  /// Of the triangles that a given one was split into, the one at a position, and the position's shares there.
  [[nodiscard]] std::pair<std::uint32_t, glm::dvec3> part_at(std::uint32_t given, const glm::dvec3& position) const {
    std::pair<std::uint32_t, glm::dvec3> best{given, glm::dvec3(1.0, 0.0, 0.0)};
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](std::uint32_t triangle) {
      const Triangle& t = model_.triangles[triangle];
      const glm::dvec3 shares = nearest_weights(position, at(t[0]), at(t[1]), at(t[2]));
      const double away = glm::distance(position, place_on(t, shares));
      if (!(away < least)) return;
      least = away;
      best = {triangle, shares};
    };
    consider(given);
    for (auto t = static_cast<std::uint32_t>(given_.size()); t < origins_.size(); ++t) {
      if (origins_[t] == given) consider(t);
    }
    return best;
  }

  std::uint32_t add_vertex(const InsertedVertex& vertex, const glm::vec3& position, SurfaceVertexId on_surface) {
    model_.positions.push_back(position);
    surface_of_.push_back(on_surface);
    result_.vertices.push_back(vertex);
    return static_cast<std::uint32_t>(model_.positions.size() - 1);
  }

  /// The index of the attribute of a new vertex, from those of the corners with a share; `made`: those that exist.
  template <class Vector, class Make>
  static std::uint32_t add_attribute(std::vector<Vector>& values, const Triangle& corners, const glm::dvec3& shares,
                                     std::map<Triangle, std::uint32_t>& made, const Make& make) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (shares[static_cast<int>(c)] != 0.0 && corners[c] == Model::no_index) return Model::no_index;
    }
    const Triangle key = key_of(corners, shares);
    const auto [entry, is_new] = made.try_emplace(key, static_cast<std::uint32_t>(values.size()));
    if (is_new) values.push_back(make(sum_of(values, {corners, shares}), values[key[0]]));
    return entry->second;
  }

  std::uint32_t uv_at(std::uint32_t triangle, const glm::dvec3& shares, std::map<Triangle, std::uint32_t>& made) {
    if (model_.uv_triangles.empty()) return Model::no_index;
    return add_attribute(model_.uvs, model_.uv_triangles[triangle], shares, made,
                         [](const glm::vec2& sum, const glm::vec2&) { return sum; });
  }

  std::uint32_t normal_at(std::uint32_t triangle, const glm::dvec3& shares, std::map<Triangle, std::uint32_t>& made) {
    if (model_.normal_triangles.empty()) return Model::no_index;
    return add_attribute(model_.normals, model_.normal_triangles[triangle], shares, made,
                         [](const glm::vec3& sum, const glm::vec3& one) {
                           const float length = glm::length(sum);
                           return length > 0.0F ? sum / length : one;
                         });
  }

  /// Replaces the corners of `triangle` whose share is not zero by the new vertex, each in a triangle of its own.
  void split(std::uint32_t triangle, const glm::dvec3& shares, std::uint32_t vertex, std::uint32_t uv,
             std::uint32_t normal) {
    const bool has_uvs = !model_.uv_triangles.empty();
    const bool has_normals = !model_.normal_triangles.empty();
    const Triangle corners = model_.triangles[triangle];
    const Triangle uvs = has_uvs ? model_.uv_triangles[triangle] : Triangle{};
    const Triangle normals = has_normals ? model_.normal_triangles[triangle] : Triangle{};
    bool is_first = true;
    for (std::size_t c = 0; c < 3; ++c) {
      if (shares[static_cast<int>(c)] == 0.0) continue;
      if (!is_first) {
        model_.triangles.emplace_back();
        if (has_uvs) model_.uv_triangles.emplace_back();
        if (has_normals) model_.normal_triangles.emplace_back();
        origins_.push_back(origins_[triangle]);
      }
      const std::size_t to = is_first ? triangle : model_.triangles.size() - 1;
      is_first = false;
      const auto with_new = [c](Triangle t, std::uint32_t value) {
        t[c] = value;
        return t;
      };
      model_.triangles[to] = with_new(corners, vertex);
      if (has_uvs) model_.uv_triangles[to] = with_new(uvs, uv);
      if (has_normals) model_.normal_triangles[to] = with_new(normals, normal);
    }
  }

  std::uint32_t split_inside(std::uint32_t triangle, const glm::dvec3& shares) {
    const InsertedVertex made{model_.triangles[triangle], shares};
    const std::uint32_t vertex =
        add_vertex(made, glm::vec3(place_on(made.corners, shares)), SurfaceVertexId(next_surface_vertex_++));
    std::map<Triangle, std::uint32_t> none;
    const std::uint32_t uv = uv_at(triangle, shares, none);
    none.clear();
    const std::uint32_t normal = normal_at(triangle, shares, none);
    split(triangle, shares, vertex, uv, normal);
    return vertex;
  }

  /// Splits the edge opposite corner `across` of `triangle` in all triangles that have it.
  std::uint32_t split_edge(std::uint32_t triangle, std::size_t across, const glm::dvec3& shares) {
    const Triangle own = model_.triangles[triangle];
    const glm::vec3 position(place_on(own, shares));
    const std::array<SurfaceVertexId, 2> ends = {surface_of_[own[(across + 1) % 3]],
                                                 surface_of_[own[(across + 2) % 3]]};
    const std::array<double, 2> share_of_end = {shares[static_cast<int>((across + 1) % 3)],
                                                shares[static_cast<int>((across + 2) % 3)]};
    const SurfaceVertexId on_surface(next_surface_vertex_++);
    std::map<Triangle, std::uint32_t> vertices;
    std::map<Triangle, std::uint32_t> uvs;
    std::map<Triangle, std::uint32_t> normals;
    // The triangle itself first, so that its vertex, which is the result, has the lowest number.
    split_side(triangle, ends, share_of_end, position, on_surface, {vertices, uvs, normals});
    const std::uint32_t result = vertices.begin()->second;
    const auto count = static_cast<std::uint32_t>(model_.triangles.size());
    for (std::uint32_t t = 0; t < count; ++t)
      split_side(t, ends, share_of_end, position, on_surface, {vertices, uvs, normals});
    return result;
  }

  /// The new vertex, UV and normal of an edge that is split, by key_of() of the triangles at it: triangles with the
  /// same corners there get the same ones, on the two sides of a seam each its own.
  struct Made {
    std::map<Triangle, std::uint32_t>&vertices, &uvs, &normals;
  };

  /// Splits `t` if it has the edge between `ends`.
  void split_side(std::uint32_t t, const std::array<SurfaceVertexId, 2>& ends,
                  const std::array<double, 2>& share_of_end, const glm::vec3& position, SurfaceVertexId on_surface,
                  const Made& made) {
    const Triangle corners = model_.triangles[t];
    if (!has_three_corners(corners)) return;
    glm::dvec3 shares(0.0);
    std::size_t found = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t end = 0; end < 2; ++end) {
        if (surface_of_[corners[c]] != ends[end]) continue;
        shares[static_cast<int>(c)] = share_of_end[end];
        ++found;
      }
    }
    if (found != 2) return;
    const auto [entry, is_new] = made.vertices.try_emplace(key_of(corners, shares), 0U);
    if (is_new) entry->second = add_vertex({corners, shares}, position, on_surface);
    split(t, shares, entry->second, uv_at(t, shares, made.uvs), normal_at(t, shares, made.normals));
  }

  /// The parts of each given triangle in its place, and the primitives over them.
  void put_in_order() {
    std::vector<std::uint32_t> order(origins_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return origins_[a] < origins_[b]; });
    for (std::vector<Triangle>* list : {&model_.triangles, &model_.uv_triangles, &model_.normal_triangles}) {
      if (list->empty()) continue;
      std::vector<Triangle> ordered;
      ordered.reserve(order.size());
      for (const std::uint32_t t : order) ordered.push_back((*list)[t]);
      *list = std::move(ordered);
    }
    std::sort(origins_.begin(), origins_.end());
    const auto first_of = [&](std::uint32_t given) {
      return static_cast<std::uint32_t>(std::lower_bound(origins_.begin(), origins_.end(), given) - origins_.begin());
    };
    for (Primitive& primitive : model_.primitives) {
      const std::uint32_t last = first_of(primitive.first_triangle + primitive.triangle_count);
      primitive.first_triangle = first_of(primitive.first_triangle);
      primitive.triangle_count = last - primitive.first_triangle;
    }
  }

  void add_colors() {
    for (const InsertedVertex& vertex : result_.vertices) {
      glm::dvec3 sum(0.0);
      for (std::size_t c = 0; c < 3; ++c)
        sum += vertex.shares[static_cast<int>(c)] * glm::dvec3(linear_of_srgb(model_.colors[vertex.corners[c]]));
      model_.colors.push_back(srgb_of_linear(glm::vec3(sum)));
    }
  }

  void add_to(Example& example) const {
    auto number = static_cast<std::uint32_t>(model_.positions.size() - result_.vertices.size());
    for (const InsertedVertex& vertex : result_.vertices) {
      glm::dvec3 sum(0.0);
      for (std::size_t c = 0; c < 3; ++c)
        sum += vertex.shares[static_cast<int>(c)] * glm::dvec3(example.at(vertex.corners[c]));
      if (sum != glm::dvec3(0.0)) {
        example.vertices.push_back(number);
        example.displacements.emplace_back(sum);
      }
      ++number;
    }
  }

  Model& model_;
  const std::vector<Triangle> given_;
  std::vector<SurfaceVertexId> surface_of_;
  std::vector<std::uint32_t> origins_;  ///< #T: the given triangle that each is a part of
  std::uint32_t next_surface_vertex_ = 0;
  Insertion result_;
};

}  // namespace

std::optional<std::size_t> meant_corner(const glm::dvec3& shares, const glm::dvec3& a, const glm::dvec3& b,
                                        const glm::dvec3& c) {
  const std::array<glm::dvec3, 3> corners = {a, b, c};
  const glm::dvec3 place = shares.x * a + shares.y * b + shares.z * c;
  for (std::size_t k = 0; k < 3; ++k) {
    const double shorter =
        std::min(glm::distance(corners[k], corners[(k + 1) % 3]), glm::distance(corners[k], corners[(k + 2) % 3]));
    if (glm::distance(place, corners[k]) <= at_vertex * shorter) return k;
  }
  return std::nullopt;
}

glm::dvec3 moved_to_edge(const glm::dvec3& shares) {
  const int least = shares.x <= shares.y && shares.x <= shares.z ? 0 : shares.y <= shares.z ? 1 : 2;
  if (shares[least] > at_edge) return shares;
  glm::dvec3 moved = shares;
  moved[least] = 0.0;
  return moved / (moved.x + moved.y + moved.z);
}

Insertion insert_vertices(Model& model, const Surface& surface, std::span<const TrianglePlace> places) {
  if (places.empty()) return {};
  if (model.normals.empty()) make_smooth_normals(model, surface);
  Splitter splitter(model, surface);
  std::vector<std::uint32_t> vertex_of_place;
  vertex_of_place.reserve(places.size());
  for (const TrianglePlace& place : places) vertex_of_place.push_back(splitter.insert(place));
  Insertion result = std::move(splitter).finish();
  result.vertex_of_place = std::move(vertex_of_place);
  return result;
}

void add_inserted(std::vector<glm::vec3>& shape, std::span<const InsertedVertex> vertices) {
  for (const InsertedVertex& vertex : vertices) shape.push_back(sum_of(shape, vertex));
}

}  // namespace semblante
