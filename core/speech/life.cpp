#include "core/speech/life.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/performance/usual_times.h"
#include "core/types/split_mix.h"

namespace semblante {
namespace {

constexpr double long_without_blink_ms = 4'000.0, least_between_blinks_ms = 900.0;
constexpr double brow_lead_ms = 140.0, brow_ms = 420.0, brow_units = 90.0;  ///< ENS
constexpr double nod_lead_ms = 120.0, nod_ms = 420.0, nod_degrees = 2.6, small_nod_degrees = 1.1;
constexpr double breath_ms = 420.0, breath_degrees = 1.2, least_breath_pause_ms = 200.0;
constexpr double glance_ms = 650.0, least_phrase_for_glance_ms = 1'500.0;

Cue cue_of(double time, double duration, CueTarget target) {
  Cue cue;
  cue.time = time;
  cue.duration = duration;
  cue.target = target;
  return cue;
}

class Life {
 public:
  Life(std::span<const Segment> segments, const Loudness& loudness, std::span<const Interval> taken, std::uint32_t seed,
       double liveliness)
      : segments_(segments), loudness_(loudness), taken_(taken), chance_(seed), liveliness_(liveliness) {}

  std::vector<Cue> cues() {
    const auto phrases = phrases_of(segments_);
    for (std::size_t i = 0; i < phrases.size(); ++i) live(phrases[i], i + 1 == phrases.size());
    return std::move(cues_);
  }

 private:
  void live(const Phrase& phrase, bool is_last) {
    const double begin = segments_[phrase.first].begin;
    const double end = segments_[phrase.last - 1].end;
    const double pause = phrase.first > 0 ? begin - segments_[phrase.first - 1].begin : 0.0;
    if (pause >= least_breath_pause_ms) {
      const double length = std::min(breath_ms, pause);
      turn(begin - length, length, {-breath_degrees, 0.0, 0.0});
    }
    stress(phrase);
    for (double last = begin; last + long_without_blink_ms < end;) {
      last += chance_.between(0.6, 1.0) * long_without_blink_ms;
      blink(last);
    }
    if (chance_.next() < 0.85) blink(end + chance_.between(20.0, 120.0));
    if (end - begin >= least_phrase_for_glance_ms) {
      LookTarget aside;
      aside.yaw = (chance_.next() < 0.5 ? -1.0 : 1.0) * chance_.between(4.0, 9.0);
      aside.pitch = chance_.between(-4.0, 5.0);
      const double from = begin + chance_.between(100.0, 500.0);
      add(cue_of(from, glance_ms, aside));
    }
    if (is_last) return;
    if (chance_.next() < 0.4) turn(end, 700.0, {0.0, chance_.between(-2.0, 2.0), chance_.between(-1.5, 1.5)});
  }

  void stress(const Phrase& phrase) {
    std::optional<std::size_t> loudest;
    std::vector<std::size_t> stressed;
    const auto loud = [this](std::size_t i) { return loudness_.between(segments_[i].begin, segments_[i].end); };
    for (std::size_t i = phrase.first; i < phrase.last; ++i) {
      if (!segments_[i].is_vowel() || segments_[i].stress != Stress::primary) continue;
      stressed.push_back(i);
      if (!loudest || loud(i) > loud(*loudest)) loudest = i;
    }
    double last = -2.0 * nod_ms;
    for (const std::size_t i : stressed) {
      const double at = segments_[i].begin;
      if (i == *loudest) {
        const double size = chance_.between(0.8, 1.2);
        turn(at - nod_lead_ms, nod_ms, {size * nod_degrees, 0.0, 0.0});
        raise_brows(at - brow_lead_ms, size * brow_units);
      } else if (at - last >= nod_ms && chance_.next() < 0.6) {
        turn(at - nod_lead_ms, nod_ms, {chance_.between(0.6, 1.2) * small_nod_degrees, 0.0, 0.0});
      } else {
        continue;
      }
      last = at;
    }
  }

  void raise_brows(double time, double units) {
    const bool is_taken = std::any_of(taken_.begin(), taken_.end(), [&](const Interval& interval) {
      return time < interval.end && interval.begin < time + brow_ms;
    });
    if (is_taken) return;
    for (std::uint8_t fap = 31; fap <= 36; ++fap) {  // inner, middle and outer ends of both brows
      Cue cue = cue_of(time, brow_ms, FapTarget{fap});
      cue.value = std::round(liveliness_ * units);
      cue.attack = brow_lead_ms;
      cue.release = brow_ms - brow_lead_ms - 80.0;
      add(std::move(cue));
    }
  }

  void turn(double time, double length, HeadTarget target) {
    const auto rounded = [this](double value) { return std::round(liveliness_ * value * 10.0) / 10.0; };
    target = {rounded(target.pitch), rounded(target.yaw), rounded(target.roll)};
    Cue cue = cue_of(time, length, target);
    cue.attack = 0.4 * length;
    cue.release = 0.6 * length;
    add(std::move(cue));
  }

  void blink(double time) {
    if (last_blink_ && time - *last_blink_ < least_between_blinks_ms) return;
    last_blink_ = time;
    add(cue_of(time, blink_ms, BlinkTarget{}));
  }

  void add(Cue cue) {
    cue.time = std::max(0.0, std::round(cue.time));
    if (cue.duration) cue.duration = std::round(*cue.duration);
    if (cue.attack) cue.attack = std::floor(*cue.attack);
    if (cue.release) cue.release = std::floor(*cue.release);
    cues_.push_back(std::move(cue));
  }

  std::span<const Segment> segments_;
  const Loudness& loudness_;
  std::span<const Interval> taken_;
  SplitMix chance_;
  double liveliness_;
  std::optional<double> last_blink_;
  std::vector<Cue> cues_;
};

}  // namespace

std::vector<Cue> life_cues(std::span<const Segment> segments, const Loudness& loudness,
                           std::span<const Interval> brows_taken, std::uint32_t seed, double liveliness) {
  return Life(segments, loudness, brows_taken, seed, liveliness).cues();
}

}  // namespace semblante
