#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/types/feature_point_id.h"

namespace semblante {

/// A set of slots of PointDistances::points, or of ids of feature points.
class SlotSet {
 public:
  void insert(std::size_t slot) { words_[slot / 64] |= std::uint64_t{1} << (slot % 64); }
  [[nodiscard]] bool contains(std::size_t slot) const { return ((words_[slot / 64] >> (slot % 64)) & 1U) != 0; }
  [[nodiscard]] bool empty() const { return (words_[0] | words_[1]) == 0; }
  void unite(const SlotSet& other) {
    words_[0] |= other.words_[0];
    words_[1] |= other.words_[1];
  }
  /// Calls `visit(slot)` in rising order.
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::size_t w = 0; w < words_.size(); ++w) {
      for (std::uint64_t rest = words_[w]; rest != 0; rest &= rest - 1) {
        visit(w * 64 + static_cast<std::size_t>(std::countr_zero(rest)));
      }
    }
  }

 private:
  static_assert(feature_point_count <= 128);
  std::array<std::uint64_t, 2> words_{};
};

}  // namespace semblante
