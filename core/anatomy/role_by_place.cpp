#include "core/anatomy/role_by_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/anatomy/point_lookup.h"
#include "core/anatomy/role_by_name.h"
#include "core/geometry/nearest_point.h"

namespace semblante {
namespace {

/// Sizes of a face in units of ES0, the distance between the pupils (63 mm on an adult).
namespace share_of_es {
constexpr double eyeball_least = 0.1;  // radius; an adult's is 0.19
constexpr double eyeball_most = 0.4;
constexpr double eye_off_its_point = 0.5;  // centre of an eyeball from its pupil or lids
constexpr double mouth_below_eyes = 1.1;
constexpr double mouth_half_width = 0.6;
constexpr double mouth_half_height = 0.55;
constexpr double lips_half_height = 0.2;
constexpr double mouth_depth = 1.6;
constexpr double attached_mean = 0.15;  // lashes: at most a centimetre long, with roots on the lid
constexpr double attached_most = 0.4;
constexpr double attached_width = 1.3;  // a brow, a row of lashes; hair in one piece is wider and stays rigid
constexpr double attached_height = 1.0;
constexpr double attached_depth = 1.0;   // the arm of a pair of glasses, along the temple, is twice as deep
constexpr double tongue_of_arch = 0.85;  // greatest width of a tongue as a fraction of the widest row of teeth
constexpr double of_skin_height = 0.25;  // ES0 of a head cut at the neck, if it is otherwise unknown
}  // namespace share_of_es

std::optional<glm::dvec3> mean_of(const FeaturePointSet& points, std::initializer_list<std::string_view> names) {
  glm::dvec3 sum{0.0};
  double count = 0.0;
  for (const std::string_view name : names) {
    const FeaturePoint* const point = find_point(points, name);
    if (point == nullptr) continue;
    sum += glm::dvec3(point->position);
    count += 1.0;
  }
  return count > 0.0 ? std::optional(sum / count) : std::nullopt;
}

/// Whether two parts are about mirror images of each other in a plane through `middle`, across the axis that parts
/// them: the head may lie or face to a side.
bool is_twin(const PartShape& a, const PartShape& b, const glm::dvec3& middle) {
  constexpr double same_size = 0.2;  // of the extent
  constexpr double same_mesh = 1.25;
  constexpr double off_image = 0.5;  // of the extent: one eye may be higher than the other
  const auto [less, more] = std::minmax(a.triangles, b.triangles);
  const double size = glm::length(b.extent());
  if (more > same_mesh * less || glm::distance(a.extent(), b.extent()) > same_size * size) return false;
  const glm::dvec3 apart = glm::abs(a.box_center() - b.box_center());
  const int axis = apart.x > std::max(apart.y, apart.z) ? 0 : apart.y > apart.z ? 1 : 2;
  glm::dvec3 image = b.box_center();
  image[axis] = 2.0 * middle[axis] - image[axis];
  return glm::distance(a.box_center(), image) < off_image * size;
}

class PlaceGuess {
 public:
  PlaceGuess(std::span<const PartShape> shapes, const FeaturePointSet& points, std::size_t skin,
             std::span<std::optional<PartRole>> roles)
      : shapes_(shapes), points_(points), skin_(shapes[skin]), roles_(roles) {}

  void run() {
    find_twins_of_skin();
    eyes_[0] = mean_of(points_, {"3.5"});
    eyes_[1] = mean_of(points_, {"3.6"});
    if (!eyes_[0]) eyes_[0] = mean_of(points_, {"3.1", "3.3", "3.7", "3.11"});
    if (!eyes_[1]) eyes_[1] = mean_of(points_, {"3.2", "3.4", "3.8", "3.12"});
    if (!eyes_[0] || !eyes_[1]) eyes_from_named_parts();
    if (!eyes_[0] || !eyes_[1]) eyes_from_pair_of_balls();
    es_ = eyes_[0] && eyes_[1] ? glm::distance(*eyes_[0], *eyes_[1]) : share_of_es::of_skin_height * skin_.extent().y;
    find_balls();
    find_parts_of_eyes();
    mouth_ = mouth_place();
    find_mouth();
    find_attached();
  }

 private:
  [[nodiscard]] bool is_open(std::size_t p) const { return !roles_[p] && shapes_[p].triangles > 0; }

