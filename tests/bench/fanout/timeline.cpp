#include "tests/bench/fanout/timeline.h"

namespace semblante::bench {
namespace {

/// A reader that is farther behind than this has lost the stream.
constexpr std::size_t kept = 4096;

}  // namespace

std::optional<std::uint64_t> Timeline::index_of(std::uint64_t first_frame) const {
  // Newest first: that is where readers are.
  for (std::size_t i = entries_.size(); i-- > 0;) {
    const Batch& batch = entries_[i].batch;
    if (batch.first == first_frame) return base_ + i;
    if (batch.last + 1 == first_frame) return base_ + i + 1;
    if (batch.last < first_frame) return std::nullopt;
  }
  const auto next = content_->next_frame();
  if (entries_.empty() && (next == 0 || next == first_frame)) return base_;
  return std::nullopt;
}

const Timeline::Entry* Timeline::match(std::uint64_t index, std::string_view bytes, std::int64_t now) {
  if (index < base_ || index > base_ + entries_.size()) return nullptr;
  if (index < base_ + entries_.size()) {
    const Entry& entry = entries_[static_cast<std::size_t>(index - base_)];
    return entry.bytes == bytes ? &entry : nullptr;
  }
  auto batch = content_->next(bytes, now);
  if (!batch) return nullptr;
  ++batches_;
  bytes_ += bytes.size();
  frames_ += batch->last - batch->first + 1;
  entries_.push_back({std::string(bytes), std::move(*batch), now});
  if (entries_.size() > kept) {
    entries_.pop_front();
    ++base_;
  }
  return &entries_.back();
}

}  // namespace semblante::bench
