#include "core/materials/painted_eyes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "core/geometry/triangle_shape.h"
#include "core/materials/eye_texture.h"
#include "core/materials/painted_primitives.h"
#include "core/materials/plain_materials.h"
#include "core/types/iris_size.h"

namespace semblante {
namespace {

constexpr float widest_span = 4.0F;               ///< radii of the iris that the texture shows at most
constexpr float widest_disc = 1.4F;               ///< radii of the iris; the white of an open eye is wider
constexpr float widest_round = 2.0F;              ///< of a disc as high as wide: half closed lids hide some of an iris
constexpr float least_roundness = 0.85F;          ///< height by width, or the reverse
constexpr glm::vec2 black_place(0.5F, 0.5F);      ///< the pupil
constexpr glm::vec2 white_place(0.004F, 0.004F);  ///< a corner of the texture

enum class Paint : std::uint8_t { none, eye, cornea };

/// A place in the frame of an eye: across its axis to the face's left and up, and along it.
struct EyePlace {
  glm::vec2 across{0.0F};
  float along = 0.0F;
};

EyePlace place_of(const PaintedEye& eye, const glm::vec3& p) {
  const glm::vec3 left = glm::normalize(glm::cross(glm::vec3(0.0F, 1.0F, 0.0F), eye.axis));
  const glm::vec3 up = glm::cross(eye.axis, left);
  const glm::vec3 d = p - eye.pivot;
  return {{glm::dot(d, left), glm::dot(d, up)}, glm::dot(d, eye.axis)};
}

/// Of the nearest place of a triangle, seen along the axis.
float distance_from_axis(const std::array<EyePlace, 3>& corners) {
  float nearest = std::numeric_limits<float>::infinity();
  std::array<bool, 3> is_left{};
  for (std::size_t c = 0; c < 3; ++c) {
    const glm::vec2& from = corners[c].across;
    const glm::vec2 edge = corners[(c + 1) % 3].across - from;
    const float length = glm::dot(edge, edge);
    const float t = length > 0.0F ? glm::clamp(-glm::dot(from, edge) / length, 0.0F, 1.0F) : 0.0F;
    nearest = std::min(nearest, glm::length(from + t * edge));
    is_left[c] = edge.x * from.y - edge.y * from.x < 0.0F;
  }
  const bool is_around = is_left[0] == is_left[1] && is_left[1] == is_left[2];
  return is_around ? 0.0F : nearest;
}

bool can_be_painted(const PaintedEye& eye) {
  // An axis along y has no left; no eye looks there at rest.
  return eye.iris_radius > 0.0F && std::abs(eye.axis.y) < 0.9F;
}

/// The white of an eye: an opaque colour near white, without an image.
bool is_eye_white(const Material& material) {
  const glm::vec4& c = material.base_color;
  const float low = std::min({c.r, c.g, c.b});
  return material.base_color_image < 0 && c.a > 0.99F && low > 0.6F && std::max({c.r, c.g, c.b}) - low < 0.12F;
}

/// A cornea or a film of tears, through which the eye is seen.
bool is_film(const Material& material) {
  return (material.alpha_mode == Material::AlphaMode::blend && material.base_color.a < 0.5F) ||
         plain_of(material.name, {}, PartRole::rest) == Plain::fluid;
}

bool moves_as_iris(RigidMotion motion) { return motion == RigidMotion::left_iris || motion == RigidMotion::right_iris; }

struct PaintedTriangle {
  const PaintedEye* eye = nullptr;
  Paint paint = Paint::none;
  bool is_inside = false;      ///< of an iris in front of the eye's inside, which is dark
  bool is_inner_wall = false;  ///< faces the pivot: seen only through a pupil that is a hole, and dark
};

/// The painting of a model's eyes.
class EyePainter {
 public:
  EyePainter(const Model& model, const Surface& surface, std::span<const Part> parts, const EyeLook& look)
      : model_(model), surface_(surface), parts_(parts), look_(look), eyes_(look.eyes) {
    fit_discs();
    for (const Primitive& primitive : model.primitives) {
      if (!has_look(model, primitive)) continue;
      const Material* const own = material_of(model, primitive);
      if (own != nullptr && (is_film(*own) || (is_eye_white(*own) && !primitive.has_colors))) continue;
      const std::size_t end = std::size_t{primitive.first_triangle} + primitive.triangle_count;
      for (std::size_t t = primitive.first_triangle; t < end; ++t) {
        if (const auto side = side_of(model.triangles[t])) has_own_iris_[*side] = true;
      }
    }
    for (const RigidMotion motion : look.motion) {
      if (moves_as_iris(motion)) has_moving_iris_[is_left_eye(motion) ? 0 : 1] = true;
    }
    find_corneas();
    measure_walls();
  }