  /// A lid that is a part of its own, a shell about the eye, and has no point yet goes with its mirror image, which has
  /// one. By its place and shape it would be an eyeball.
  void find_twins_of_skin() {
    for (std::size_t marked = 0; marked < shapes_.size(); ++marked) {
      if (roles_[marked] != PartRole::skin || &shapes_[marked] == &skin_ || !is_about_a_ball(shapes_[marked])) continue;
      for (std::size_t p = 0; p < shapes_.size(); ++p) {
        if (!is_open(p) || !is_ball(shapes_[p])) continue;
        if (!is_twin(shapes_[p], shapes_[marked], skin_.box_center())) continue;
        roles_[p] = PartRole::skin;
        break;
      }
    }
  }

  /// Whether a part is a shell about a smaller ball. An eyeball on which a lid's point was set by mistake is not.
  [[nodiscard]] bool is_about_a_ball(const PartShape& shell) const {
    return is_ball(shell) && std::any_of(shapes_.begin(), shapes_.end(), [&](const PartShape& inner) {
             if (&inner == &shell || !is_ball(inner) || inner.sphere->radius >= shell.sphere->radius) return false;
             return glm::distance(inner.sphere->center, shell.sphere->center) < 0.5 * shell.sphere->radius;
           });
  }

  /// Largest part with that role.
  [[nodiscard]] const PartShape* largest(PartRole role) const {
    const PartShape* best = nullptr;
    for (std::size_t p = 0; p < shapes_.size(); ++p) {
      if (roles_[p] != role) continue;
      if (best == nullptr || shapes_[p].positions.size() > best->positions.size()) best = &shapes_[p];
    }
    return best;
  }

  void eyes_from_named_parts() {
    for (std::size_t side = 0; side < 2; ++side) {
      const PartShape* const eye = largest(eye_roles[side]);
      if (!eyes_[side] && eye != nullptr) eyes_[side] = eye->box_center();
    }
  }

  /// Finds two balls of one size, mirror images in the middle plane of the skin, in its front half.
  void eyes_from_pair_of_balls() {
    const double middle = skin_.box_center().x;
    for (std::size_t a = 0; a < shapes_.size(); ++a) {
      if (!is_open(a) || !is_ball(shapes_[a])) continue;
      const glm::dvec3 left = shapes_[a].sphere->center;
      const double radius = shapes_[a].sphere->radius;
      if (left.x <= middle || left.z < skin_.box_center().z) continue;
      for (std::size_t b = 0; b < shapes_.size(); ++b) {
        if (!is_open(b) || !is_ball(shapes_[b])) continue;
        const glm::dvec3 right = shapes_[b].sphere->center;
        const glm::dvec3 image(2.0 * middle - right.x, right.y, right.z);
        if (right.x >= middle || glm::distance(left, image) > 0.5 * radius) continue;
        if (std::abs(shapes_[b].sphere->radius - radius) > 0.2 * radius) continue;
        eyes_ = {left, right};
        return;
      }
    }
  }

  void find_balls() {
    for (std::size_t p = 0; p < shapes_.size(); ++p) {
      if (!is_open(p) || !is_ball(shapes_[p])) continue;
      const Sphere& ball = *shapes_[p].sphere;
      if (ball.radius < share_of_es::eyeball_least * es_ || ball.radius > share_of_es::eyeball_most * es_) continue;
      for (std::size_t side = 0; side < 2; ++side) {
        if (eyes_[side] && glm::distance(ball.center, *eyes_[side]) < share_of_es::eye_off_its_point * es_) {
          roles_[p] = eye_roles[side];
        }
      }
    }
  }

  /// Finds iris, pupil and cornea: inside the eyeball, or a little outside but centred on its axis and no wider than a
  /// cornea. Other parts on the eyeball (tears, occlusion, the blend to the lids) are wider or off-centre.
  void find_parts_of_eyes() {
    constexpr double bulge = 1.12;
    constexpr double widest = 1.5;
    constexpr double off_axis = 0.3;  // allows a sideways gaze in the neutral face
    for (std::size_t side = 0; side < 2; ++side) {
      const PartShape* const eye = largest(eye_roles[side]);
      if (eye == nullptr || !eye->sphere) continue;
      const Sphere ball = *eye->sphere;
      for (std::size_t p = 0; p < shapes_.size(); ++p) {
        if (!is_open(p)) continue;
        double farthest = 0.0;
        for (const glm::dvec3& v : shapes_[p].positions) {
          farthest = std::max(farthest, glm::distance(v, ball.center));
        }
        const glm::dvec3 from = shapes_[p].box_center() - ball.center;
        const bool on_axis = std::hypot(from.x, from.y) < off_axis * ball.radius;
        const bool inside = farthest < 0.99 * ball.radius;
        const bool cornea = farthest < bulge * ball.radius && on_axis && shapes_[p].extent().x < widest * ball.radius;
        if (inside || cornea) roles_[p] = eye_roles[side];
      }
    }
  }

