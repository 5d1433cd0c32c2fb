#include "core/lod/collapse_history.h"

#include <algorithm>
#include <utility>

namespace semblante {

CollapseHistory::CollapseHistory(std::vector<LevelTriangle> full) : full_(std::move(full)) {
  now_.reserve(full_.size());
  for (const LevelTriangle& triangle : full_) {
    now_.push_back(triangle.corners);
    for (const std::uint32_t corner : triangle.corners) {
      if (corner >= uses_.size()) uses_.resize(corner + 1, 0);
      used_ += uses_[corner]++ == 0 ? 1 : 0;
    }
  }
  counts_.push_back(used_);
}

void CollapseHistory::count_out(std::uint32_t corner) { used_ -= --uses_[corner] == 0 ? 1 : 0; }

void CollapseHistory::change(std::uint32_t triangle, const std::array<std::uint32_t, 3>& corners) {
  for (const std::uint32_t corner : corners) used_ += uses_[corner]++ == 0 ? 1 : 0;
  for (const std::uint32_t corner : now_[triangle]) count_out(corner);
  now_[triangle] = corners;
  edits_.push_back({triangle, corners});
}

void CollapseHistory::remove(std::uint32_t triangle) {
  for (const std::uint32_t corner : now_[triangle]) count_out(corner);
  edits_.push_back({triangle, {Model::no_index, Model::no_index, Model::no_index}});
}

void CollapseHistory::end_collapse() {
  edits_after_.push_back(edits_.size());
  counts_.push_back(used_);
}

std::size_t CollapseHistory::collapses_within(std::size_t budget) const {
  const auto found = std::partition_point(counts_.begin(), counts_.end(), [&](std::size_t c) { return c > budget; });
  return static_cast<std::size_t>(std::min(found, counts_.end() - 1) - counts_.begin());
}

void CollapseHistory::append_triangles(std::size_t budget, std::vector<LevelTriangle>& triangles) const {
  std::vector<LevelTriangle> then = full_;
  const std::size_t end = edits_after_[collapses_within(budget)];
  for (std::size_t e = 0; e < end; ++e) then[edits_[e].triangle].corners = edits_[e].corners;
  std::erase_if(then, [](const LevelTriangle& t) { return t.corners[0] == Model::no_index; });
  std::sort(then.begin(), then.end(), [](const auto& a, const auto& b) { return a.source < b.source; });
  triangles.insert(triangles.end(), then.begin(), then.end());
}

}  // namespace semblante