  /// Without an eye if the triangle is not of a plain eyeball.
  [[nodiscard]] PaintedTriangle painted(const Primitive& primitive, const Triangle& corners) const {
    const auto side = side_of(corners);
    if (!side) return {};
    const bool is_cornea = is_cornea_[part_of(corners).value()];
    if (has_own_iris_[*side] && !is_cornea) return {};
    const Material* const own = material_of(model_, primitive);
    if (primitive.has_colors) return {};
    if (own != nullptr && (is_film(*own) || !(says_nothing(*own) || is_eye_white(*own)))) return {};
    const PartRole role = *side == 0 ? PartRole::left_eye : PartRole::right_eye;
    const Plain plain =
        plain_of(own != nullptr ? std::string_view(own->name) : std::string_view(), primitive.name, role);
    if (plain != Plain::sclera && plain != Plain::iris) return {};
    const std::optional<PaintedEye>& eye = eyes_[*side];
    if (!eye || !can_be_painted(*eye)) return {};
    return {&*eye, is_cornea ? Paint::cornea : Paint::eye, plain == Plain::iris, is_inner_wall(*eye, corners)};
  }

  /// Whether a triangle is of the front of an eye: of a ball of few triangles also one that faces forward and has some
  /// of the iris on it, but a corner behind the pivot.
  [[nodiscard]] bool is_of_front(const PaintedEye& eye, const Triangle& corners) const {
    std::array<EyePlace, 3> places;
    for (std::size_t c = 0; c < 3; ++c) places[c] = place_of(eye, model_.positions[corners[c]]);
    const auto behind = std::count_if(places.begin(), places.end(), [](const auto& p) { return p.along <= 0.0F; });
    if (behind == 0 || behind == 3) return behind == 0;
    const FromPivot triangle = from_pivot(eye, corners);
    const double outwards = glm::dot(triangle.normal, triangle.middle);
    if (!(outwards * glm::dot(triangle.normal, glm::dvec3(eye.axis)) > 0.0)) return false;
    return distance_from_axis(places) < eye.iris_radius;
  }

  /// In radii of the iris; nothing of the front of an eye is farther from its axis.
  [[nodiscard]] float reach(const PaintedEye& eye, const Triangle& corners) const {
    const bool is_front = is_of_front(eye, corners);
    float farthest = 1.0F;
    for (const std::uint32_t v : corners) {
      const EyePlace place = place_of(eye, model_.positions[v]);
      if (is_front || place.along > 0.0F) farthest = std::max(farthest, glm::length(place.across) / eye.iris_radius);
    }
    return farthest;
  }

  /// On a texture that shows `span` radii of the iris, of a triangle of the front. Behind it a place would be that of
  /// one in front.
  [[nodiscard]] glm::vec2 texture_place(const PaintedEye& eye, std::uint32_t vertex, float span) const {
    const glm::vec2 p = place_of(eye, model_.positions[vertex]).across / (eye.iris_radius * span);
    return glm::clamp(glm::vec2(0.5F + 0.5F * p.x, 0.5F - 0.5F * p.y), glm::vec2(0.0F), glm::vec2(1.0F));
  }

 private:
  /// Sums over the triangles of a part, with twice their areas.
  struct Walls {
    double volume = 0.0;  ///< that they enclose with the pivot; negative if their fronts are inside
    double area = 0.0;
    double distance = 0.0;  ///< from the pivot, weighted with the area
  };

