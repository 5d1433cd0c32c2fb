#include "core/performance/performance.h"

#include <algorithm>
#include <cmath>

#include "core/performance/idle.h"
#include "core/performance/usual_times.h"

namespace semblante {
namespace {

constexpr double units_per_degree = 1745.3292519943296;  ///< AU: 1e-5 rad

double over(double below, double weight, double value) { return below + weight * (value - below); }

std::uint8_t sixty_thirds(double share) {
  return static_cast<std::uint8_t>(std::lround(SEMBLANTE_BLEND_MAX * std::clamp(share, 0.0, 1.0)));
}

}  // namespace

double Performance::value_of(const Span& span, double ms) const {
  if (span.key_count == 0) return span.value;
  const double since = ms - span.begin;
  const CueKey* first = &keys_[span.first_key];
  const CueKey* last = first + span.key_count;
  const CueKey* after = std::upper_bound(first, last, since, [](double t, const CueKey& key) { return t < key.time; });
  if (after == first) return first->value;
  const CueKey& before = *(after - 1);
  if (after == last || span.easing.kind == EasingKind::step) return before.value;
  const double x = (since - before.time) / (after->time - before.time);
  return before.value + ease(span.easing, x) * (after->value - before.value);
}

void Performance::set_viseme(double ms, semblante_frame& frame) const {
  std::array<double, SEMBLANTE_VISEME_COUNT> weights{};
  weights[0] = 1.0;
  std::size_t active = 0;
  bool whole = false;  // a single cue at full weight: its pair is used unchanged
  VisemeTarget pair;
  double share = 0.0;
  visemes_.visit(ms, [&](std::size_t i, const Span& span) {
    const double weight = std::clamp(span.weight(ms), 0.0, 1.0);
    pair = viseme_shapes_[i];
    share = std::clamp(value_of(span, ms), 0.0, 1.0);
    whole = weight >= 1.0;
    ++active;
    for (double& w : weights) w *= 1.0 - weight;
    weights[pair.viseme] += weight * share;
    weights[pair.other] += weight * (1.0 - share);
  });
  if (active == 0) return;
  if (!whole) {
    std::size_t first = 0;
    std::size_t second = 1;
    if (weights[1] > weights[0]) std::swap(first, second);
    for (std::size_t v = 2; v < weights.size(); ++v) {
      if (weights[v] > weights[first]) {
        second = first;
        first = v;
      } else if (weights[v] > weights[second]) {
        second = v;
      }
    }
    if (first == 0) std::swap(first, second);  // a viseme is blended with silence
    if (weights[first] <= 0.0) return;
    pair = {static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(weights[second] > 0.0 ? second : 0)};
    share = weights[first] / (weights[first] + weights[second]);
  }
  frame.viseme1 = pair.viseme;
  frame.viseme2 = pair.other;
  frame.viseme_blend = sixty_thirds(share);
}

void Performance::set_expression(double ms, semblante_frame& frame) const {
  std::array<double, SEMBLANTE_EXPRESSION_COUNT> intensity{};
  std::size_t first = 0;
  std::size_t second = 0;  // 0 is none and stays 0
  for (std::size_t e = 1; e < expressions_.size(); ++e) {
    if (expressions_[e].empty()) continue;
    expressions_[e].visit(ms, [&](std::size_t /*i*/, const Span& span) {
      intensity[e] = over(intensity[e], std::clamp(span.weight(ms), 0.0, 1.0), value_of(span, ms));
    });
    if (intensity[e] > intensity[first]) {
      second = first;
      first = e;
    } else if (intensity[e] > intensity[second]) {
      second = e;
    }
  }
  const auto set = [&](std::size_t e, std::uint8_t& select, std::uint8_t& out) {
    out = sixty_thirds(intensity[e]);
    select = out > 0 ? static_cast<std::uint8_t>(e) : std::uint8_t{0};
  };
  set(first, frame.expression1, frame.intensity1);
  set(second, frame.expression2, frame.intensity2);
}

Performance::Gaze Performance::gaze_at(double ms) const {
  Gaze gaze;
  double yaw = 0.0;
  double pitch = 0.0;
  double held = 0.0;  // the weight of look cues on the eyes
  looks_.visit(ms, [&](std::size_t i, const Span& span) {
    const Look& look = look_ways_[i];
    const double weight = span.weight(ms);
    const double slow = span.weight(ms, look.head_attack, look.head_release);
    yaw = over(yaw, weight, look.yaw);
    pitch = over(pitch, weight, look.pitch);
    held = over(held, weight, 1.0);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      gaze.eye_yaw[eye] = over(gaze.eye_yaw[eye], weight, look.eye_yaw[eye]);
      gaze.eye_pitch[eye] = over(gaze.eye_pitch[eye], weight, look.eye_pitch[eye]);
    }
    gaze.head[0] = over(gaze.head[0], slow, look.head_pitch);
    gaze.head[1] = over(gaze.head[1], slow, look.head_yaw);
  });
  double turn[3] = {0.0, 0.0, 0.0};
  heads_.visit(ms, [&](std::size_t i, const Span& span) {
    const double weight = span.weight(ms);
    turn[0] = over(turn[0], weight, head_turns_[i].pitch);
    turn[1] = over(turn[1], weight, head_turns_[i].yaw);
    turn[2] = over(turn[2], weight, head_turns_[i].roll);
  });
  for (std::size_t eye = 0; eye < 2; ++eye) {
    gaze.eye_yaw[eye] += yaw - gaze.head[1] - held * turn[1];
    gaze.eye_pitch[eye] += pitch - gaze.head[0] - held * turn[0];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) gaze.head[axis] += turn[axis];
  return gaze;
}

