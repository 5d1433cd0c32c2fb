#include "core/extract/same_mesh.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace semblante {
namespace {

/// Each edge once, the lower vertex in the upper half of the number.
std::vector<std::uint64_t> edges_of(std::span<const Triangle> triangles) {
  std::vector<std::uint64_t> edges;
  edges.reserve(triangles.size() * 3);
  for (const Triangle& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
      edges.push_back(std::uint64_t{low} << 32U | high);
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace

Status check_same_mesh(std::span<const Triangle> neutral, std::span<const Triangle> expression) {
  if (expression.empty()) return Unit{};
  const auto ours = edges_of(neutral);
  const auto theirs = edges_of(expression);
  std::size_t shared = 0;
  for (const std::uint64_t edge : theirs) shared += std::binary_search(ours.begin(), ours.end(), edge) ? 1 : 0;
  if (2 * shared >= theirs.size()) return Unit{};
  return Error{ErrorCode::mismatch, "/expression",
               "only " + std::to_string(shared) + " of the " + std::to_string(theirs.size()) +
                   " edges of the expression are edges of the neutral head: its vertices have another order"};
}

}  // namespace semblante
