#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "server/api/api.h"
#include "server/api/mapped_file.h"

namespace semblante::api {

/// Where the file vertices of a model are, as its import wrote them down: the server itself never reads a model.
class VertexPositions {
 public:
  VertexPositions(Context& context, const store::ModelRecord& model);
  /// Over an array of x, y, z (for tests). The array outlives it.
  VertexPositions(std::span<const float> xyz, double diagonal) : xyz_(xyz), diagonal_(diagonal) {}

  /// nullopt when there is no such vertex.
  [[nodiscard]] std::optional<std::array<double, 3>> of(std::uint32_t vertex) const;
  /// The vertex at a position, within 1e-4 of the box diagonal; the nearest, of several the lowest.
  [[nodiscard]] std::optional<std::uint32_t> at(const std::array<double, 3>& position) const {
    return nearest(position, 1e-4);
  }
  /// The nearest vertex within a share of the box diagonal.
  [[nodiscard]] std::optional<std::uint32_t> nearest(const std::array<double, 3>& position, double share) const;

 private:
  std::unique_ptr<MappedFile> file_;
  std::span<const float> xyz_;
  double diagonal_ = 0.0;
};

}  // namespace semblante::api
