#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/bridges/arkit.h"
#include "core/bridges/arkit_shapes.h"
#include "core/bridges/axis_displacements.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

using Faps = std::array<double, SEMBLANTE_FAP_COUNT + 1>;
using Coefficients = std::array<double, arkit_count>;

/// Limits mouthClose to jawOpen, and raises jawOpen where tongueOut needs an open mouth.
void settle_the_mouth(Coefficients& c) {
  const double closed = std::min(c[arkit::mouth_close], c[arkit::jaw_open]);
  const double parted = std::max(c[arkit::jaw_open] - closed, generated::arkit_tongue_parting * c[arkit::tongue_out]);
  c[arkit::mouth_close] = closed;
  c[arkit::jaw_open] = closed + parted;
}

Faps sum_of_shapes(const Coefficients& c) {
  Faps faps{};
  for (std::size_t s = 0; s < arkit_count; ++s) {
    const generated::ArkitShape& shape = generated::arkit_shapes[s];
    for (std::size_t i = shape.first; i < shape.first + shape.count; ++i) {
      faps[generated::arkit_entries[i].fap] += c[s] * generated::arkit_entries[i].value;
    }
  }
  return faps;
}

/// A blink moves the lids from their current position to the closed position. Adding it would move the lids through
/// each other, because trackers report both a blink and a look down for one motion of the lid.
void close_lids(const arkit::Eye& eye, const Coefficients& c, Faps& faps) {
  double& upper = faps[eye.upper_lid];
  double& lower = faps[eye.lower_lid];
  const double crossed = std::max(upper + lower - arkit::lids_shut, 0.0);
  upper -= crossed / 2.0;
  lower -= crossed / 2.0;
  const double blink = c[eye.blink];
  const double meet = std::max(lower, arkit::lower_lid_shut);
  upper += blink * (arkit::lids_shut - meet - upper);
  lower += blink * (meet - lower);
}

void turn_eye(const arkit::Eye& eye, const Coefficients& c, Faps& faps) {
  faps[eye.yaw] = eye.outwards * (c[eye.look_out] - c[eye.look_in]) * arkit::full_turn;
  faps[eye.pitch] = (c[eye.look_down] - c[eye.look_up]) * arkit::full_turn;
}

/// Limits how far the lips press into each other when several shapes close them.
void stop_lips(Faps& faps) {
  constexpr std::array<std::array<std::size_t, 2>, 3> facing = {{{4, 5}, {8, 10}, {9, 11}}};
  for (const auto& [upper, lower] : facing) {
    const double over = std::max(faps[upper] + faps[lower] - generated::arkit_lip_overlap, 0.0);
    faps[upper] -= over / 2.0;
    faps[lower] -= over / 2.0;
  }
}

/// The displacement of a FAP's FP along its axis by a viseme, FAP units.
double reach(std::uint8_t viseme, std::size_t fap) {
  semblante_frame frame{};
  frame.viseme1 = viseme;
  frame.viseme_blend = SEMBLANTE_BLEND_MAX;
  return axis_displacements(frame)[fap];
}

/// Most FPs have no FAP for most directions: a jaw opened by FAPs only would pull the chin to a point. So FAP 1 adds
/// the motion of a viseme, "a" for an open jaw, "u" for protruded lips, in proportion to jaw and lip; low-level FAPs
/// override it on their axes. FAP 1 can show only one of the two at partial strength: the stronger one, by the
/// difference of the two, so that the result is continuous.
void carry_by_viseme(const Coefficients& c, const Faps& faps, semblante_frame& frame) {
  static const double open = reach(arkit::viseme_a, 3);
  static const double forward = reach(arkit::viseme_u, 16);
  const auto share = [](double amount, double full) { return full > 0.0 ? std::clamp(amount / full, 0.0, 1.0) : 0.0; };
  const double pushed = c[arkit::mouth_pucker] * arkit::amount(arkit::mouth_pucker, 16) +
                        c[arkit::mouth_funnel] * arkit::amount(arkit::mouth_funnel, 16);
  // An "a" also parts the lips at points without a FAP; with closed lips it only lowers the chin, a little.
  const double shut = c[arkit::jaw_open] > 0.0 ? c[arkit::mouth_close] / c[arkit::jaw_open] : 0.0;
  const double carried = 1.0 - (1.0 - generated::arkit_carried_when_shut) * shut;
  const double more_open = carried * share(faps[3], open) - share(pushed, forward);
  const long blend = std::lround(std::abs(more_open) * SEMBLANTE_BLEND_MAX);
  if (blend == 0) return;
  frame.viseme1 = more_open > 0.0 ? arkit::viseme_a : arkit::viseme_u;
  frame.viseme_blend = static_cast<std::uint8_t>(blend);
}

/// Sets the smallest level for FAPs that only the viseme would move: a FAP of 0 would not override the viseme. Except
/// the tongue, which follows an open jaw well.
void hold_against_viseme(semblante_frame& frame) {
  semblante_frame viseme{};
  viseme.viseme1 = frame.viseme1;
  viseme.viseme_blend = frame.viseme_blend;
  const auto moved = axis_displacements(viseme);
  for (const mpeg4::Fap& fap : mpeg4::faps) {
    if (fap.kind != mpeg4::FapKind::translation || fap.group == 6 || moved[fap.number] == 0.0) continue;
    const auto least = static_cast<float>(fap.quantizer_step);
    if (std::abs(frame.fap[fap.number]) < least) frame.fap[fap.number] = least;
  }
}

}  // namespace

Result<FrameFromArkit> frame_from_arkit(std::span<const float, arkit_count> coefficients) {
  FrameFromArkit result{};
  Coefficients c{};
  for (std::size_t s = 0; s < arkit_count; ++s) {
    const float given = coefficients[s];
    if (!std::isfinite(given)) {
      return Error{ErrorCode::not_finite, std::string(arkit_name(s)), "is not a finite number"};
    }
    c[s] = std::clamp(static_cast<double>(given), 0.0, 1.0);
    if (given < 0.0F || given > 1.0F) ++result.clamped;
  }
  settle_the_mouth(c);
  Faps faps = sum_of_shapes(c);
  for (const arkit::Eye& eye : arkit::eyes) {
    close_lids(eye, c, faps);
    turn_eye(eye, c, faps);
  }
  stop_lips(faps);
  for (std::size_t n = 3; n < faps.size(); ++n) {
    const mpeg4::Fap& fap = mpeg4::fap(n);
    result.frame.fap[n] =
        static_cast<float>(std::clamp(faps[n], static_cast<double>(fap.min()), static_cast<double>(fap.max())));
  }
  carry_by_viseme(c, faps, result.frame);
  hold_against_viseme(result.frame);
  return result;
}

}  // namespace semblante
