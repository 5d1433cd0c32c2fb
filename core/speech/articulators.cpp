#include "core/speech/articulators.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "core/expressions/library.h"
#include "core/tables/mpeg4.h"
#include "core/types/feature_point_id.h"

namespace semblante {
namespace {

struct Component {
  std::string_view point;
  int axis;
  Articulator articulator;
  float weight;  ///< brings lengths that differ in size to what the eye sees of them
};

using enum Articulator;
constexpr std::array<Component, mouth_size> components = {{{"2.1", 1, jaw, 1.0F},
                                                           {"2.2", 1, lips, 1.0F},
                                                           {"2.3", 1, lips, 1.0F},
                                                           {"2.6", 1, lips, 0.5F},
                                                           {"2.8", 1, lips, 0.5F},
                                                           {"2.4", 1, lips, 0.5F},
                                                           {"2.4", 0, width, 3.0F},
                                                           {"8.3", 0, width, 2.0F},
                                                           {"2.2", 2, protrusion, 1.5F},
                                                           {"2.3", 2, protrusion, 1.0F},
                                                           {"8.1", 2, protrusion, 1.0F},
                                                           {"8.2", 2, protrusion, 0.5F},
                                                           {"6.1", 1, tongue, 0.2F},
                                                           {"6.1", 2, tongue, 0.2F}}};

/// Strength at the sound itself, and the fall of its logarithm per ms before and after it.
struct Dominance {
  double strength, before, after;
};
/// Of jaw, lips, width, protrusion, tongue. Our own values.
using Dominances = std::array<Dominance, articulator_count>;

constexpr Dominances dominances_of(SoundKind kind) {
  switch (kind) {
    case SoundKind::silence:
      return {{{1.0, 0.022, 0.022}, {1.0, 0.022, 0.022}, {1.0, 0.02, 0.02}, {1.0, 0.02, 0.02}, {0.5, 0.03, 0.03}}};
    case SoundKind::vowel:
      return {{{1.0, 0.028, 0.028}, {1.0, 0.028, 0.028}, {1.0, 0.02, 0.02}, {1.0, 0.02, 0.02}, {1.0, 0.03, 0.03}}};
    case SoundKind::round_vowel:
      return {{{1.0, 0.028, 0.028}, {1.0, 0.026, 0.026}, {1.6, 0.01, 0.014}, {1.6, 0.008, 0.012}, {1.0, 0.03, 0.03}}};
    case SoundKind::both_lips:
      return {{{0.9, 0.035, 0.035}, {1.5, 0.07, 0.07}, {0.15, 0.03, 0.03}, {0.1, 0.03, 0.03}, {0.05, 0.03, 0.03}}};
    case SoundKind::lip_and_teeth:
      return {{{1.2, 0.03, 0.03}, {4.0, 0.05, 0.05}, {0.5, 0.03, 0.03}, {2.0, 0.04, 0.04}, {0.05, 0.03, 0.03}}};
    case SoundKind::tongue_tip:
      return {{{0.6, 0.03, 0.03}, {0.45, 0.03, 0.03}, {0.25, 0.03, 0.03}, {0.12, 0.03, 0.03}, {2.0, 0.03, 0.03}}};
    case SoundKind::hiss:
      return {{{2.0, 0.03, 0.03}, {0.8, 0.03, 0.03}, {0.4, 0.03, 0.03}, {0.2, 0.03, 0.03}, {1.0, 0.03, 0.03}}};
    case SoundKind::round_consonant:
      return {{{1.6, 0.03, 0.03}, {1.2, 0.03, 0.03}, {1.0, 0.02, 0.02}, {1.4, 0.015, 0.02}, {1.0, 0.03, 0.03}}};
    case SoundKind::tongue_back:
      return {{{0.35, 0.03, 0.03}, {0.3, 0.03, 0.03}, {0.1, 0.03, 0.03}, {0.05, 0.03, 0.03}, {2.0, 0.03, 0.03}}};
    case SoundKind::throat:
      break;
  }
  return {};
}

/// Where a sound is reached: the middle of a vowel, all of a consonant.
constexpr double vowel_edge = 0.25;
/// Lips that close leave a vowel beside them, however short: in its middle their dominance of jaw and lips has fallen
/// by e to this power. So a vowel between two closures opens to nine tenths of its own opening.
constexpr double vowel_escape = 3.0;
/// In a pause the mouth is moved only by a sound that is nearer than this, and ever less with the way to it.
constexpr double anticipation_ms = 120.0, relaxation_ms = 220.0;
constexpr double far_ms = 400.0;  ///< beyond, the slowest dominance is below a twentieth
constexpr double tiny = 1e-9;

/// The falls of a closure's dominance into the vowels before and after it.
struct Falls {
  double before = 0.0, after = 0.0;
};

double into(const Segment& vowel) {
  return vowel.is_vowel() ? vowel_escape / (0.5 * std::max(1.0, vowel.end - vowel.begin)) : 0.0;
}

Falls closure_falls(std::span<const Segment> segments, std::size_t i) {
  Falls falls;
  if (segments[i].sound.kind != SoundKind::both_lips) return falls;
  if (i > 0) falls.before = into(segments[i - 1]);
  if (i + 1 < segments.size()) falls.after = into(segments[i + 1]);
  return falls;
}

/// How much sounds before and after a pause move the mouth at a time within it; 1 outside pauses.
struct PauseShares {
  double sounds_before = 1.0, sounds_after = 1.0;
};

PauseShares pause_shares(double ms, std::span<const Segment> segments) {
  const auto at = std::lower_bound(segments.begin(), segments.end(), ms,
                                   [](const Segment& segment, double time) { return segment.end < time; });
  if (at == segments.end() || !at->is_silence()) return {};
  const auto share = [](double way, double reach) {
    const double x = std::clamp(1.0 - way / reach, 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
  };
  return {share(ms - at->begin, relaxation_ms), share(at->end - ms, anticipation_ms)};
}

std::array<MouthVector, mpeg4::viseme_count> measure_visemes() {
  std::array<MouthVector, mpeg4::viseme_count> mouths{};
  for (std::size_t c = 0; c < mouth_size; ++c) {
    const auto point = parse_feature_point(components[c].point);
    for (std::size_t v = 0; v < mouths.size(); ++v)
      for (const Displacement& displacement : viseme_library()[v].displacements)
        if (displacement.point == *point) mouths[v][c] = components[c].weight * displacement.value[components[c].axis];
  }
  return mouths;
}

}  // namespace

std::span<const MouthVector> viseme_mouths() {
  static const auto mouths = measure_visemes();
  return mouths;
}

Articulator articulator_of(std::size_t component) { return components[component].articulator; }

MouthVector mouth_at(double ms, std::span<const Segment> segments) {
  std::array<double, mouth_size> sums{};
  std::array<double, articulator_count> weights{};
  auto at = std::lower_bound(segments.begin(), segments.end(), ms - far_ms,
                             [](const Segment& segment, double time) { return segment.end < time; });
  const PauseShares pause = pause_shares(ms, segments);
  for (; at != segments.end() && at->begin <= ms + far_ms; ++at) {
    const double edge = at->is_vowel() ? vowel_edge * (at->end - at->begin) : 0.0;
    const double before = std::max(0.0, at->begin + edge - ms);
    const double after = std::max(0.0, ms - (at->end - edge));
    const Dominances dominances = dominances_of(at->sound.kind);
    const Falls least = closure_falls(segments, static_cast<std::size_t>(at - segments.begin()));
    const double seen = at->is_silence() ? 1.0
                        : at->begin > ms ? pause.sounds_after
                        : at->end < ms   ? pause.sounds_before
                                         : 1.0;
    std::array<double, articulator_count> here{};
    for (std::size_t k = 0; k < articulator_count; ++k) {
      const Dominance& dominance = dominances[k];
      const bool opens = k == static_cast<std::size_t>(jaw) || k == static_cast<std::size_t>(lips);
      const double rise = opens ? std::max(dominance.before, least.before) : dominance.before;
      const double fall = opens ? std::max(dominance.after, least.after) : dominance.after;
      here[k] = seen * dominance.strength * std::exp(-rise * before - fall * after);
      weights[k] += here[k];
    }
    const MouthVector& first = viseme_mouths()[at->sound.viseme];
    const MouthVector& other = viseme_mouths()[at->sound.other];
    const double share = at->sound.share;
    for (std::size_t c = 0; c < mouth_size; ++c) {
      const auto articulator = components[c].articulator;
      const double opens = articulator == jaw || articulator == lips ? at->strength : 1.0;
      const double target = at->sound.open * opens * (share * first[c] + (1.0 - share) * other[c]);
      sums[c] += here[static_cast<std::size_t>(articulator)] * target;
    }
  }
  MouthVector mouth{};
  for (std::size_t c = 0; c < mouth_size; ++c) {
    const double weight = weights[static_cast<std::size_t>(components[c].articulator)];
    mouth[c] = static_cast<float>(weight > tiny ? sums[c] / weight : 0.0);
  }
  return mouth;
}

}  // namespace semblante
