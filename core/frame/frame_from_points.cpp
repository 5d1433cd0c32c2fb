#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include "core/anatomy/face_tilt.h"
#include "core/frame/frame_guess.h"
#include "core/frame/human_size.h"
#include "core/tables/mpeg4.h"
#include "core/types/places.h"
#include "core/types/printable.h"

namespace semblante {
namespace {

/// The mean of the points that satisfy a condition; nullopt when none is marked.
template <class Wanted>
std::optional<glm::dvec3> middle(std::span<const PlacedPoint> points, Wanted wanted) {
  glm::dvec3 sum(0.0);
  int count = 0;
  for (const PlacedPoint& point : points) {
    if (!wanted(group_of(point.id), number_of(point.id))) continue;
    sum += point.position;
    ++count;
  }
  return count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
}

/// The mean direction of several pairs of places and their agreement; zero without pairs.
class Evidence {
 public:
  void add(const std::optional<glm::dvec3>& from, const std::optional<glm::dvec3>& to) {
    if (!from || !to) return;
    const double length = glm::distance(*from, *to);
    if (length > 0.0 && std::isfinite(length)) sum_ += (*to - *from) / length;
  }
  [[nodiscard]] glm::dvec3 direction() const {
    const double length = glm::length(sum_);
    return length > 1e-3 ? sum_ / length : glm::dvec3(0.0);
  }

 private:
  glm::dvec3 sum_{0.0};
};

glm::dvec3 left_of(std::span<const PlacedPoint> points) {
  Evidence evidence;
  for (const PlacedPoint& point : points) {
    const mpeg4::FeaturePointInfo& info = mpeg4::feature_points[point.id.value()];
    if (info.side != mpeg4::Side::left) continue;
    for (const PlacedPoint& other : points) {
      if (other.id.value() == info.mirror) evidence.add(other.position, point.position);
    }
  }
  return evidence.direction();
}

/// Compares each level of the face with every level below it. A pair of points counts as its middle, so that a missing
/// side tilts the sum only a little.
glm::dvec3 up_of(std::span<const PlacedPoint> points) {
  const std::array<std::optional<glm::dvec3>, 5> levels = {
      middle(points, [](int group, int number) { return group == 4 || (group == 11 && number <= 3); }),
      middle(points, [](int group, int) { return group == 3; }),
      middle(points, [](int group, int number) { return group == 9 && (number <= 5 || number == 15); }),
      middle(points, [](int group, int number) { return group == 8 || (group == 2 && number >= 2 && number <= 9); }),
      middle(points,
             [](int group, int number) { return group == 2 && (number == 1 || number >= 10) && number <= 12; })};
  Evidence evidence;
  for (std::size_t above = 0; above < levels.size(); ++above) {
    for (std::size_t below = above + 1; below < levels.size(); ++below) evidence.add(levels[below], levels[above]);
  }
  return evidence.direction();
}

/// Compares protruding points with points behind them at about the same height.
glm::dvec3 front_of(std::span<const PlacedPoint> points) {
  const auto nose = middle(points, [](int group, int number) { return group == 9 && number == 3; });
  const auto around = [&points](int a, int a1, int a2, int b, int b1, int b2) {
    return middle(points, [=](int group, int number) {
      return (group == a && (number == a1 || number == a2)) || (group == b && (number == b1 || number == b2));
    });
  };
  Evidence evidence;
  evidence.add(middle(points, [](int group, int) { return group == 10; }), nose);
  evidence.add(around(3, 7, 12, 8, 3, 4), nose);  // outer corners of the eyes, and of the mouth
  evidence.add(middle(points, [](int group, int number) { return group == 9 && (number == 1 || number == 2); }), nose);
  evidence.add(middle(points, [](int group, int number) { return group == 8 && (number == 3 || number == 4); }),
               middle(points, [](int group, int number) { return group == 8 && (number == 1 || number == 2); }));
  evidence.add(middle(points, [](int group, int number) { return group == 2 && (number == 13 || number == 14); }),
               middle(points, [](int group, int) { return group == 8; }));
  evidence.add(middle(points, [](int group, int number) { return group == 11 && number == 6; }), nose);
  return evidence.direction();
}

bool is_known(const glm::dvec3& direction) { return direction != glm::dvec3(0.0); }

Places turned(std::span<const PlacedPoint> points, const glm::dmat3& rotation) {
  Places places;
  for (const PlacedPoint& point : points) places[point.id.value()] = rotation * point.position;
  return places;
}

/// Where the left side, the top and the front of the head are, as far as points show it; zero: unknown.
struct Directions {
  glm::dvec3 left, up, front;

