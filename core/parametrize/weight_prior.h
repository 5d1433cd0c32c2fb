#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/parametrize/slot_set.h"
#include "core/parametrize/weight_row.h"

namespace semblante {

/// What faces with known shapes teach about the weights of others.
///
/// The smooth weights of a vertex say where it lies between the points, whatever the size, the proportions and the mesh
/// of the head. The prior is a table over these coordinates: where points i and j share a vertex, the weight of point k
/// is off by c_ijk, so
///
///     d_k = sum over pairs of g_i g_j c_ijk + e sum over points and offset terms of g_i x_ia c_iak
///     w_k = g_k + d_k                 where d_k is positive
///     w_k = g_k^2 / (g_k - d_k)       where it is negative: the same slope at zero, and never below zero
///
/// scaled to a sum of one if it is more. The share of the root, 1 - sum g, is one more i or j, times sum g, so that a
/// correction ends more gently than the weights do. x_ia is the offset of the vertex from point i along an axis of the
/// head, or the product of two such offsets: skin on one side of a point moves otherwise than on the other, as at the
/// hair line, and skin in one direction, as behind the chin in the middle of the throat. e is the share of the points
/// that lie on no edge of a lip or lid, and such points alone have offset terms, those of eyes and brows without
/// products. So the correction is as smooth as the
/// weights themselves, is zero at the points, and fades out where a head has no such points. Pairs on the edge of one
/// lip or lid have none: the edges stay as opening_margins.h makes them.
class WeightPrior {
 public:
  /// c_ijk of one table row and of its mirror image.
  struct Entry {
    std::uint8_t i, j;  ///< ids of feature points; j may be `root` or an offset term
    std::uint8_t k;     ///< id of a feature point
    std::int16_t hundredths;
  };
  static constexpr std::size_t root = feature_point_count;
  static constexpr std::size_t first_axis = root + 1;           ///< of the offset along x; those along y and z follow
  static constexpr std::size_t first_product = first_axis + 3;  ///< of its square; yy, zz, xy, xz, yz follow
  static constexpr std::size_t column_count = first_product + 6;
  /// Offsets from a point are multiples of this, in ES0.
  static constexpr double offset_unit = 1.0 / 3.0;

  /// No corrections.
  WeightPrior() = default;
  explicit WeightPrior(std::span<const Entry> entries);

  /// Where a point of a part is.
  struct Place {
    std::uint32_t vertex = nowhere;  ///< of the surface; `nowhere` for points that the part does not have
    glm::dvec3 position{0.0};        ///< in ES0
  };
  using Places = std::array<Place, feature_point_count>;
  static constexpr std::uint32_t nowhere = 0xFFFFFFFFU;

  /// Corrects the row of weights, with a sum of at most one, of a vertex at `position`, in ES0. Only points with a
  /// place get weight. Pairs of points at one place have no correction: their vertex follows both equally.
  void correct(WeightRow& row, const glm::dvec3& position, const Places& places) const;

  /// Whether the table may correct this pair; false for pairs on the edge of one lip or lid, for offset terms of its
  /// points, and for products of offsets from points of eyes and brows.
  static bool allows(std::size_t i, std::size_t j);
  /// The point on the other side, or the same; root and offset terms are their own images.
  static std::size_t mirrored(std::size_t id);
  /// -1 for the offset terms that are negative on the other side, x, xy and xz, 1 for all else.
  static double sign_of_image(std::size_t j);
  using OffsetTerms = std::array<double, column_count - first_axis>;
  /// x_ia of every a, from the offset of a vertex from point i, in ES0.
  static OffsetTerms offset_terms(const glm::dvec3& offset);
  /// The share of the points that lie on no edge of a lip or lid; `row` has a sum of at most one.
  static double share_off_edges(const WeightRow& row);

 private:
  struct Correction {
    std::uint8_t column;  ///< of its cell: the greater id of its pair
    std::uint8_t point;
    double factor;
  };
  [[nodiscard]] static std::size_t cell(std::size_t i, std::size_t j) { return i * column_count + j; }
  /// The corrections of the cells in the range [first, last).
  [[nodiscard]] std::span<const Correction> between(std::size_t first, std::size_t last) const {
    return std::span(corrections_).subspan(offsets_[first], offsets_[last] - offsets_[first]);
  }

  std::vector<std::uint32_t> offsets_;  ///< by cell (i < j), one more; empty: no corrections
  std::vector<Correction> corrections_;
  std::array<SlotSet, feature_point_count> corrected_;  ///< by i: the points of the corrections of all its cells
};

/// The table of weight_prior_table.inc, trained by tests/bench/prior on the heads its README names.
const WeightPrior& trained_weight_prior();

}  // namespace semblante
