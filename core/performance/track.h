#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/performance/cue.h"

namespace semblante {

/// A cue prepared for playback, with all defaults filled in.
struct Span {
  double begin = 0.0;     ///< ms
  double duration = 0.0;  ///< ms, as the author wrote it
  double end = 0.0;       ///< ms: not active from here on; later than begin + duration where it is held
  double attack = 0.0;
  double release = 0.0;
  Easing easing;
  double value = 1.0;
  std::uint32_t first_key = 0;
  std::uint32_t key_count = 0;
  std::uint32_t cue = 0;  ///< its number in the script
  bool held = false;      ///< the next one takes over from it: no release

  /// 0 outside begin..end. The caller passes other attack and release times than the cue's for a slower motion with it.
  [[nodiscard]] double weight(double ms, double attack_ms, double release_ms) const {
    if (ms < begin || ms >= end) return 0.0;
    const double since = ms - begin;
    double weight = attack_ms > 0.0 ? ease(easing, since / attack_ms) : 1.0;
    if (!held && release_ms > 0.0) weight *= ease(easing, (duration - since) / release_ms);
    return weight;
  }
  [[nodiscard]] double weight(double ms) const { return weight(ms, attack, release); }
};

/// The cues on one target, in the order of the script.
///
/// If the next cue starts before the end of a cue's release and ends later, the earlier cue is held until the next one
/// has arrived, so that neighbours cross-fade instead of passing through rest.
class Track {
 public:
  /// Sets the ends of the spans, which are sorted by begin; `arrival(i)`: ms until span i has full weight.
  template <class Arrival>
  void build(std::vector<Span> spans, Arrival arrival) {
    spans_ = std::move(spans);
    for (auto& span : spans_) span.end = span.begin + span.duration;
    for (std::size_t i = 0; i < spans_.size(); ++i) hold(i, arrival);
    index();
  }

  [[nodiscard]] bool empty() const { return spans_.empty(); }
  [[nodiscard]] std::span<const Span> spans() const { return spans_; }
  [[nodiscard]] std::size_t bytes() const {
    return spans_.capacity() * sizeof(Span) + carried_.capacity() * sizeof(std::uint32_t) +
           block_offsets_.capacity() * sizeof(std::size_t);
  }
  /// The cue (index in the script) at which more than max_overlapping_cues are active; nullopt: never.
  [[nodiscard]] std::optional<std::uint32_t> too_many() const { return too_many_; }

  /// Calls f(i, span) for every span active at a time, by increasing i. O(log(spans) + active).
  template <class F>
  void visit(double ms, F f) const {
    const auto after = std::upper_bound(spans_.begin(), spans_.end(), ms,
                                        [](double time, const Span& span) { return time < span.begin; });
    const auto count = static_cast<std::size_t>(after - spans_.begin());
    if (count == 0) return;
    const std::size_t block = (count - 1) / spans_per_block;
    for (std::size_t k = block_offsets_[block]; k < block_offsets_[block + 1]; ++k) {
      const Span& span = spans_[carried_[k]];
      if (ms < span.end) f(std::size_t{carried_[k]}, span);
    }
    for (std::size_t i = block * spans_per_block; i < count; ++i) {
      if (ms < spans_[i].end) f(i, spans_[i]);
    }
  }

 private:
  static constexpr std::size_t spans_per_block = 32;

  template <class Arrival>
  void hold(std::size_t i, Arrival arrival) {
    Span& span = spans_[i];
    const double end = span.end;
    std::size_t overlaps = 0;
    for (std::size_t j = i + 1; j < spans_.size() && spans_[j].begin <= end; ++j) {
      if (++overlaps > 2 * max_overlapping_cues) return;  // refused by index(), or one long span over many short ones
      const double arrived = spans_[j].begin + arrival(j);
      if (spans_[j].begin + spans_[j].duration <= end || arrived <= end - span.release) continue;
      span.end = arrived;
      span.held = true;
      return;
    }
  }

  void index();

  std::vector<Span> spans_;
  /// Per block of spans_per_block: the spans of earlier blocks that are still active at its start.
  std::vector<std::uint32_t> carried_;
  std::vector<std::size_t> block_offsets_;
  std::optional<std::uint32_t> too_many_;
};

}  // namespace semblante
