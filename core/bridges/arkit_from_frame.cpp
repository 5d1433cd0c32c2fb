#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/bridges/arkit.h"
#include "core/bridges/arkit_shapes.h"
#include "core/bridges/axis_displacements.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

using Faps = std::array<double, SEMBLANTE_FAP_COUNT + 1>;

using Coefficients = std::array<double, arkit_count>;

constexpr std::size_t most_sweeps = 40;
constexpr double least_step = 1e-4;
constexpr std::size_t lid_rounds = 16;
/// Regularization of a coefficient towards 0, square millimetres: makes the solution unique for similar shapes.
constexpr double ridge = 0.05;

double unit_interval(double value) { return std::clamp(value, 0.0, 1.0); }

/// Whether the fit uses a FAP: mouth, jaw, brows, cheeks and nose. Eyes, lids, tongue and head have separate rules.
bool is_fitted(const mpeg4::Fap& fap) {
  return fap.kind == mpeg4::FapKind::translation &&
         (fap.group == 2 || fap.group == 4 || fap.group == 5 || fap.group == 8 || fap.group == 9);
}

/// The fitted shapes and their effects on the fitted FAPs, in millimetres on a usual head. jawOpen and mouthClose are
/// replaced by "parted" (jawOpen only) and "shut" (both), each at least 0, so that mouthClose never exceeds
/// jawOpen.
class Fit {
 public:
  Fit() {
    std::vector<std::size_t> faps;
    for (std::size_t n = 3; n <= SEMBLANTE_FAP_COUNT; ++n) {
      if (is_fitted(mpeg4::fap(n))) faps.push_back(n);
    }
    std::array<std::size_t, arkit_count> place{};
    for (std::size_t s = 0; s < arkit_count; ++s) {
      if (has_own_rule(s)) continue;
      place[s] = shapes_.size();
      shapes_.push_back(s);
    }
    for (const std::size_t s : shapes_) {
      std::vector<double>& column = columns_.emplace_back();
      for (const std::size_t n : faps) {
        const double shut = s == arkit::mouth_close ? arkit::amount(arkit::jaw_open, n) : 0.0;
        column.push_back(millimetres(n) * (arkit::amount(s, n) + shut));
      }
      mirror_.push_back(place[arkit_mirror(s)]);
    }
    faps_ = faps;
    for (const auto& a : columns_) {
      for (const auto& b : columns_) gram_.push_back(dot(a, b));
    }
  }

  /// Coordinate descent on half the squared error + cost. The two sides of a pair are solved together, so that a
  /// symmetric face has symmetric coefficients. Starts from a fixed point and ends when the steps are negligible.
  [[nodiscard]] Coefficients solve(const Faps& displacement) const {
    const std::size_t count = shapes_.size();
    std::vector<double> wanted;
    for (const std::size_t n : faps_) wanted.push_back(millimetres(n) * displacement[n]);
    std::vector<double> x(count);
    std::vector<double> slope(count);
    for (std::size_t i = 0; i < count; ++i) {
      slope[i] = generated::arkit_shapes[shapes_[i]].cost - dot(columns_[i], wanted);
    }
    const auto step_of = [&](std::size_t i, double stiff) {
      return unit_interval(x[i] - (slope[i] + ridge * x[i]) / stiff) - x[i];
    };
    const auto move = [&](std::size_t i, double step) {
      if (step == 0.0) return;
      x[i] += step;
      for (std::size_t k = 0; k < count; ++k) slope[k] += step * gram_[i * count + k];
    };
    for (std::size_t sweep = 0; sweep < most_sweeps; ++sweep) {
      double largest = 0.0;
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t other = mirror_[i];
        if (other < i) continue;
        const double stiff = gram_[i * count + i] + ridge + (other != i ? std::abs(gram_[i * count + other]) : 0.0);
        const double step = step_of(i, stiff);
        const double other_step = other != i ? step_of(other, stiff) : 0.0;
        move(i, step);
        move(other, other_step);
        largest = std::max({largest, std::abs(step), std::abs(other_step)});
      }
      if (largest < least_step) break;
    }
    Coefficients result{};
    for (std::size_t i = 0; i < count; ++i) result[shapes_[i]] = x[i];
    return result;
  }

 private:
  static double millimetres(std::size_t n) {
    // FAP 18 (chin boss) has less weight: its range ends long before the jaw's.
    return generated::arkit_millimetres[static_cast<std::size_t>(mpeg4::fap(n).unit)] / 1024.0 * (n == 18 ? 0.3 : 1.0);
  }
  static bool has_own_rule(std::size_t s) {
    if (s == arkit::tongue_out) return true;
    return std::any_of(std::begin(arkit::eyes), std::end(arkit::eyes), [&](const arkit::Eye& eye) {
      return s == eye.blink || s == eye.look_down || s == eye.look_in || s == eye.look_out || s == eye.look_up ||
             s == eye.squint || s == eye.wide;
    });
  }
  static double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  }

  std::vector<std::size_t> faps_;             ///< fitted
  std::vector<std::size_t> shapes_;           ///< fitted
  std::vector<std::size_t> mirror_;           ///< #shapes_, into shapes_
  std::vector<std::vector<double>> columns_;  ///< #shapes_ of #faps_
  std::vector<double> gram_;                  ///< #shapes_ squared
};

