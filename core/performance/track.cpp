#include "core/performance/track.h"

namespace semblante {

void Track::index() {
  block_offsets_.assign(1, 0);
  carried_.clear();
  too_many_.reset();
  std::vector<std::uint32_t> active;
  for (std::size_t i = 0; i < spans_.size(); ++i) {
    std::erase_if(active, [&](std::uint32_t other) { return spans_[other].end <= spans_[i].begin; });
    if (i % spans_per_block == 0) {
      carried_.insert(carried_.end(), active.begin(), active.end());
      block_offsets_.push_back(carried_.size());
    }
    active.push_back(static_cast<std::uint32_t>(i));
    if (active.size() > max_overlapping_cues) {
      too_many_ = spans_[i].cue;
      return;
    }
  }
}

}  // namespace semblante
