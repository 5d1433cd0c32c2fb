#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "tests/bench/fanout/content.h"

namespace semblante::bench {

/// The batches of one stream in order, each decoded once by the first subscriber that gets it. All others must get the
/// very same bytes: so every byte of every message is checked at the price of a comparison.
class Timeline {
 public:
  explicit Timeline(std::unique_ptr<Content> content) : content_(std::move(content)) {}

  struct Entry {
    std::string bytes;
    Batch batch;
    std::int64_t earliest = 0;  ///< ns; when the first subscriber had it
  };

  [[nodiscard]] Content& content() { return *content_; }
  [[nodiscard]] const Content& content() const { return *content_; }

  /// Index of the batch that begins with this frame, also of the one that comes next; nullopt when it is long past or
  /// yet to be read.
  [[nodiscard]] std::optional<std::uint64_t> index_of(std::uint64_t first_frame) const;
  /// The batch at the index if these are its bytes: known, or new and then read. nullptr when they are not.
  const Entry* match(std::uint64_t index, std::string_view bytes, std::int64_t now);
  /// For messages of a size that stays: mean bytes of a batch so far.
  [[nodiscard]] double mean_bytes() const {
    return batches_ == 0 ? 0.0 : static_cast<double>(bytes_) / static_cast<double>(batches_);
  }
  [[nodiscard]] std::uint64_t batches() const { return batches_; }
  [[nodiscard]] std::uint64_t frames() const { return frames_; }

 private:
  std::unique_ptr<Content> content_;
  std::deque<Entry> entries_;
  std::uint64_t base_ = 0;  ///< index of entries_.front()
  std::uint64_t batches_ = 0, bytes_ = 0, frames_ = 0;
};

}  // namespace semblante::bench
