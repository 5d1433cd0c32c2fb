#include <algorithm>
#include <cmath>

#include "core/anatomy/face_search.h"
#include "core/frame/frame_guess.h"
#include "core/frame/head_landmarks.h"
#include "core/frame/human_size.h"
#include "core/types/printable.h"

namespace semblante {
namespace {

std::string letter(int axis) { return {"XYZ"[axis]}; }
std::string name(Direction direction) { return std::string(to_string(direction)); }

/// The guess from the shape of a head without marked points; evidence is used in order of its reliability.
class ShapeGuess {
 public:
  ShapeGuess(const Model& model, const Surface& surface)
      : model_(model), surface_(surface), shapes_(measure_parts(model, surface)) {}

  ModelFrame guess() {
    if (!shapes_.empty()) {
      skin_ = largest_part();
      eyes_ = find_eyes(shapes_);
      find_across();
      if (across_) find_up();
      if (up_) find_front();
    }
    guess_.axes_sure = across_ && up_ && front_;
    if (guess_.axes_sure) {
      guess_.axes = {*up_, *front_};
    } else if (guess_.axes_sure = stands_by_rule() || shows_a_face(); !guess_.axes_sure) {
      assume_axes();
    }
    guess_unit();
    return std::move(guess_);
  }

 private:
  [[nodiscard]] std::size_t largest_part() const {
    std::size_t best = 0;
    for (std::size_t p = 1; p < shapes_.size(); ++p) {
      if (shapes_[p].triangles > shapes_[best].triangles) best = p;
    }
    return best;
  }
  [[nodiscard]] glm::dvec3 extent_of_all() const {
    glm::dvec3 low(1e300);
    glm::dvec3 high(-1e300);
    for (const PartShape& shape : shapes_) {
      if (shape.triangles == 0) continue;
      low = glm::min(low, shape.low);
      high = glm::max(high, shape.high);
    }
    return high - low;
  }
  [[nodiscard]] const PartShape& skin() const { return shapes_[skin_]; }
  [[nodiscard]] PartId skin_id() const { return PartId(static_cast<std::uint32_t>(skin_)); }
  [[nodiscard]] bool is_gltf() const { return model_.format == "glb" || model_.format == "gltf"; }
  void say(std::string reason) { guess_.reasons.push_back(std::move(reason)); }

  /// glTF defines the axes of a model; they are used unless the file contradicts them.
  bool stands_by_rule() {
    if (!is_gltf() || (up_ && *up_ != Direction::plus_y) || (across_ && *across_ != 0)) return false;
    if (would_lie()) {
      say("glTF models stand along +Y and face +Z, but this one would lie on its face then");
      return false;
    }
    say("glTF models stand along +Y and face +Z");
    return true;
  }

  /// Whether a head with +Y up would lie on its face, where nothing else tells its axes: so does a model with Z up that
  /// was exported without being turned. Its eyes look down, or it is longer along Z than a standing body is deep.
  /// Neither is certain: a crocodile stands like that.
  [[nodiscard]] bool would_lie() const {
    if (shapes_.empty() || up_ || (across_ && *across_ != 0)) return false;
    constexpr double least_share = 0.2;  // of the head's extent: the eyes of a head that stands are not so low
    if (eyes_) {
      const glm::dvec3 away = (eyes_->middle - skin().box_center()) / glm::max(skin().extent(), glm::dvec3(1e-300));
      if (-away.y > least_share && -away.y > std::abs(away.z)) return true;
    }
    constexpr double least_length = 2.0;  // of the height: a head is about as long as it is high
    const glm::dvec3 size = extent_of_all();
    return size.z > least_length * size.y;
  }

