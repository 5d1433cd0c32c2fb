#include "core/geometry/sparse_cholesky.h"

#include <algorithm>
#include <cassert>

#include <Eigen/SparseCholesky>

namespace semblante {
namespace {

/// The lower triangle and the diagonal.
Eigen::SparseMatrix<double> lower_triangle(const SparseMatrix& matrix) {
  const auto count = static_cast<int>(matrix.diagonal.size());
  Eigen::SparseMatrix<double> lower(count, count);
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(matrix.diagonal.size() + matrix.entries.size() / 2);
  for (int r = 0; r < count; ++r) {
    entries.emplace_back(r, r, matrix.diagonal[static_cast<std::size_t>(r)]);
    for (const SparseMatrix::Entry& e : matrix.row(static_cast<std::size_t>(r))) {
      if (static_cast<int>(e.column) < r) entries.emplace_back(r, static_cast<int>(e.column), e.value);
    }
  }
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

}  // namespace

// Rows are eliminated by least degree (AMD), which for the inside of a mouth takes half of the operations of nested
// dissection by positions. The two triangular solves are not Eigen's: Eigen reads the factor once for each column of
// the right-hand sides, these loops read it once for all of them.
void solve_by_cholesky(const SparseMatrix& matrix, std::span<glm::vec4> rows, std::size_t width) {
  if (matrix.diagonal.empty()) return;
  using Factor = Eigen::SparseMatrix<double>;
  const Factor lower = lower_triangle(matrix);
  Eigen::SimplicialLLT<Factor, Eigen::Lower, Eigen::AMDOrdering<int>> cholesky(lower);
  // Rounding may make a pivot zero or negative, where edges of one mesh differ by many orders of magnitude.
  const double greatest = *std::max_element(matrix.diagonal.begin(), matrix.diagonal.end());
  for (double shift = 1e-14; cholesky.info() != Eigen::Success && shift < 1.0; shift *= 100.0) {
    cholesky.setShift(shift * greatest);
    cholesky.factorize(lower);
  }
  assert(cholesky.info() == Eigen::Success);
  const Factor& factor = cholesky.matrixL().nestedExpression();
  const auto& order = cholesky.permutationPinv().indices();  // of the factor's columns
  const auto row_of = [&](Eigen::Index column) { return &rows[static_cast<std::size_t>(order[column]) * width]; };
  const auto scale = [&](glm::vec4* row, double pivot) {
    const auto share = static_cast<float>(1.0 / pivot);
    for (std::size_t b = 0; b < width; ++b) row[b] *= share;
  };
  const auto subtract = [&](glm::vec4* from, const glm::vec4* row, double value) {
    for (std::size_t b = 0; b < width; ++b) from[b] -= static_cast<float>(value) * row[b];
  };
  // The first entry of a column is its pivot.
  for (Eigen::Index k = 0; k < factor.cols(); ++k) {
    Factor::InnerIterator entry(factor, k);
    glm::vec4* const own = row_of(k);
    scale(own, entry.value());
    while (++entry) subtract(row_of(entry.row()), own, entry.value());
  }
  for (Eigen::Index k = factor.cols(); k-- > 0;) {
    Factor::InnerIterator entry(factor, k);
    const double pivot = entry.value();
    glm::vec4* const own = row_of(k);
    while (++entry) subtract(own, row_of(entry.row()), entry.value());
    scale(own, pivot);
  }
}

}  // namespace semblante