/// Blink, squint and wide from the positions of the two lids minus the effects of gaze and the other shapes. The lower
/// lid distinguishes a squint from a blink.
void read_lids(const arkit::Eye& eye, const Faps& displacement, Coefficients& x) {
  double upper_given = 0.0;
  double lower_given = 0.0;
  for (std::size_t s = 0; s < arkit_count; ++s) {
    upper_given += x[s] * arkit::amount(s, eye.upper_lid);
    lower_given += x[s] * arkit::amount(s, eye.lower_lid);
  }
  const double squint_upper = arkit::amount(eye.squint, eye.upper_lid);
  const double squint_lower = arkit::amount(eye.squint, eye.lower_lid);
  const double wide_upper = arkit::amount(eye.wide, eye.upper_lid);
  const double wide_lower = arkit::amount(eye.wide, eye.lower_lid);
  double blink = 0.0;
  double squint = 0.0;
  double wide = 0.0;
  for (std::size_t round = 0; round < lid_rounds; ++round) {
    const double squinted = upper_given + squint * squint_upper;
    wide = unit_interval((displacement[eye.upper_lid] - squinted) / wide_upper);
    const double upper = squinted + wide * wide_upper;
    const double lower = lower_given + squint * squint_lower + wide * wide_lower;
    const double meet = std::max(lower, arkit::lower_lid_shut);
    const double open = std::max(arkit::lids_shut - meet - upper, arkit::lids_shut / 16.0);
    blink = unit_interval((displacement[eye.upper_lid] - upper) / open);
    const double expected = lower + blink * (meet - lower);
    squint = unit_interval(squint + 0.8 * (displacement[eye.lower_lid] - expected) / squint_lower);
  }
  x[eye.blink] = blink;
  x[eye.squint] = squint;
  x[eye.wide] = wide;
}

void read_gaze(const arkit::Eye& eye, const Faps& displacement, Coefficients& x) {
  const double out = eye.outwards * displacement[eye.yaw] / arkit::full_turn;
  const double down = displacement[eye.pitch] / arkit::full_turn;
  x[eye.look_out] = unit_interval(out);
  x[eye.look_in] = unit_interval(-out);
  x[eye.look_down] = unit_interval(down);
  x[eye.look_up] = unit_interval(-down);
}

}  // namespace

ArkitCoefficients arkit_from_frame(const semblante_frame& frame) {
  static const Fit fit;
  const Faps displacement = axis_displacements(frame);
  Coefficients x = fit.solve(displacement);
  const double shut = x[arkit::mouth_close];
  x[arkit::jaw_open] = std::min(x[arkit::jaw_open] + shut, 1.0);
  x[arkit::mouth_close] = std::min(shut, x[arkit::jaw_open]);
  x[arkit::tongue_out] = unit_interval(displacement[45] / arkit::amount(arkit::tongue_out, 45));
  for (const arkit::Eye& eye : arkit::eyes) {
    read_gaze(eye, displacement, x);
    read_lids(eye, displacement, x);
  }
  ArkitCoefficients result{};
  for (std::size_t s = 0; s < arkit_count; ++s) result[s] = static_cast<float>(x[s]);
  return result;
}

}  // namespace semblante
