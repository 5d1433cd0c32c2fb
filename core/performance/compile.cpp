#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <variant>

#include "core/performance/performance.h"
#include "core/performance/sine_and_cosine.h"
#include "core/performance/usual_times.h"
#include "core/tables/mpeg4.h"
#include "core/types/decimal.h"

namespace semblante {
namespace {

constexpr double largest_degrees = 90.0;
constexpr double largest_level = 32767.0;
constexpr double nearest_look = 1.0;  ///< eye distances

static_assert(std::variant_size_v<CueTarget> == usual_ramps.size());

std::string text_of(double value) {
  std::string text = fixed_text(value, 6);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

/// Keeps the first error of a script, with its pointer.
class Checker {
 public:
  void at(std::size_t cue) { cue_ = "/cues/" + natural_text(cue); }
  void fail(ErrorCode code, std::string_view member, std::string message) {
    if (!fault_) fault_ = Error{code, cue_ + std::string(member), std::move(message)};
  }
  /// Returns false and keeps an error when `value` is out of range.
  bool within(double value, double least, double most, std::string_view member) {
    if (!std::isfinite(value)) return fail(ErrorCode::not_finite, member, "must be finite"), false;
    if (value >= least && value <= most) return true;
    return fail(ErrorCode::out_of_range, member, "must be between " + text_of(least) + " and " + text_of(most)), false;
  }
  void leave_cues() { cue_.clear(); }
  [[nodiscard]] const std::optional<Error>& fault() const { return fault_; }

 private:
  std::string cue_;
  std::optional<Error> fault_;
};

/// The range of a target's values, and the JSON member of the target.
struct ValueRange {
  double least, most;
};

ValueRange value_range(const CueTarget& target) {
  if (const auto* fap = std::get_if<FapTarget>(&target)) {
    const double most = largest_level * mpeg4::fap(fap->fap).quantizer_step;
    return {-most, most};
  }
  return {0.0, 1.0};
}

void check_target(const CueTarget& target, Checker& check) {
  if (const auto* fap = std::get_if<FapTarget>(&target)) {
    if (fap->fap < 3 || fap->fap > SEMBLANTE_FAP_COUNT)
      check.fail(ErrorCode::out_of_range, "/fap", "low-level FAPs are 3 to 68; 1 and 2 are viseme and expression");
  } else if (const auto* viseme = std::get_if<VisemeTarget>(&target)) {
    if (viseme->viseme >= SEMBLANTE_VISEME_COUNT || viseme->other >= SEMBLANTE_VISEME_COUNT)
      check.fail(ErrorCode::out_of_range, "/viseme", "visemes are 0 to 14");
  } else if (const auto* expression = std::get_if<ExpressionTarget>(&target)) {
    if (expression->expression < 1 || expression->expression >= SEMBLANTE_EXPRESSION_COUNT)
      check.fail(ErrorCode::out_of_range, "/expression", "expressions are 1 to 6");
  } else if (const auto* look = std::get_if<LookTarget>(&target)) {
    check.within(look->yaw, -largest_degrees, largest_degrees, "/look_at/yaw");
    check.within(look->pitch, -largest_degrees, largest_degrees, "/look_at/pitch");
    check.within(look->head_share, 0.0, 1.0, "/look_at/head_share");
    if (!(look->distance >= nearest_look))
      check.fail(ErrorCode::out_of_range, "/look_at/distance", "must be at least one eye distance");
  } else if (const auto* blink = std::get_if<BlinkTarget>(&target)) {
    if (!blink->left && !blink->right) check.fail(ErrorCode::empty, "/blink", "neither eye");
  } else if (const auto* head = std::get_if<HeadTarget>(&target)) {
    check.within(head->pitch, -largest_degrees, largest_degrees, "/head/pitch");
    check.within(head->yaw, -largest_degrees, largest_degrees, "/head/yaw");
    check.within(head->roll, -largest_degrees, largest_degrees, "/head/roll");
  }
}

void check_easing(const Easing& easing, Checker& check) {
  if (easing.kind != EasingKind::bezier) return;
  check.within(easing.x1, 0.0, 1.0, "/easing/0");
  check.within(easing.y1, -1.0, 2.0, "/easing/1");
  check.within(easing.x2, 0.0, 1.0, "/easing/2");
  check.within(easing.y2, -1.0, 2.0, "/easing/3");
}

void check_values(const Cue& cue, Checker& check) {
  const ValueRange range = value_range(cue.target);
  if (cue.keys.empty()) {
    check.within(cue.value, range.least, range.most, "/value");
    return;
  }
  double before = -1.0;
  for (std::size_t k = 0; k < cue.keys.size() && !check.fault(); ++k) {
    const std::string key = "/keys/" + natural_text(k);
    check.within(cue.keys[k].time, 0.0, max_performance_ms, key + "/0");
    check.within(cue.keys[k].value, range.least, range.most, key + "/1");
    if (cue.keys[k].time <= before) check.fail(ErrorCode::out_of_range, key + "/0", "times of keys must increase");
    before = cue.keys[k].time;
  }
}

/// Attack and release: given values must fit into the duration; defaults are shortened to the remaining time.
Ramps fitted_ramps(const Cue& cue, double duration, Checker& check) {
  Ramps usual = cue.keys.empty() ? usual_ramps[cue.target.index()].ramps : Ramps{0.0, 0.0};
  if (cue.attack) check.within(*cue.attack, 0.0, duration, "/attack");
  if (cue.release) check.within(*cue.release, 0.0, duration, "/release");
  if (check.fault()) return usual;
  if (cue.attack && cue.release) {
    if (*cue.attack + *cue.release > duration)
      check.fail(ErrorCode::invalid_argument, "/release", "attack and release together are longer than the cue");
    return {*cue.attack, *cue.release};
  }
  if (cue.attack) return {*cue.attack, std::min(usual.release, duration - *cue.attack)};
  if (cue.release) return {std::min(usual.attack, duration - *cue.release), *cue.release};
  const double shrink = std::min(1.0, duration / std::max(1e-9, usual.attack + usual.release));
  return {usual.attack * shrink, usual.release * shrink};
}

double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

}  // namespace

struct Performance::Compiler {
  Performance made;
  Checker check;
  std::array<std::vector<Span>, SEMBLANTE_FAP_COUNT + 1> faps;
  std::vector<Span> visemes, looks, heads;
  std::array<std::vector<Span>, SEMBLANTE_EXPRESSION_COUNT> expressions;
  std::array<std::vector<Span>, 2> blinks;
  double last_end = 0.0;

