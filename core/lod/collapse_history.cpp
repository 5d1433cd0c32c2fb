#include "core/lod/collapse_history.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

void CollapseHistory::end_collapse(double price) {
  edits_after_.push_back(edits_.size());
  counts_.push_back(used_);
  prices_.push_back(std::max(price, std::nextafter(prices_.back(), std::numeric_limits<double>::infinity())));
}

std::size_t CollapseHistory::collapses_at(const CollapseLimit& limit) const {
  const auto dearer = std::upper_bound(prices_.begin(), prices_.end(), limit.price);
  const auto fewer =
      std::partition_point(counts_.begin(), counts_.end(), [&](std::size_t c) { return c >= limit.least_corners; });
  // Each is the first state beyond the limit; the state of no collapse is within both.
  const auto states = std::min(dearer - prices_.begin(), fewer - counts_.begin());
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(states, 1) - 1);
}

void CollapseHistory::append_triangles(const CollapseLimit& limit, std::vector<LevelTriangle>& triangles) const {
  std::vector<LevelTriangle> then = full_;
  const std::size_t end = edits_after_[collapses_at(limit)];
  for (std::size_t e = 0; e < end; ++e) then[edits_[e].triangle].corners = edits_[e].corners;
  std::erase_if(then, [](const LevelTriangle& t) { return t.corners[0] == Model::no_index; });
  std::sort(then.begin(), then.end(), [](const auto& a, const auto& b) { return a.source < b.source; });
  triangles.insert(triangles.end(), then.begin(), then.end());
}

void CollapseHistory::replace_corners(const CollapseLimit& limit, std::span<std::uint32_t> kept) const {
  std::vector<std::array<std::uint32_t, 3>> now;
  now.reserve(full_.size());
  for (const LevelTriangle& triangle : full_) now.push_back(triangle.corners);
  const std::size_t end = edits_after_[collapses_at(limit)];
  for (std::size_t e = 0; e < end; ++e) {
    const Edit& edit = edits_[e];
    if (edit.corners[0] == Model::no_index) continue;
    for (std::size_t c = 0; c < 3; ++c) kept[now[edit.triangle][c]] = edit.corners[c];
    now[edit.triangle] = edit.corners;
  }
  // A corner may have gone to one that went on.
  for (const LevelTriangle& triangle : full_)
    for (const std::uint32_t corner : triangle.corners) {
      std::uint32_t last = corner;
      while (kept[last] != last) last = kept[last];
      for (std::uint32_t at = corner; at != last;) at = std::exchange(kept[at], last);
    }
}

}  // namespace semblante
