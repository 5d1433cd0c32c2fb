#include "core/speech/mouth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/speech/articulators.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

using mpeg4::viseme_count;
constexpr std::size_t pair_count = viseme_count * (viseme_count - 1) / 2;
constexpr std::size_t kept_pairs = 16;    ///< the best pairs of each step are candidates for the path
constexpr float movement_weight = 1.0F;   ///< of an error in movement, against one in place
constexpr float change_cost = 6000.0F;    ///< of a new pair, in squared units: fewer cues to read
constexpr double closure_lead_ms = 12.0;  ///< how far before the sound the lips are closed
constexpr double key_tolerance = 0.02;
/// Within speech and under an expression the mouth is never all at rest.
constexpr float least_viseme = 1.0F / 63.0F;

struct Pair {
  std::uint8_t first, other;
};

const std::array<Pair, pair_count>& pairs() {
  static const auto all = [] {
    std::array<Pair, pair_count> list{};
    std::size_t n = 0;
    for (std::uint8_t other = 0; other < viseme_count; ++other)
      for (std::uint8_t first = other + 1; first < viseme_count; ++first) list[n++] = {first, other};
    return list;
  }();
  return all;
}

MouthVector mixture(const Pair& pair, float share) {
  MouthVector mouth{};
  for (std::size_t c = 0; c < mouth_size; ++c)
    mouth[c] = share * viseme_mouths()[pair.first][c] + (1.0F - share) * viseme_mouths()[pair.other][c];
  return mouth;
}

float squared(const MouthVector& a, const MouthVector& b) {
  float sum = 0.0F;
  for (std::size_t c = 0; c < mouth_size; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

/// The share of the pair's first viseme that comes nearest to a mouth.
float best_share(const Pair& pair, const MouthVector& wanted) {
  float along = 0.0F;
  float length = 0.0F;
  for (std::size_t c = 0; c < mouth_size; ++c) {
    const float way = viseme_mouths()[pair.first][c] - viseme_mouths()[pair.other][c];
    along += way * (wanted[c] - viseme_mouths()[pair.other][c]);
    length += way * way;
  }
  return length > 0.0F ? std::clamp(along / length, 0.0F, 1.0F) : 1.0F;
}

/// A pair at a step, with the best way to it.
struct State {
  std::uint8_t pair = 0;
  float share = 0.0F;
  MouthVector mouth{};
  float error = 0.0F;
  float cost = 0.0F;
  std::uint8_t from = 0;
};

using Visemes = std::array<bool, viseme_count>;

/// The visemes of the sounds around a time, and rest: a mixture names sounds that are said.
constexpr double around_ms = 130.0;
Visemes visemes_around(double ms, std::span<const Segment> segments) {
  Visemes visemes{};
  visemes[sounds::sil] = true;
  auto at = std::lower_bound(segments.begin(), segments.end(), ms - around_ms,
                             [](const Segment& segment, double time) { return segment.end < time; });
  for (; at != segments.end() && at->begin <= ms + around_ms; ++at)
    visemes[at->sound.viseme] = visemes[at->sound.other] = true;
  return visemes;
}

struct Step {
  double time = 0.0;
  Visemes allowed{};
  MouthVector wanted{};
  bool closed = false, speaks = false;
  std::vector<State> states;
};

/// Where the closure of a p, b or m ends. At steps of `mouth_step_ms` up to a step of it is not seen, so it is a step
/// longer where the vowel after it has room: the second half is left to it, and two steps between two closures.
double closure_end(std::span<const Segment> segments, std::size_t i) {
  const double begin = segments[i].begin - closure_lead_ms;
  const double least = std::max(segments[i].end - closure_lead_ms, begin + least_closure_ms);
  double wanted = begin + least_closure_ms + mouth_step_ms;
  if (i + 1 < segments.size() && segments[i + 1].is_vowel()) {
    const Segment& vowel = segments[i + 1];
    wanted = std::min(wanted, vowel.middle());
    if (i + 2 < segments.size() && segments[i + 2].sound.kind == SoundKind::both_lips)
      wanted = std::min(wanted, vowel.end - closure_lead_ms - 2.0 * mouth_step_ms);
  }
  return std::max(least, wanted);
}

bool is_closed(double ms, std::span<const Segment> segments) {
  const auto near = std::lower_bound(segments.begin(), segments.end(), ms - 2.0 * least_closure_ms,
                                     [](const Segment& segment, double time) { return segment.end < time; });
  for (auto i = static_cast<std::size_t>(near - segments.begin()); i < segments.size(); ++i) {
    if (segments[i].begin - closure_lead_ms > ms) break;
    if (segments[i].sound.kind == SoundKind::both_lips && ms <= closure_end(segments, i)) return true;
  }
  return false;
}

void fill(Step& step) {
  for (std::size_t p = 0; p < pair_count; ++p) {
    State state;
    state.pair = static_cast<std::uint8_t>(p);
    if (!step.allowed[pairs()[p].first] || !step.allowed[pairs()[p].other]) continue;
    if (step.closed) {
      if (pairs()[p].first != sounds::p_b_m && pairs()[p].other != sounds::p_b_m) continue;
      state.share = pairs()[p].first == sounds::p_b_m ? 1.0F : 0.0F;
    } else {
      state.share = best_share(pairs()[p], step.wanted);
      if (step.speaks && pairs()[p].other == sounds::sil) state.share = std::max(state.share, least_viseme);
    }
    state.mouth = mixture(pairs()[p], state.share);
    state.error = step.closed ? 0.0F : squared(state.mouth, step.wanted);
    step.states.push_back(state);
  }
  if (step.states.empty()) step.states.push_back({});  // only rest is near: pair 0 with nothing of its first
  if (step.states.size() <= kept_pairs) return;
  std::nth_element(step.states.begin(), step.states.begin() + kept_pairs, step.states.end(),
                   [](const State& a, const State& b) { return a.error < b.error; });
  step.states.resize(kept_pairs);
}

void connect(const Step& before, Step& step) {
  MouthVector wanted{};
  for (std::size_t c = 0; c < mouth_size; ++c) wanted[c] = step.wanted[c] - before.wanted[c];
  for (State& state : step.states) {
    float best = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < before.states.size(); ++i) {
      const State& from = before.states[i];
      float movement = 0.0F;
      for (std::size_t c = 0; c < mouth_size; ++c) {
        const float difference = state.mouth[c] - from.mouth[c] - wanted[c];
        movement += difference * difference;
      }
      const float cost = from.cost + movement_weight * movement + (from.pair == state.pair ? 0.0F : change_cost);
      if (cost < best) {
        best = cost;
        state.from = static_cast<std::uint8_t>(i);
      }
    }
    state.cost = best + state.error;
  }
}

struct Shown {
  double time = 0.0;
  Pair pair{};
  float share = 0.0F;
  [[nodiscard]] bool is_rest() const { return share <= 0.0F && pair.other == sounds::sil; }
};

std::vector<Shown> best_path(std::vector<Step>& steps) {
  for (State& state : steps.front().states) state.cost = state.error;
  for (std::size_t i = 1; i < steps.size(); ++i) connect(steps[i - 1], steps[i]);
  const auto& last = steps.back().states;
  auto at = static_cast<std::size_t>(
      std::min_element(last.begin(), last.end(), [](const State& a, const State& b) { return a.cost < b.cost; }) -
      last.begin());
  std::vector<Shown> path(steps.size());
  for (std::size_t i = steps.size(); i-- > 0;) {
    const State& state = steps[i].states[at];
    path[i] = {steps[i].time, pairs()[state.pair], state.share};
    at = state.from;
  }
  return path;
}

/// Removes keys between which a straight line is as good.
std::vector<CueKey> thinned(const std::vector<CueKey>& keys) {
  std::vector<CueKey> kept = {keys.front()};
  for (std::size_t from = 0; from + 1 < keys.size();) {
    std::size_t to = from + 1;
    for (std::size_t next = to + 1; next < keys.size(); ++next) {
      bool straight = true;
      for (std::size_t k = from + 1; k < next && straight; ++k) {
        const double x = (keys[k].time - keys[from].time) / (keys[next].time - keys[from].time);
        const double line = keys[from].value + x * (keys[next].value - keys[from].value);
        // Nothing and all of a viseme stay exact: lips that are closed are closed.
        const bool is_whole = keys[k].value <= 0.0 || keys[k].value >= 1.0;
        straight = std::abs(line - keys[k].value) <= (is_whole ? 0.0 : key_tolerance);
      }
      if (!straight) break;
      to = next;
    }
    kept.push_back(keys[to]);
    from = to;
  }
  return kept;
}

/// A cue for steps begin..end of one pair; it fades in from what was before, over one step.
Cue cue_of(std::span<const Shown> path, std::size_t begin, std::size_t end) {
  Cue cue;
  const bool fades_in = begin > 0;
  cue.time = path[begin].time - (fades_in ? mouth_step_ms : 0.0);
  const bool to_rest = end == path.size() || path[end].is_rest();
  cue.duration = path[end - 1].time + mouth_step_ms - cue.time;
  cue.attack = fades_in ? mouth_step_ms : 0.0;
  cue.release = to_rest ? mouth_step_ms : 0.0;
  cue.easing.kind = EasingKind::linear;
  cue.target = VisemeTarget{path[begin].pair.first, path[begin].pair.other};
  std::vector<CueKey> keys;
  for (std::size_t i = begin; i < end; ++i)
    keys.push_back({path[i].time - cue.time, std::round(path[i].share * 1000.0) / 1000.0});
  cue.keys = thinned(keys);
  return cue;
}

}  // namespace