  /// 0 left, 1 right; empty if the triangle is not of an eye.
  [[nodiscard]] std::optional<std::size_t> side_of(const Triangle& corners) const {
    const PartId part = part_of(corners);
    if (part.value() >= parts_.size()) return std::nullopt;
    const PartRole role = parts_[part.value()].role;
    if (role == PartRole::left_eye) return 0;
    if (role == PartRole::right_eye) return 1;
    return std::nullopt;
  }

  [[nodiscard]] PartId part_of(const Triangle& corners) const {
    return surface_.part_of[surface_.surface_of[corners[0]].value()];
  }

  /// A cornea is a part that lies over a moving iris and has no vertex that moves with it. Whole parts are marked, not
  /// triangles, since the edges of triangles do not follow the rim of the iris.
  void find_corneas() {
    is_cornea_.assign(parts_.size(), false);
    if (!has_moving_iris_[0] && !has_moving_iris_[1]) return;
    std::vector<bool> moves(parts_.size());
    for (const Triangle& corners : model_.triangles) {
      const auto side = side_of(corners);
      if (!side || !has_moving_iris_[*side] || !eyes_[*side]) continue;
      const std::size_t part = part_of(corners).value();
      if (is_in_front(*eyes_[*side], corners)) is_cornea_[part] = true;
      if (std::any_of(corners.begin(), corners.end(), [&](auto v) { return moves_as_iris(look_.motion[v]); })) {
        moves[part] = true;
      }
    }
    for (std::size_t p = 0; p < moves.size(); ++p) is_cornea_[p] = is_cornea_[p] && !moves[p];
  }

  /// A triangle from the pivot: its middle, and the normal of its front, twice its area long.
  struct FromPivot {
    glm::dvec3 middle;
    glm::dvec3 normal;
  };

  [[nodiscard]] FromPivot from_pivot(const PaintedEye& eye, const Triangle& corners) const {
    const auto at = [&](std::size_t c) { return glm::dvec3(model_.positions[corners[c]] - eye.pivot); };
    return {(at(0) + at(1) + at(2)) / 3.0, area_vector(at(0), at(1), at(2))};
  }

  /// An eye that is only a flat disc about the pupil is an iris, as large as it is: nothing of it is white.
  void fit_discs() {
    struct Extent {
      float farthest = 0.0F;
      glm::vec2 half{0.0F};  ///< greatest distance from the axis to a side, and up or down
      float least = std::numeric_limits<float>::infinity();
      float most = -std::numeric_limits<float>::infinity();
    };
    std::array<Extent, 2> extents;
    for (const Triangle& corners : model_.triangles) {
      const auto side = side_of(corners);
      if (!side || !eyes_[*side] || !can_be_painted(*eyes_[*side])) continue;
      for (const std::uint32_t v : corners) {
        const EyePlace place = place_of(*eyes_[*side], model_.positions[v]);
        Extent& extent = extents[*side];
        extent.farthest = std::max(extent.farthest, glm::length(place.across));
        extent.half = glm::max(extent.half, glm::abs(place.across));
        extent.least = std::min(extent.least, place.along);
        extent.most = std::max(extent.most, place.along);
      }
    }
    for (std::size_t e = 0; e < 2; ++e) {
      const Extent& extent = extents[e];
      const bool is_round =
          std::min(extent.half.x, extent.half.y) >= least_roundness * std::max(extent.half.x, extent.half.y);
      if (extent.farthest > 0.0F && extent.most - extent.least < 0.5F * extent.farthest &&
          extent.farthest < (is_round ? widest_round : widest_disc) * eyes_[e]->iris_radius) {
        eyes_[e]->iris_radius = extent.farthest;
      }
    }
  }

  void measure_walls() {
    walls_.assign(parts_.size(), {});
    for (const Triangle& corners : model_.triangles) {
      const auto side = side_of(corners);
      if (!side || !eyes_[*side]) continue;
      const FromPivot triangle = from_pivot(*eyes_[*side], corners);
      Walls& walls = walls_[part_of(corners).value()];
      const double area = glm::length(triangle.normal);
      walls.volume += glm::dot(triangle.normal, triangle.middle);
      walls.area += area;
      walls.distance += area * glm::length(triangle.middle);
    }
  }