  [[nodiscard]] std::optional<glm::dvec3> mouth_place() const {
    const std::optional<glm::dvec3> lips = mean_of(points_, {"2.2", "2.3"});
    std::optional<glm::dvec3> mouth = lips ? lips : mean_of(points_, {"8.3", "8.4"});
    if (!mouth && eyes_[0] && eyes_[1]) {
      mouth = 0.5 * (*eyes_[0] + *eyes_[1]) - glm::dvec3(0.0, share_of_es::mouth_below_eyes * es_, 0.0);
      mouth->z = skin_.high.z;
    }
    return mouth;
  }

  void find_mouth() {
    std::vector<std::size_t> inside;
    for (std::size_t p = 0; p < shapes_.size(); ++p) {
      if (!is_open(p)) continue;
      const bool named = is_named_teeth(shapes_[p]);
      if (!mouth_) {
        if (named) inside.push_back(p);
        continue;
      }
      const glm::dvec3 from = shapes_[p].box_center() - *mouth_;
      if (named || (std::abs(from.x) < share_of_es::mouth_half_width * es_ &&
                    std::abs(from.y) < share_of_es::mouth_half_height * es_ && from.z < 0.0 &&
                    from.z > -share_of_es::mouth_depth * es_ && shapes_[p].extent().x < 1.5 * es_)) {
        inside.push_back(p);
      }
    }
    if (!inside.empty()) split_mouth(inside);
  }

  /// Whether a part is narrower than the widest row of teeth, and in its middle.
  [[nodiscard]] static bool lies_within(const PartShape& shape, const PartShape* row) {
    return row != nullptr && shape.extent().x < share_of_es::tongue_of_arch * row->extent().x &&
           std::abs(shape.box_center().x - row->box_center().x) < 0.1 * row->extent().x;
  }

  /// Whether the middle of a part, seen from above, is among its highest places: on a tongue it is, on the floor
  /// between two rows of teeth it is not.
  [[nodiscard]] static bool is_high_in_its_middle(const PartShape& shape) {
    const glm::dvec3 center = shape.box_center();
    const glm::dvec3 room = 0.15 * shape.extent();
    return std::any_of(shape.positions.begin(), shape.positions.end(), [&](const glm::dvec3& v) {
      return std::abs(v.x - center.x) <= room.x && std::abs(v.z - center.z) <= room.z && v.y > center.y;
    });
  }

  /// Distinguishes a tongue from an arch of teeth, which is hollow in its middle.
  [[nodiscard]] static bool fills_its_middle(const PartShape& shape) {
    const glm::dvec3 center = shape.box_center();
    const glm::dvec3 room = 0.15 * shape.extent();
    return std::any_of(shape.positions.begin(), shape.positions.end(), [&](const glm::dvec3& v) {
      return std::abs(v.x - center.x) <= room.x && std::abs(v.z - center.z) <= room.z;
    });
  }

  void split_mouth(const std::vector<std::size_t>& inside) {
    const bool teeth_elsewhere = largest(PartRole::upper_teeth) != nullptr || largest(PartRole::lower_teeth) != nullptr;
    if (largest(PartRole::tongue) == nullptr && (inside.size() >= 2 || teeth_elsewhere)) {
      const PartShape* row = nullptr;
      for (const std::size_t p : inside) {
        if (is_named_teeth(shapes_[p]) && (row == nullptr || shapes_[p].extent().x > row->extent().x))
          row = &shapes_[p];
      }
      // A single tooth fills its middle too, so a tongue must also span much of the mouth.
      for (const std::size_t p : inside) {
        const PartShape& shape = shapes_[p];
        const bool midline = std::abs(shape.box_center().x - skin_.box_center().x) < 0.1 * shape.extent().x;
        if (!midline || shape.extent().z < 0.3 * es_ || !fills_its_middle(shape)) continue;
        // A mesh of teeth may hold the tongue too; then the palate and the floor of the mouth fill their middles as
        // well.
        if (is_named_teeth(shape) && (!lies_within(shape, row) || !is_high_in_its_middle(shape))) continue;
        roles_[p] = PartRole::tongue;
        break;
      }
    }
    // The line where the teeth meet: between the marked edges; else the line of the lips.
    const std::optional<glm::dvec3> upper_edge = mean_of(points_, {"9.10"});
    const std::optional<glm::dvec3> lower_edge = mean_of(points_, {"9.11"});
    double line = mouth_ ? mouth_->y : skin_.box_center().y;
    if (upper_edge && lower_edge) line = 0.5 * (upper_edge->y + lower_edge->y);
    for (const std::size_t p : inside) {
      if (roles_[p]) continue;
      roles_[p] = shapes_[p].box_center().y > line ? PartRole::upper_teeth : PartRole::lower_teeth;
    }
  }