std::vector<Cue> mouth_cues(std::span<const Segment> segments, std::span<const Interval> expressive) {
  if (segments.empty()) return {};
  const auto count = static_cast<std::size_t>(segments.back().end / mouth_step_ms) + 1;
  const auto phrases = phrases_of(segments);
  if (phrases.empty()) return {};
  const double speech_begin = segments[phrases.front().first].begin;
  const double speech_end = segments[phrases.back().last - 1].end;
  std::vector<Step> steps(count);
  for (std::size_t i = 0; i < count; ++i) {
    Step& step = steps[i];
    step.time = static_cast<double>(i) * mouth_step_ms;
    step.closed = is_closed(step.time, segments);
    step.wanted = step.closed ? viseme_mouths()[sounds::p_b_m] : mouth_at(step.time, segments);
    step.allowed = visemes_around(step.time, segments);
    const bool has_expression = std::any_of(expressive.begin(), expressive.end(),
                                            [&](const Interval& span) { return span.contains(step.time); });
    step.speaks = has_expression || (step.time >= speech_begin && step.time <= speech_end);
    if (has_expression) step.allowed[sounds::a] = true;  // it moves all that an expression moves
    fill(step);
  }
  const auto path = best_path(steps);
  std::vector<Cue> cues;
  for (std::size_t begin = 0; begin < path.size();) {
    if (path[begin].is_rest()) {
      ++begin;
      continue;
    }
    std::size_t end = begin + 1;
    while (end < path.size() && !path[end].is_rest() && path[end].pair.first == path[begin].pair.first &&
           path[end].pair.other == path[begin].pair.other)
      ++end;
    cues.push_back(cue_of(path, begin, end));
    begin = end;
  }
  return cues;
}

}  // namespace semblante