  void add(const Cue& cue, std::size_t number) {
    check_target(cue.target, check);
    check_easing(cue.easing, check);
    if (check.fault()) return;
    check_values(cue, check);
    double duration = 0.0;
    if (cue.duration) {
      duration = *cue.duration;
    } else if (!cue.keys.empty()) {
      duration = cue.keys.back().time;
    } else if (std::holds_alternative<BlinkTarget>(cue.target)) {
      duration = blink_ms;
    } else {
      check.fail(ErrorCode::missing, "/duration", "is required where there are no keys");
    }
    if (!std::isfinite(duration)) check.fail(ErrorCode::not_finite, "/duration", "must be finite");
    if (!(duration > 0.0)) check.fail(ErrorCode::out_of_range, "/duration", "must be longer than nothing");
    if (cue.time + duration > max_performance_ms)
      check.fail(ErrorCode::out_of_range, "/duration", "ends after " + text_of(max_performance_ms) + " ms");
    if (check.fault()) return;
    if (!cue.keys.empty() && cue.keys.back().time > duration)
      check.fail(ErrorCode::out_of_range, "/keys/" + natural_text(cue.keys.size() - 1) + "/0",
                 "comes after the end of its cue");
    if (made.keys_.size() + cue.keys.size() > max_performance_keys)
      check.fail(ErrorCode::too_large, "/keys", "more than " + natural_text(max_performance_keys) + " keys in all");
    const Ramps ramps = fitted_ramps(cue, duration, check);
    if (check.fault()) return;

    Span span;
    span.begin = cue.time;
    span.duration = duration;
    span.attack = ramps.attack;
    span.release = ramps.release;
    span.easing = cue.easing;
    span.value = cue.value;
    span.cue = static_cast<std::uint32_t>(number);
    span.first_key = static_cast<std::uint32_t>(made.keys_.size());
    span.key_count = static_cast<std::uint32_t>(cue.keys.size());
    made.keys_.insert(made.keys_.end(), cue.keys.begin(), cue.keys.end());
    last_end = std::max(last_end, cue.time + duration);
    place(span, cue.target);
  }

  void place(const Span& span, const CueTarget& target) {
    if (const auto* fap = std::get_if<FapTarget>(&target)) {
      faps[fap->fap].push_back(span);
    } else if (const auto* viseme = std::get_if<VisemeTarget>(&target)) {
      visemes.push_back(span);
      made.viseme_shapes_.push_back(*viseme);
    } else if (const auto* expression = std::get_if<ExpressionTarget>(&target)) {
      expressions[expression->expression].push_back(span);
    } else if (const auto* look = std::get_if<LookTarget>(&target)) {
      looks.push_back(span);
      made.look_ways_.push_back(way_of(*look, span));
    } else if (const auto* blink = std::get_if<BlinkTarget>(&target)) {
      if (blink->left) blinks[0].push_back(span);
      if (blink->right) blinks[1].push_back(span);
    } else if (const auto* head = std::get_if<HeadTarget>(&target)) {
      heads.push_back(span);
      made.head_turns_.push_back(*head);
    }
  }