  /// Whether a triangle faces the pivot and lies behind another wall: single triangles of a ball may have their corners
  /// in the wrong order, or all of them.
  [[nodiscard]] bool is_inner_wall(const PaintedEye& eye, const Triangle& corners) const {
    const Walls& walls = walls_[part_of(corners).value()];
    const FromPivot triangle = from_pivot(eye, corners);
    const double distance = glm::length(triangle.middle);
    const double outwards = (walls.volume < 0.0 ? -1.0 : 1.0) * glm::dot(triangle.normal, triangle.middle);
    return outwards < -0.5 * glm::length(triangle.normal) * distance && distance * walls.area < 0.97 * walls.distance;
  }

  /// Whether the middle of a triangle is before the iris or on it.
  [[nodiscard]] bool is_in_front(const PaintedEye& eye, const Triangle& corners) const {
    const glm::vec3 sum = model_.positions[corners[0]] + model_.positions[corners[1]] + model_.positions[corners[2]];
    const EyePlace center = place_of(eye, sum / 3.0F);
    return center.along > 0.0F && glm::length(center.across) < eye.iris_radius;
  }

  const Model& model_;
  const Surface& surface_;
  std::span<const Part> parts_;
  const EyeLook& look_;
  std::array<std::optional<PaintedEye>, 2> eyes_;  ///< left, right
  // Left, right.
  std::array<bool, 2> has_own_iris_{};     ///< the file gives the eye a look of its own
  std::array<bool, 2> has_moving_iris_{};  ///< some vertices move as its iris
  std::vector<bool> is_cornea_;            ///< by PartId
  std::vector<Walls> walls_;               ///< by PartId
};

/// Texture coordinates of single corners, in a model that may have none.
class CornerUvs {
 public:
  explicit CornerUvs(Model& model) : model_(model) {
    if (model_.uv_triangles.empty()) {
      model_.uv_triangles.assign(model_.triangles.size(), {Model::no_index, Model::no_index, Model::no_index});
    }
    of_vertex_.assign(model_.positions.size(), Model::no_index);
  }

  void set(std::size_t triangle, int corner, std::uint32_t vertex, const glm::vec2& place) {
    std::uint32_t& index = of_vertex_[vertex];
    if (index == Model::no_index) index = add(place);
    model_.uv_triangles[triangle][static_cast<std::size_t>(corner)] = index;
  }

  /// The same place for the three corners.
  void set_all(std::size_t triangle, const glm::vec2& place) {
    std::uint32_t& index = of_place_.try_emplace({place.x, place.y}, Model::no_index).first->second;
    if (index == Model::no_index) index = add(place);
    model_.uv_triangles[triangle] = {index, index, index};
  }

 private:
  std::uint32_t add(const glm::vec2& place) {
    model_.uvs.push_back(place);
    return static_cast<std::uint32_t>(model_.uvs.size() - 1);
  }