  /// Left and right are exchanged, or the model is a mirror image.
  [[nodiscard]] bool are_mirrored() const {
    return is_known(left) && is_known(up) && is_known(front) && glm::dot(glm::cross(up, front), left) < -0.1;
  }
  /// Two directions determine the third. A single one does not, and a front without an up may be tilted.
  [[nodiscard]] bool are_enough() const { return is_known(up) && (is_known(left) || is_known(front)); }
  [[nodiscard]] double score(const Axes& axes) const {
    const glm::dvec3 u = to_vector(axes.up);
    const glm::dvec3 f = to_vector(axes.front);
    return glm::dot(u, up) + glm::dot(f, front) + glm::dot(glm::cross(u, f), left);
  }
  /// Contradictory points agree with no axes.
  [[nodiscard]] bool agree_with(const Axes& axes) const {
    constexpr double least_agreement = 0.5;
    const auto agrees = [](const glm::dvec3& axis, const glm::dvec3& seen) {
      return !is_known(seen) || glm::dot(axis, seen) > least_agreement;
    };
    const glm::dvec3 u = to_vector(axes.up);
    const glm::dvec3 f = to_vector(axes.front);
    return agrees(u, up) && agrees(f, front) && agrees(glm::cross(u, f), left);
  }
};

/// The axes with the best score, and by how much it is better than the next.
struct BestAxes {
  Axes axes;
  double lead;
};

BestAxes best_axes(const Directions& seen) {
  const auto candidates = all_axes();
  const Axes best = *std::max_element(candidates.begin(), candidates.end(),
                                      [&](const Axes& a, const Axes& b) { return seen.score(a) < seen.score(b); });
  double second = -3.0;
  for (const Axes& axes : candidates) {
    if (axes != best) second = std::max(second, seen.score(axes));
  }
  return {best, seen.score(best) - second};
}

std::string reason_for(const Axes& axes, const Directions& seen, bool is_sure) {
  std::string reason = "The feature points stand " + std::string(to_string(axes.up)) + " up";
  if (is_known(seen.left))
    reason += ", their pairs apart along " + std::string(1, "XYZ"[3 - axis_of(axes.up) - axis_of(axes.front)]);
  reason += ", the face towards " + std::string(to_string(axes.front));
  if (!is_sure) reason += ", but so unclearly that it might be another way";
  return reason;
}

void guess_axes(std::span<const PlacedPoint> points, ModelFrame& guess) {
  Directions seen{left_of(points), up_of(points), front_of(points)};
  if (seen.are_mirrored()) {
    guess.reasons.emplace_back(
        "The points of the left side lie on the right, seen from up and front: left and right are exchanged, or the "
        "model is a mirror image");
    seen.left = glm::dvec3(0.0);
  }
  if (!seen.are_enough()) return;
  const auto [best, lead] = best_axes(seen);
  // A head tilted by 45 degrees is between two axes; the choice needs a clear lead.
  constexpr double least_lead = 0.3;
  const bool is_clear = lead > least_lead && seen.agree_with(best);
  // A head tilted by more shows it by its proportions, unless left and right contradict the rest.
  const bool keeps_axes = best == guess.axes;
  const glm::dmat3 tilt = keeps_axes ? guess.tilt : glm::dmat3(1.0);
  const auto upright = is_known(seen.left) ? upright_rotation(turned(points, tilt * to_mpeg4(best))) : std::nullopt;
  // If no points show the front, exchanged sides would turn the head back to front.
  const bool is_sure = (is_clear || upright) && (is_known(seen.front) || keeps_axes);
  if (is_sure) {
    guess.axes = best;
    guess.tilt = upright ? *upright * tilt : tilt;
  }
  guess.axes_sure = is_sure;
  guess.reasons.push_back(reason_for(best, seen, is_sure));
  if (is_sure && guess.tilt != glm::dmat3(1.0))
    guess.reasons.push_back("The face is tilted by " + std::to_string(std::lround(tilt_of(guess))) +
                            " degrees from these axes, by the symmetry of its points and the proportions of faces");
}

/// Pupils, or the middles of the eyes' corners.
std::optional<double> eye_separation(std::span<const PlacedPoint> points) {
  const auto eye = [&points](int pupil, int corner, int other) {
    if (auto at = middle(points, [=](int g, int n) { return g == 3 && n == pupil; })) return at;
    const auto a = middle(points, [=](int g, int n) { return g == 3 && n == corner; });
    const auto b = middle(points, [=](int g, int n) { return g == 3 && n == other; });
    return a && b ? std::optional(0.5 * (*a + *b)) : std::nullopt;
  };
  const auto left = eye(5, 7, 11);
  const auto right = eye(6, 8, 12);
  return left && right ? std::optional(glm::distance(*left, *right)) : std::nullopt;
}

void guess_unit(std::span<const PlacedPoint> points, ModelFrame& guess) {
  const auto separation = eye_separation(points);
  if (!separation || !(*separation > 0.0)) return;
  const auto by_size = unit_of_eye_separation(*separation);
  guess.unit_sure = by_size && by_size->is_sure;
  if (!by_size) {
    guess.reasons.push_back("The marked eyes are " + in_three_digits(*separation) +
                            " apart, which is no head's size in m, dm, cm, mm or in");
    return;
  }
  guess.unit = by_size->unit;
  guess.reasons.push_back("The marked eyes are " + in_three_digits(*separation) +
                          " apart: " + std::to_string(std::lround(*separation * metres_per(by_size->unit) * 1000.0)) +
                          " mm if the unit is " + std::string(to_string(by_size->unit)) +
                          (guess.unit_sure ? "" : "; this is not certain"));
}

}  // namespace

ModelFrame guess_frame(std::span<const PlacedPoint> points, const ModelFrame& before) {
  ModelFrame guess = before;
  guess.reasons.clear();
  guess_axes(points, guess);
  guess_unit(points, guess);
  if (guess.reasons.empty()) guess.reasons = before.reasons;
  return guess;
}

}  // namespace semblante
