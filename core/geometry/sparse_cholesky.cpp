#include "core/geometry/sparse_cholesky.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <glm/common.hpp>

namespace semblante {
namespace {

/// Sets with fewer vertices are not divided.
constexpr std::size_t least_divided = 12;
/// A pivot is at least this share of the diagonal entry: rounding may not make it zero or negative.
constexpr double least_pivot = 1e-14;

class Dissection {
 public:
  Dissection(const SparseMatrix& matrix, std::span<const glm::dvec3> positions)
      : matrix_(matrix), positions_(positions), is_beyond_(positions.size(), false) {}

  void divide(std::span<std::uint32_t> set) {
    if (set.size() < least_divided) return;
    const int axis = longest_axis(set);
    const auto middle = set.begin() + static_cast<std::ptrdiff_t>(set.size() / 2);
    std::nth_element(set.begin(), middle, set.end(), [&](std::uint32_t a, std::uint32_t b) {
      return positions_[a][axis] != positions_[b][axis] ? positions_[a][axis] < positions_[b][axis] : a < b;
    });
    for (auto at = middle; at != set.end(); ++at) is_beyond_[*at] = true;
    const auto between = std::partition(set.begin(), middle, [&](std::uint32_t v) { return !touches_beyond(v); });
    for (auto at = middle; at != set.end(); ++at) is_beyond_[*at] = false;
    const auto near_count = static_cast<std::size_t>(between - set.begin());
    const auto far_count = static_cast<std::size_t>(set.end() - middle);
    std::rotate(between, middle, set.end());
    divide(set.first(near_count));
    divide(set.subspan(near_count, far_count));
  }

 private:
  [[nodiscard]] int longest_axis(std::span<const std::uint32_t> set) const {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    for (const std::uint32_t v : set) {
      low = glm::min(low, positions_[v]);
      high = glm::max(high, positions_[v]);
    }
    const glm::dvec3 size = high - low;
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
  }
  [[nodiscard]] bool touches_beyond(std::uint32_t v) const {
    const auto row = matrix_.row(v);
    return std::any_of(row.begin(), row.end(), [&](const SparseMatrix::Entry& e) { return is_beyond_[e.column]; });
  }

  const SparseMatrix& matrix_;
  std::span<const glm::dvec3> positions_;
  std::vector<bool> is_beyond_;
};

}  // namespace

std::vector<std::uint32_t> dissection_order(const SparseMatrix& matrix, std::span<const glm::dvec3> positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  Dissection(matrix, positions).divide(order);
  return order;
}

// Up-looking: row by row. The columns that have an entry in row k are found along the elimination tree, in which the
// parent of a column is the first row below its diagonal: those of the matrix's entries in row k, and their ancestors
// before k.
SparseCholesky::SparseCholesky(const SparseMatrix& matrix, std::vector<std::uint32_t> order)
    : order_(std::move(order)), diagonal_(order_.size()), columns_(order_.size()) {
  constexpr std::uint32_t none = 0xFFFFFFFFU;
  std::vector<double> rest(order_.size(), 0.0);          // what is left of row k, by column
  std::vector<std::uint32_t> seen(order_.size(), none);  // the last row that a column is in
  std::vector<bool> is_done(order_.size(), false);
  std::vector<std::uint32_t> pattern;  // the columns of row k, the last one first
  std::vector<std::uint32_t> way;
  for (const std::uint32_t k : order_) {
    seen[k] = k;
    pattern.clear();
    for (const SparseMatrix::Entry& entry : matrix.row(k)) {
      if (!is_done[entry.column]) continue;
      rest[entry.column] = entry.value;
      way.clear();
      for (std::uint32_t i = entry.column; seen[i] != k; i = columns_[i].empty() ? k : columns_[i].front().row) {
        seen[i] = k;
        way.push_back(i);
      }
      pattern.insert(pattern.end(), way.rbegin(), way.rend());
    }
    double left = matrix.diagonal[k];
    std::for_each(pattern.rbegin(), pattern.rend(), [&](std::uint32_t i) {
      const double value = rest[i] / diagonal_[i];
      rest[i] = 0.0;
      for (const Entry& entry : columns_[i]) rest[entry.row] -= entry.value * value;
      left -= value * value;
      columns_[i].push_back({k, value});
    });
    diagonal_[k] = std::sqrt(std::max(left, least_pivot * matrix.diagonal[k]));
    is_done[k] = true;
  }
}

void SparseCholesky::solve(std::span<glm::vec4> rows, std::size_t width) const {
  const auto scale = [&](std::uint32_t k) {
    const auto factor = static_cast<float>(1.0 / diagonal_[k]);
    for (std::size_t b = 0; b < width; ++b) rows[k * width + b] *= factor;
  };
  for (const std::uint32_t k : order_) {
    scale(k);
    for (const Entry& entry : columns_[k]) {
      const auto value = static_cast<float>(entry.value);
      for (std::size_t b = 0; b < width; ++b) rows[entry.row * width + b] -= value * rows[k * width + b];
    }
  }
  std::for_each(order_.rbegin(), order_.rend(), [&](std::uint32_t k) {
    for (const Entry& entry : columns_[k]) {
      const auto value = static_cast<float>(entry.value);
      for (std::size_t b = 0; b < width; ++b) rows[k * width + b] -= value * rows[entry.row * width + b];
    }
    scale(k);
  });
}

}  // namespace semblante
