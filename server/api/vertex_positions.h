#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "server/api/api.h"
#include "server/api/mapped_file.h"

namespace semblante::api {

/// Positions of the file vertices of a model, as stored by its import: the server process never parses a model.
class VertexPositions {
 public:
  VertexPositions(Context& context, const store::ModelRecord& model);
  /// Over an array of x, y, z (for tests), which must outlive this object.
  VertexPositions(std::span<const float> xyz, double diagonal) : xyz_(xyz), diagonal_(diagonal) {}

  /// nullopt when the vertex does not exist.
  [[nodiscard]] std::optional<std::array<double, 3>> of(std::uint32_t vertex) const;
  /// The vertex at a position, within 1e-4 of the box diagonal; the nearest one, and among equals the lowest index.
  [[nodiscard]] std::optional<std::uint32_t> at(const std::array<double, 3>& position) const {
    return nearest(position, at_place);
  }
  /// The same, but nullopt if several vertices are there: touching lips and lids have a vertex of each at one place.
  [[nodiscard]] std::optional<std::uint32_t> only_one_at(const std::array<double, 3>& position) const;
  /// The nearest vertex within a fraction of the box diagonal.
  [[nodiscard]] std::optional<std::uint32_t> nearest(const std::array<double, 3>& position, double share) const;

 private:
  static constexpr double at_place = 1e-4;  ///< of the box diagonal, as for positions in place_feature_points

  /// Squared distance to the vertex whose x is at `first`.
  [[nodiscard]] double square_of_way(std::size_t first, const std::array<double, 3>& position) const;

  std::unique_ptr<MappedFile> file_;
  std::span<const float> xyz_;
  double diagonal_ = 0.0;
};

}  // namespace semblante::api