std::size_t Performance::bytes() const {
  std::size_t sum = sizeof(*this) + keys_.capacity() * sizeof(CueKey) +
                    viseme_shapes_.capacity() * sizeof(VisemeTarget) + look_ways_.capacity() * sizeof(Look) +
                    head_turns_.capacity() * sizeof(HeadTarget);
  for (const auto& track : faps_) sum += track.bytes();
  for (const auto& track : expressions_) sum += track.bytes();
  for (const auto& track : blinks_) sum += track.bytes();
  for (const auto* track : {&visemes_, &looks_, &heads_}) sum += track->bytes();
  return sum;
}

semblante_frame Performance::frame_at(double ms, double idle_ms) const {
  semblante_frame frame{};
  set_viseme(ms, frame);
  set_expression(ms, frame);

  Gaze gaze = gaze_at(ms);
  double closure[2] = {0.0, 0.0};
  if (idle_) {
    const IdleMotion idle = idle_at(*idle_, idle_ms);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      gaze.eye_yaw[eye] += idle.eye_yaw;
      gaze.eye_pitch[eye] += idle.eye_pitch;
      closure[eye] = idle.lid_closure;
    }
    gaze.head[0] += idle.head_pitch;
    gaze.head[1] += idle.head_yaw;
    gaze.head[2] += idle.head_roll;
  }
  std::array<double, SEMBLANTE_FAP_COUNT + 1> fap{};
  for (std::size_t eye = 0; eye < 2; ++eye) {
    fap[23 + eye] = units_per_degree * std::clamp(gaze.eye_yaw[eye], -largest_eye_yaw_degrees, largest_eye_yaw_degrees);
    fap[25 + eye] =
        units_per_degree * std::clamp(gaze.eye_pitch[eye], -largest_eye_pitch_degrees, largest_eye_pitch_degrees);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) fap[48 + axis] = units_per_degree * gaze.head[axis];

  for (std::size_t n = 0; n < faps_.size(); ++n) {
    if (faps_[n].empty()) continue;
    faps_[n].visit(
        ms, [&](std::size_t /*i*/, const Span& span) { fap[n] = over(fap[n], span.weight(ms), value_of(span, ms)); });
  }

  for (std::size_t eye = 0; eye < 2; ++eye) {
    double cue = 0.0;
    blinks_[eye].visit(ms, [&](std::size_t /*i*/, const Span& span) {
      cue = over(cue, std::clamp(span.weight(ms), 0.0, 1.0), value_of(span, ms));
    });
    const double lid = std::max(cue, closure[eye]);
    if (lid <= 0.0) continue;
    fap[19 + eye] = over(fap[19 + eye], lid, upper_lid_units);
    fap[21 + eye] = over(fap[21 + eye], lid, lower_lid_units);
  }
  for (std::size_t n = 3; n < fap.size(); ++n) frame.fap[n] = static_cast<float>(fap[n]);
  return frame;
}

}  // namespace semblante