  Model& model_;
  std::vector<std::uint32_t> of_vertex_;
  std::map<std::pair<float, float>, std::uint32_t> of_place_;
};

/// Where the corners of painted triangles are on textures that show `span` radii of the iris.
void set_uvs(const Model& model, const EyePainter& painter, std::span<const PaintedTriangle> painted, float span,
             CornerUvs& uvs) {
  for (std::size_t t = 0; t < painted.size(); ++t) {
    if (painted[t].paint == Paint::none) continue;
    if (painted[t].is_inner_wall && painted[t].paint == Paint::eye) {
      uvs.set_all(t, black_place);
      continue;
    }
    if (!painter.is_of_front(*painted[t].eye, model.triangles[t])) {
      uvs.set_all(t, painted[t].is_inside && painted[t].paint == Paint::eye ? black_place : white_place);
      continue;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t vertex = model.triangles[t][c];
      uvs.set(t, static_cast<int>(c), vertex, painter.texture_place(*painted[t].eye, vertex, span));
    }
  }
}

/// Appends a material with this image; its number.
int add_material(Model& model, const char* name, Image image) {
  model.images.push_back(std::move(image));
  Material material = plain_material(Plain::sclera);
  material.name = name;
  material.base_color = glm::vec4(1.0F);
  material.base_color_image = static_cast<int>(model.images.size() - 1);
  model.materials.push_back(std::move(material));
  return static_cast<int>(model.materials.size() - 1);
}

}  // namespace

EyeLook eyes_of(const Rig& rig) {
  static const std::array<FeaturePointId, 2> pupils = {*parse_feature_point("3.5"), *parse_feature_point("3.6")};
  const std::array<glm::vec3, 2> pivots = {rig.left_eye_pivot, rig.right_eye_pivot};
  EyeLook look;
  look.motion = rig.rigid_of_vertex;
  for (std::size_t e = 0; e < 2; ++e) {
    if (const std::optional<Iris>& iris = rig.irises[e]) {
      look.eyes[e] = PaintedEye{pivots[e], iris->axis, iris->iris_radius};
      continue;
    }
    const auto pupil = std::find_if(rig.points.begin(), rig.points.end(),
                                    [&](const FeaturePoint& point) { return point.id == pupils[e]; });
    const auto diameter = rig.fapu[FapuUnit::irisd];
    if (pupil == rig.points.end() || !diameter) continue;
    const glm::vec3 gaze = pupil->position - pivots[e];
    if (!(glm::length(gaze) > 0.0F)) continue;
    const auto radius = iris_radius(1024.0 * *diameter, rig.parts, e == 0 ? PartRole::left_eye : PartRole::right_eye);
    look.eyes[e] = PaintedEye{pivots[e], glm::normalize(gaze), static_cast<float>(radius)};
  }
  return look;
}

EyeLook guessed_eyes(std::span<const Part> parts) {
  EyeLook look;
  for (std::size_t e = 0; e < 2; ++e) {
    glm::vec3 low(std::numeric_limits<float>::infinity());
    glm::vec3 high = -low;
    for (const Part& part : parts) {
      if (part.role != (e == 0 ? PartRole::left_eye : PartRole::right_eye)) continue;
      low = glm::min(low, part.box_min);
      high = glm::max(high, part.box_max);
    }
    const float radius = 0.5F * std::max(high.x - low.x, high.y - low.y);
    if (!(radius > 0.0F)) continue;
    // From the front, since many eyeballs are only their visible half.
    const glm::vec3 center(0.5F * (low.x + high.x), 0.5F * (low.y + high.y), high.z - radius);
    look.eyes[e] = PaintedEye{center, {0.0F, 0.0F, 1.0F}, iris_of_ball * radius};
  }
  return look;
}

void paint_eyes(Model& model, const Surface& surface, std::span<const Part> parts, const EyeLook& look) {
  const EyePainter painter(model, surface, parts, look);
  std::vector<PaintedTriangle> painted(model.triangles.size());
  float span = 1.0F;
  bool is_any_painted = false;
  for (const Primitive& primitive : model.primitives) {
    for (std::size_t t = primitive.first_triangle; t < std::size_t{primitive.first_triangle} + primitive.triangle_count;
         ++t) {
      painted[t] = painter.painted(primitive, model.triangles[t]);
      if (painted[t].eye == nullptr) continue;
      const PaintedEye& eye = *painted[t].eye;
      span = std::max(span, painter.reach(eye, model.triangles[t]));
      is_any_painted = true;
    }
  }
  if (!is_any_painted) return;
  span = std::min(1.02F * span, widest_span);

  CornerUvs uvs(model);
  set_uvs(model, painter, painted, span, uvs);
  const int eye = add_material(model, "eye", eye_texture(span));
  int cornea = -1;
  if (std::any_of(painted.begin(), painted.end(), [](const auto& t) { return t.paint == Paint::cornea; })) {
    cornea = add_material(model, "eye white", cornea_texture(span));
    model.materials.back().alpha_mode = Material::AlphaMode::mask;
  }
  model.primitives = painted_primitives(model, [&](const Primitive&, std::uint32_t t) -> std::optional<int> {
    if (painted[t].paint == Paint::none) return std::nullopt;
    return painted[t].paint == Paint::eye ? eye : cornea;
  });
}

}  // namespace semblante
