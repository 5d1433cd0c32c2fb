#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/parametrize/weight_row.h"

namespace semblante {

/// What faces with known shapes teach about the weights of others.
///
/// The smooth weights of a vertex say where it lies between the points, whatever the size, the proportions and the mesh
/// of the head. The prior is a table over these coordinates: where points i and j share a vertex, the weight of point k
/// is off by c_ijk, so
///
///     d_k = sum over pairs of g_i g_j c_ijk
///     w_k = g_k + d_k                 where d_k is positive
///     w_k = g_k^2 / (g_k - d_k)       where it is negative: the same slope at zero, and never below zero
///
/// scaled to a sum of one if it is more. The share of the root, 1 - sum g, is one more i or j, times sum g, so that a
/// correction ends more gently than the weights do. So the correction is as smooth as the weights themselves,
/// is zero at the points, and fades out where a head has no such points. Pairs on the edge of one lip or lid have none:
/// the edges stay as opening_margins.h makes them.
class WeightPrior {
 public:
  /// c_ijk of one table row and of its mirror image.
  struct Entry {
    std::uint8_t i, j;  ///< ids of feature points, or `root`
    std::uint8_t k;     ///< id of a feature point
    std::int16_t hundredths;
  };
  static constexpr std::size_t root = feature_point_count;

  /// No corrections.
  WeightPrior() = default;
  explicit WeightPrior(std::span<const Entry> entries);

  /// The surface vertex of each point of a part; `nowhere` for points it does not have.
  using Places = std::array<std::uint32_t, feature_point_count>;
  static constexpr std::uint32_t nowhere = 0xFFFFFFFFU;

  /// Corrects a row of weights with a sum of at most one. Only points with a place get weight. Pairs of points at one
  /// place have no correction: their vertex follows both equally.
  void correct(WeightRow& row, const Places& places) const;

  /// Whether the table may correct this pair; false for pairs on the edge of one lip or lid.
  static bool allows(std::size_t i, std::size_t j);
  /// The point on the other side, or the same; root for root.
  static std::size_t mirrored(std::size_t id);

 private:
  struct Correction {
    std::uint8_t point;
    double factor;
  };
  [[nodiscard]] static std::size_t cell(std::size_t i, std::size_t j) { return i * (feature_point_count + 1) + j; }

  std::vector<std::uint32_t> offsets_;  ///< by cell (i < j), one more; empty: no corrections
  std::vector<Correction> corrections_;
};

/// The table of weight_prior_table.inc, trained by tests/bench/prior on the heads its README names.
const WeightPrior& trained_weight_prior();

}  // namespace semblante
