#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
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

/// An order of the rows that keeps Cholesky's factor sparse, by nested dissection: the vertices are halved along their
/// longest extent, and those between the halves come after both. `positions`: of the vertices.
std::vector<std::uint32_t> dissection_order(const SparseMatrix& matrix, std::span<const glm::dvec3> positions);

/// Cholesky's factor of a positive definite matrix: exact solutions, after one factorization for all right-hand sides.
/// The factor is in double precision, since entries of very short edges are a million times the others.
class SparseCholesky {
 public:
  /// `order`: of the elimination, a permutation of the rows.
  SparseCholesky(const SparseMatrix& matrix, std::vector<std::uint32_t> order);

  /// Solves for many right-hand sides at once: `rows` has `width` blocks of four for each row of the matrix, and gets
  /// the solution.
  void solve(std::span<glm::vec4> rows, std::size_t width) const;

 private:
  struct Entry {
    std::uint32_t row;
    double value;
  };
  std::vector<std::uint32_t> order_;
  std::vector<double> diagonal_;             ///< of the factor, by row
  std::vector<std::vector<Entry>> columns_;  ///< below the diagonal, rows in the order of elimination
};

}  // namespace semblante
