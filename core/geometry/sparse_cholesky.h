#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

namespace semblante {

/// A sparse symmetric matrix: a row for each vertex, an entry beside the diagonal for each of its neighbours.
struct SparseMatrix {
  struct Entry {
    std::uint32_t column;
    double value;
  };
  std::vector<double> diagonal;
  std::vector<std::uint32_t> offsets{0};  ///< by row: where its entries begin; at the end, their number
  std::vector<Entry> entries;             ///< both of each pair of neighbours, none of the diagonal

  [[nodiscard]] std::span<const Entry> row(std::size_t at) const {
    return std::span(entries).subspan(offsets[at], offsets[at + 1] - offsets[at]);
  }
};

/// Solves the equations of a positive definite matrix exactly, for many right-hand sides at once: `rows` has `width`
/// blocks of four for each row of the matrix, and gets the solution. Cholesky's factor is in double precision, since
/// entries of very short edges are a million times the others.
void solve_by_cholesky(const SparseMatrix& matrix, std::span<glm::vec4> rows, std::size_t width);

}  // namespace semblante