  /// MPEG-4's axes, unless what was seen rules them out. A file with Z up looks along -Y (Blender) or, if Y is across,
  /// along +X (game engines).
  void assume_axes() {
    if (up_is_of_neck_) up_.reset();  // alone it may be the rim of a mask
    const auto by_length = unit_of_height(extent_of_all().z);
    const bool is_long_as_people = by_length && by_length->unit != LengthUnit::inch;
    if (would_lie() && (eyes_ || is_long_as_people)) up_ = Direction::plus_z;
    if (up_ || across_ == 1 || across_ == 2) {
      if (!up_) up_ = across_ == 1 ? Direction::plus_z : Direction::plus_y;
      if (across_ && !front_) find_front();
      const int axis = across_ ? 3 - *across_ - axis_of(*up_) : axis_of(*up_) == 2 ? 1 : 2;
      guess_.axes = {*up_, front_.value_or(direction_along(axis, axis == 1 ? -1.0 : 1.0))};
    }
    say("The axes of the head are uncertain without feature points: " + name(guess_.axes.up) +
        " is assumed to be up, and " + name(guess_.axes.front) + " the front");
  }

  /// Whether a face is seen in the file's own position or, of all that what is known allows, in one alone.
  bool shows_a_face() {
    // Measured on 44 models by other people: faces have 0.87 to 0.98 in their right position and at most 0.86 in any
    // other; models without a face have at most 0.88, and less than `margin` between their best two positions.
    constexpr double clear = 0.87;
    constexpr double margin = 0.05;
    constexpr std::size_t least_triangles = 200;  // the fewest that show eyes, nose and mouth
    if (model_.triangles.size() < least_triangles) return false;
    std::optional<Axes> best;
    double most = allows({}) ? face_likeness({}) : 0.0;
    if (most >= clear) return take_face({});
    double next = 0.0;
    for (const Axes& axes : all_axes()) {
      if (axes == Axes{} || !allows(axes)) continue;
      const double likeness = face_likeness(axes);
      next = std::max(next, std::min(most, likeness));
      if (likeness <= most) continue;
      most = likeness;
      best = axes;
    }
    return best && most >= clear && most >= next + margin && take_face(*best);
  }

  /// 0 where nothing is like a face.
  [[nodiscard]] double face_likeness(const Axes& axes) const {
    const auto relief = FrontRelief::draw(surface_, model_.triangles, to_mpeg4(axes));
    const auto face = relief ? search_face(*relief, reference_heads()) : std::nullopt;
    return face ? face->likeness : 0.0;
  }

  bool take_face(const Axes& axes) {
    guess_.axes = axes;
    say("Seen from " + name(axes.front) + ", with " + name(axes.up) + " up, the model is like a face");
    return true;
  }

  [[nodiscard]] bool allows(const Axes& axes) const {
    const int across = 3 - axis_of(axes.up) - axis_of(axes.front);
    return (!across_ || *across_ == across) && (!up_ || up_is_of_neck_ || *up_ == axes.up);
  }

  void find_across() {
    if (eyes_) {
      across_ = eyes_->axis;
      say(std::string(eyes_->by_name ? "Parts named as eyes" : "Two equal balls, assumed to be eyes,") +
          " are apart along " + letter(eyes_->axis));
      return;
    }
    across_ = find_mirror_axis(skin());
    if (across_) say("The largest part is its own mirror image across " + letter(*across_));
  }

  void find_up() {
    const auto mouth = eyes_ ? find_mouth(shapes_) : std::nullopt;
    if (mouth) {
      const glm::dvec3 rise = eyes_->middle - *mouth;
      const int a = (*across_ + 1) % 3;
      const int b = (*across_ + 2) % 3;
      const int axis = std::abs(rise[a]) > std::abs(rise[b]) ? a : b;
      if (std::abs(rise[axis]) < 1.5 * std::abs(rise[a + b - axis])) return;
      up_ = direction_along(axis, rise[axis]);
      say("The eyes are " + name(*up_) + " of the teeth or tongue");
      return;
    }
    const auto neck = find_neck(model_, surface_, skin_id());
    if (!neck || neck->axis == *across_) return;
    if (eyes_) {
      // A head that ends under its hat is open at the top, and its eyes are near that end.
      const double end = neck->sign > 0.0 ? skin().high[neck->axis] : skin().low[neck->axis];
      if (std::abs(end - eyes_->middle[neck->axis]) < 0.4 * skin().extent()[neck->axis]) return;
    }
    up_ = direction_along(neck->axis, -neck->sign);
    up_is_of_neck_ = true;
    say("The largest part ends open and flat at its " + name(direction_along(neck->axis, neck->sign)) +
        " end, as a neck does");
  }

