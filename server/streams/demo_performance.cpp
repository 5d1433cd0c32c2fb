#include "server/streams/demo_performance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "protocol/cpp/quantizers.h"

namespace semblante::streams {
namespace {

constexpr double loop_seconds = 60.0;

/// A small generator with the same numbers everywhere (the distributions of <random> differ between libraries).
double uniform(std::uint32_t& state, double low, double high) {
  state = state * 1664525U + 1013904223U;
  return low + (high - low) * static_cast<double>(state >> 8U) / 16777216.0;
}

std::uint8_t one_of(std::uint32_t& state, const std::uint8_t* list, std::size_t count) {
  return list[std::min(count - 1, static_cast<std::size_t>(uniform(state, 0.0, static_cast<double>(count))))];
}

/// 0 before 0, 1 after 1, without corners.
double smooth(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

/// Shut in 80 ms, open again in 160: as long as a real blink, and always on at least two frames of 40 ms.
double blink_closure(double since) {
  if (since < 0.0 || since > 0.24) return 0.0;
  return since < 0.08 ? smooth(since / 0.08) : smooth((0.24 - since) / 0.16);
}

double accent_lift(double since) {
  constexpr double rise = 0.14;
  constexpr double fall = 0.45;
  if (since < -rise || since > fall) return 0.0;
  return since < 0.0 ? smooth((since + rise) / rise) : smooth((fall - since) / fall);
}

void set_fap(FaceFrame& frame, int number, double fap_units) {
  const double level = std::round(fap_units / standard_quantizers()[static_cast<std::size_t>(number)]);
  frame.level[static_cast<std::size_t>(number)] = static_cast<std::int16_t>(std::clamp(level, -32767.0, 32767.0));
}

constexpr double angle_units = 1e5;  // AU: 1e-5 rad

/// A sum of slow waves whose periods divide the loop, so that it closes.
double drift(double t, int waves_a, int waves_b, double phase) {
  const double turn = 2.0 * std::numbers::pi * t / loop_seconds;
  return 0.65 * std::sin(waves_a * turn + phase) + 0.35 * std::sin(waves_b * turn + 2.1 * phase);
}

}  // namespace

DemoPerformance::DemoPerformance(std::uint32_t seed) {
  std::uint32_t random = seed * 2654435761U + 12345U;
  speak(random);

  constexpr auto moods = std::to_array<std::uint8_t>({1, 6, 2, 1, 3, 5, 1, 4, 6, 1});  // joy most often
  double at = 2.0;
  for (const auto mood : moods) {
    const double rise = uniform(random, 0.5, 0.8);
    const double hold = uniform(random, 1.4, 2.4);
    const double fall = uniform(random, 0.8, 1.1);
    if (at + rise + hold + fall > loop_seconds - 0.5) break;
    feelings_.push_back({at, rise, hold, fall, mood, uniform(random, 0.65, 1.0)});
    at += rise + hold + fall + uniform(random, 1.0, 2.2);
  }
  for (double t = 1.2; t < loop_seconds - 0.5; t += uniform(random, 3.0, 5.0)) blinks_.push_back(t);
  for (double t = 0.6; t < loop_seconds - 1.5; t += uniform(random, 0.9, 2.6)) {
    const bool back = uniform(random, 0.0, 1.0) < 0.5;  // most of the time at whom it talks to
    glances_.push_back({t, back ? 0.0 : uniform(random, -0.16, 0.16), back ? 0.0 : uniform(random, -0.07, 0.08)});
  }
  glances_.push_back({loop_seconds - 1.0, 0.0, 0.0});
}

void DemoPerformance::speak(std::uint32_t& random) {
  // Syllables of a consonant and a vowel, a few to a word, a few words to a phrase, and a breath.
  constexpr auto consonants = std::to_array<std::uint8_t>({1, 1, 2, 3, 4, 4, 5, 6, 7, 8, 8, 9});
  constexpr auto vowels = std::to_array<std::uint8_t>({10, 10, 11, 12, 13, 14});
  double t = 0.7;
  while (t < loop_seconds - 4.0) {
    const int words = static_cast<int>(uniform(random, 3.0, 7.0));
    for (int word = 0; word < words; ++word) {
      const int syllables = static_cast<int>(uniform(random, 1.0, 3.99));
      for (int syllable = 0; syllable < syllables; ++syllable) {
        visemes_.push_back({t, 0.07, one_of(random, consonants.data(), consonants.size())});
        t += uniform(random, 0.08, 0.13);
        const double vowel = uniform(random, 0.12, 0.22);
        visemes_.push_back({t, 0.09, one_of(random, vowels.data(), vowels.size())});
        if (syllable == 0 && uniform(random, 0.0, 1.0) < 0.3) accents_.push_back({t, uniform(random, 0.4, 1.0)});
        t += vowel;
      }
    }
    visemes_.push_back({t, 0.16, 0});
    t += uniform(random, 0.6, 1.4);
  }
}

FaceFrame DemoPerformance::frame_at(std::chrono::milliseconds time) const {
  const double t = static_cast<double>((time % length).count()) / 1000.0;
  FaceFrame frame;

  const auto viseme =
      std::upper_bound(visemes_.begin(), visemes_.end(), t, [](double at, const Viseme& v) { return at < v.begin; });
  if (viseme != visemes_.begin()) {
    const auto& now = *(viseme - 1);
    frame.viseme.select1 = now.shape;
    frame.viseme.select2 = viseme - 1 == visemes_.begin() ? std::uint8_t{0} : (viseme - 2)->shape;
    frame.viseme.blend = static_cast<std::uint8_t>(std::lround(63.0 * smooth((t - now.begin) / now.ease)));
  }

  for (const auto& feeling : feelings_) {
    const double since = t - feeling.begin;
    const double envelope =
        smooth(since / feeling.rise) * (1.0 - smooth((since - feeling.rise - feeling.hold) / feeling.fall));
    const auto intensity = static_cast<std::uint8_t>(std::lround(63.0 * feeling.strength * envelope));
    if (intensity == 0) continue;
    frame.expression.select1 = feeling.expression;
    frame.expression.intensity1 = intensity;
  }

  double closure = 0.0;
  for (const double blink : blinks_) closure = std::max(closure, blink_closure(t - blink));
  set_fap(frame, 19, 940.0 * closure);  // IRISD: the lids of a neutral face are one iris apart, 1024 units
  set_fap(frame, 20, 940.0 * closure);
  set_fap(frame, 21, 84.0 * closure);
  set_fap(frame, 22, 84.0 * closure);

  double lift = 0.0;
  for (const auto& accent : accents_) lift = std::max(lift, accent.strength * accent_lift(t - accent.at));
  for (const int brow : {31, 32, 33, 34, 35, 36}) set_fap(frame, brow, 75.0 * lift);  // ENS

  const auto glance =
      std::upper_bound(glances_.begin(), glances_.end(), t, [](double at, const Glance& g) { return at < g.begin; });
  double yaw = 0.0;
  double pitch = 0.0;
  if (glance != glances_.begin()) {
    const auto& now = *(glance - 1);
    const Glance before = glance - 1 == glances_.begin() ? Glance{0.0, 0.0, 0.0} : *(glance - 2);
    const double arrived = smooth((t - now.begin) / 0.09);
    yaw = before.yaw + (now.yaw - before.yaw) * arrived;
    pitch = before.pitch + (now.pitch - before.pitch) * arrived;
  }
  for (const int eye : {23, 24}) set_fap(frame, eye, yaw * angle_units);
  for (const int eye : {25, 26}) set_fap(frame, eye, pitch * angle_units);

  // The head drifts, follows the eyes a little, and nods with the accents.
  set_fap(frame, 48, (0.030 * drift(t, 7, 11, 0.4) + 0.035 * lift) * angle_units);
  set_fap(frame, 49, 0.060 * drift(t, 5, 9, 1.3) * angle_units);
  set_fap(frame, 50, 0.028 * drift(t, 4, 13, 2.2) * angle_units);
  return frame;
}

}  // namespace semblante::streams