  static Look way_of(const LookTarget& target, const Span& span) {
    Look look{};
    look.yaw = target.yaw;
    look.pitch = target.pitch;
    look.head_yaw = target.head_share * target.yaw;
    look.head_pitch = target.head_share * target.pitch;
    look.head_attack = std::min(std::max(span.attack, head_ramps.attack), 0.5 * span.duration);
    look.head_release = std::min(std::max(span.release, head_ramps.release), 0.5 * span.duration);
    if (!std::isfinite(target.distance)) return look;
    const double yaw = target.yaw * std::numbers::pi / 180.0;
    const double pitch = target.pitch * std::numbers::pi / 180.0;
    const auto [sine_of_yaw, cosine_of_yaw] = sine_and_cosine(yaw);
    const auto [sine_of_pitch, cosine_of_pitch] = sine_and_cosine(pitch);
    const double x = target.distance * cosine_of_pitch * sine_of_yaw;
    const double y = -target.distance * sine_of_pitch;
    const double z = target.distance * cosine_of_pitch * cosine_of_yaw;
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const double from_eye = x - (eye == 0 ? 0.5 : -0.5);  // the left eye is half an eye distance along +x
      look.eye_yaw[eye] = degrees(std::atan2(from_eye, z)) - target.yaw;
      look.eye_pitch[eye] = degrees(std::atan2(-y, std::hypot(from_eye, z))) - target.pitch;
    }
    return look;
  }

  void build(Track& track, std::vector<Span>& spans) {
    std::vector<double> attacks;
    attacks.reserve(spans.size());
    for (const Span& span : spans) attacks.push_back(span.attack);
    track.build(std::move(spans), [&](std::size_t i) { return attacks[i]; });
    refuse_crowd(track);
  }

  void refuse_crowd(const Track& track) {
    if (!track.too_many()) return;
    check.at(*track.too_many());
    check.fail(ErrorCode::too_large, "",
               "more than " + natural_text(max_overlapping_cues) + " cues act on one target at once");
  }

  void finish() {
    for (std::size_t n = 0; n < faps.size(); ++n) build(made.faps_[n], faps[n]);
    build(made.visemes_, visemes);
    for (std::size_t e = 0; e < expressions.size(); ++e) build(made.expressions_[e], expressions[e]);
    for (std::size_t eye = 0; eye < 2; ++eye) build(made.blinks_[eye], blinks[eye]);
    build(made.heads_, heads);
    std::vector<double> arrivals;
    for (std::size_t i = 0; i < looks.size(); ++i)
      arrivals.push_back(std::max(looks[i].attack, made.look_ways_[i].head_attack));
    made.looks_.build(std::move(looks), [&](std::size_t i) { return arrivals[i]; });
    refuse_crowd(made.looks_);
  }
};

Result<Performance> Performance::compile(const PerformanceScript& script) {
  Compiler compiler;
  Checker& check = compiler.check;
  if (script.cues.size() > max_performance_cues)
    return Error{ErrorCode::too_large, "/cues",
                 "a performance has at most " + natural_text(max_performance_cues) + " cues"};
  if (script.cues.empty() && !script.idle && !script.duration)
    return Error{ErrorCode::empty, "", "there is nothing in it to play: no cues and no idle life"};
  double before = 0.0;
  for (std::size_t i = 0; i < script.cues.size(); ++i) {
    const Cue& cue = script.cues[i];
    check.at(i);
    if (check.within(cue.time, 0.0, max_performance_ms, "/time") && cue.time < before)
      check.fail(ErrorCode::out_of_range, "/time",
                 "is out of order: " + text_of(cue.time) + " after " + text_of(before));
    if (!check.fault()) compiler.add(cue, i);
    if (check.fault()) return *check.fault();
    before = cue.time;
  }
  compiler.finish();
  check.leave_cues();
  Performance& made = compiler.made;
  made.name_ = script.name;
  made.cue_count_ = script.cues.size();
  made.duration_ = compiler.last_end;
  if (script.duration && check.within(*script.duration, 0.0, max_performance_ms, "/duration")) {
    if (*script.duration < compiler.last_end)
      check.fail(ErrorCode::out_of_range, "/duration",
                 "is shorter than the cues, which end at " + text_of(compiler.last_end));
    if (*script.duration <= 0.0) check.fail(ErrorCode::out_of_range, "/duration", "must be longer than nothing");
    made.duration_ = *script.duration;
  }
  if (script.idle) {
    check.within(script.idle->blinks_per_minute, 0.0, 40.0, "/idle/blinks_per_minute");
    check.within(script.idle->head, 0.0, 1.0, "/idle/head");
    check.within(script.idle->eyes, 0.0, 1.0, "/idle/eyes");
    made.idle_ = script.idle;
  }
  if (check.fault()) return *check.fault();
  return std::move(made);
}

}  // namespace semblante
