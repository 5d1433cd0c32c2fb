#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/performance/cue.h"

namespace semblante {

/// A cue as it is played: all defaults filled in.
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

  /// 0 outside of begin..end. With other times than its own where a slower motion goes with it.
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
/// Where a cue begins before the one before it has let go, and outlasts it, it takes over from it: that one is held
/// until this one has arrived, so that neighbours cross-fade instead of passing through rest.
class Track {
 public:
  /// The spans by begin, their ends still to be set; `arrival(i)`: ms that span i takes until it covers what is below.
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
  /// The cue (number in the script) at which more than max_overlapping_cues are active; nullopt when that never is.
  [[nodiscard]] std::optional<std::uint32_t> too_many() const { return too_many_; }

  /// f(i, span) for every span active at a time, by rising i. O(log of all + active).
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
      if (++overlaps > 2 * max_overlapping_cues) return;  // refused by index(), or long over many short ones
      const double arrived = spans_[j].begin + arrival(j);
      if (spans_[j].begin + spans_[j].duration <= end || arrived <= end - span.release) continue;
      span.end = arrived;
      span.held = true;
      return;
    }
  }

  void index();

  std::vector<Span> spans_;
  /// By block of spans_per_block: those of earlier blocks that are still active when it begins.
  std::vector<std::uint32_t> carried_;
  std::vector<std::size_t> block_offsets_;
  std::optional<std::uint32_t> too_many_;
};

}  // namespace semblante
