#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace semblante::runtime {

/// The messages that the caller has not taken yet, one after the other.
class Outbox {
 public:
  /// Write the message to the end of bytes(), then call end_message().
  std::vector<std::uint8_t>& bytes() {
    reset_if_taken();
    return bytes_;
  }
  void end_message() { ends_.push_back(bytes_.size()); }

  [[nodiscard]] std::size_t waiting() const { return bytes_.size() - begin_; }

  /// The next message, valid until the next call; empty: none.
  std::span<const std::uint8_t> take() {
    reset_if_taken();
    if (taken_ == ends_.size()) return {};
    const std::size_t begin = begin_;
    begin_ = ends_[taken_++];
    return std::span<const std::uint8_t>(bytes_).subspan(begin, begin_ - begin);
  }

  void clear() {
    bytes_.clear();
    ends_.clear();
    taken_ = begin_ = 0;
  }

 private:
  void reset_if_taken() {
    if (taken_ != 0 && taken_ == ends_.size()) clear();
  }

  std::vector<std::uint8_t> bytes_;
  std::vector<std::size_t> ends_;
  std::size_t taken_ = 0, begin_ = 0;
};

}  // namespace semblante::runtime