  void find_attached() {
    std::vector<std::size_t> small;
    for (std::size_t p = 0; p < shapes_.size(); ++p) {
      if (!is_open(p)) continue;
      if (may_be_attached(p)) {
        small.push_back(p);
      } else {
        roles_[p] = PartRole::rest;
      }
    }
    // The lenses and pads of a pair of glasses go with its frame, a strand with the rest of the hair: small parts of a
    // named primitive that has parts at rest. The skin's own primitive says nothing.
    using Primitive = std::pair<std::string_view, std::string_view>;
    const auto primitive_of = [](const PartShape& shape) { return Primitive(shape.name, shape.material); };
    std::set<Primitive> rigid;
    for (std::size_t p = 0; p < shapes_.size(); ++p) {
      if (roles_[p] == PartRole::rest && shapes_[p].triangles > 0) rigid.insert(primitive_of(shapes_[p]));
    }
    rigid.erase(Primitive());
    rigid.erase(primitive_of(skin_));
    for (const std::size_t p : small) {
      roles_[p] = rigid.count(primitive_of(shapes_[p])) > 0 ? PartRole::rest : PartRole::attached;
    }
  }

  /// Whether a part begins between eyes and mouth, reaches below this and lies on both sides of it: a beard in one
  /// piece goes with the jaw. Hair begins above the eyes, a collar below the mouth.
  [[nodiscard]] bool is_around_mouth(const PartShape& shape) const {
    if (!mouth_ || !eyes_[0] || !eyes_[1]) return false;
    const double lips = share_of_es::lips_half_height * es_;
    return shape.high.y < 0.5 * (eyes_[0]->y + eyes_[1]->y) && shape.high.y > mouth_->y + lips &&
           shape.low.y < mouth_->y - lips && shape.low.x < mouth_->x && shape.high.x > mouth_->x &&
           shape.high.z > mouth_->z - share_of_es::mouth_half_height * es_;
  }

  [[nodiscard]] bool may_be_attached(std::size_t p) {
    const glm::dvec3 extent = shapes_[p].extent();
    const bool is_large = extent.x > share_of_es::attached_width * es_ ||
                          extent.y > share_of_es::attached_height * es_ || extent.z > share_of_es::attached_depth * es_;
    if (is_large && !is_around_mouth(shapes_[p])) return false;
    double sum = 0.0;
    double most = 0.0;
    if (!near_skin_) near_skin_.emplace(skin_.positions);
    for (const glm::dvec3& v : shapes_[p].positions) {
      const double gap = near_skin_->nearest(v).distance;
      sum += gap;
      most = std::max(most, gap);
    }
    return sum < share_of_es::attached_mean * es_ * static_cast<double>(shapes_[p].positions.size()) &&
           most < share_of_es::attached_most * es_;
  }

  static constexpr std::array<PartRole, 2> eye_roles = {PartRole::left_eye, PartRole::right_eye};

  std::span<const PartShape> shapes_;
  const FeaturePointSet& points_;
  const PartShape& skin_;
  std::span<std::optional<PartRole>> roles_;
  std::optional<NearestPoint> near_skin_;  ///< made for the first part that needs it: names say enough of many heads
  std::array<std::optional<glm::dvec3>, 2> eyes_;  ///< left, right: approximate positions
  double es_ = 0.0;
  std::optional<glm::dvec3> mouth_;
};

}  // namespace

void guess_roles_by_place(std::span<const PartShape> shapes, const FeaturePointSet& points, std::size_t skin,
                          std::span<std::optional<PartRole>> roles) {
  PlaceGuess(shapes, points, skin, roles).run();
}

}  // namespace semblante