  void find_front() {
    constexpr double least_crowding = 0.06;
    const int axis = 3 - *across_ - axis_of(*up_);
    const double crowded = crowding(model_, surface_, skin_id(), skin(), axis);
    if (eyes_) {
      // Compare with the head at the height of the eyes: other parts of a body may be behind or in front of them.
      const int height = axis_of(*up_);
      double low = 1e300;
      double high = -1e300;
      for (const glm::dvec3& p : skin().positions) {
        if (std::abs(p[height] - eyes_->middle[height]) > 0.5 * eyes_->separation) continue;
        if (std::abs(p[*across_] - eyes_->middle[*across_]) > 1.5 * eyes_->separation) continue;
        low = std::min(low, p[axis]);
        high = std::max(high, p[axis]);
      }
      const double ahead = eyes_->middle[axis] - 0.5 * (low + high);
      if (!(high > low) || std::abs(ahead) < 0.1 * (high - low)) return;
      if (eyes_->by_name || crowded * ahead >= 0.0 || std::abs(crowded) < least_crowding) {
        front_ = direction_along(axis, ahead);
        say("The eyes are near the " + name(*front_) + " side of the head");
        return;
      }
      say("The balls are near the " + name(direction_along(axis, ahead)) +
          " side of the head, away from the densest vertices: they are hardly eyes");
      eyes_.reset();
    }
    if (std::abs(crowded) < least_crowding) return;
    front_ = direction_along(axis, crowded);
    say("The vertices are densest towards " + name(*front_) + ", as in a face");
  }

  void guess_unit() {
    if (eyes_) {
      if (const auto by_size = unit_of_eye_separation(eyes_->separation)) {
        // Balls without a name are known to be eyes by where they lie on the head.
        take_unit(by_size->unit, by_size->is_sure && (eyes_->by_name || (across_ && up_ && front_)),
                  "The eyes are " + in_three_digits(eyes_->separation) + " apart, which is a face's if the unit is " +
                      std::string(to_string(by_size->unit)));
        return;
      }
    }
    const glm::dvec3 size = extent_of_all();
    const double height = guess_.axes_sure ? size[axis_of(guess_.axes.up)] : std::max({size.x, size.y, size.z});
    const auto by_size = unit_of_height(height);
    const bool is_human_in_metres = by_size && by_size->unit == LengthUnit::metre;
    if (is_gltf() && height >= 0.1 && height <= 2.6) {
      take_unit(LengthUnit::metre, is_human_in_metres,
                "The unit of glTF is the metre, and " + in_three_digits(height) + " m " +
                    (is_human_in_metres ? "fits a head or a body" : "is nearly a head's or a body's size"));
    } else if (by_size) {
      take_unit(by_size->unit, by_size->is_sure && !is_gltf(),
                "The model is " + in_three_digits(height) +
                    " tall, which is a head's, a bust's or a body's size if the unit is " +
                    std::string(to_string(by_size->unit)));
    } else {
      take_unit(LengthUnit::metre, false,
                "The model is " + in_three_digits(height) + " tall, which fits no unit: metres are assumed");
    }
  }

  void take_unit(LengthUnit unit, bool sure, std::string reason) {
    guess_.unit = unit;
    guess_.unit_sure = sure;
    say(std::move(reason) + (sure ? "" : "; this is not certain"));
  }

  const Model& model_;
  const Surface& surface_;
  std::vector<PartShape> shapes_;
  std::size_t skin_ = 0;
  std::optional<EyePair> eyes_;
  std::optional<int> across_;
  std::optional<Direction> up_;
  bool up_is_of_neck_ = false;
  std::optional<Direction> front_;
  ModelFrame guess_;
};

}  // namespace

ModelFrame guess_frame(const Model& model, const Surface& surface) { return ShapeGuess(model, surface).guess(); }

}  // namespace semblante
