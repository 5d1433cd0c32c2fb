#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "core/geometry/surface.h"
#include "core/parametrize/point_distances.h"

namespace semblante {

/// A set of slots of PointDistances::points.
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

/// Distances within this relative difference of the smallest are a tie; the lowest id wins.
inline constexpr double distance_tie = 1e-6;
/// A cosine counts as positive above this: symmetric heads have many right angles, which rounding must not decide.
inline constexpr double least_cosine = 1e-6;

/// Region of influence: for each member P of the part the set of points whose regions contain P. A feature point's own
/// vertex is not an ordinary vertex: its set is empty.
std::vector<SlotSet> influence_regions(const Surface& surface, const PointDistances& distances);

/// Points i and j are neighbours if some ordinary vertex is in both regions. #F sets; none holds its own slot.
std::vector<SlotSet> region_neighbors(const std::vector<SlotSet>& regions, std::size_t point_count);

}  // namespace semblante
