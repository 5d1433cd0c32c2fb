#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace semblante {

/// Solves min 1/2 w'Kw - k'w, w >= 0, repeatedly for rows and columns selected from one K: kriging with non-negative
/// weights. K is positive definite, so the solution is unique, and continuous in k: sites enter and leave it with
/// weight zero. Far sites behind nearer ones get weight zero, so that few weights are positive.
class NonNegativeKriging {
 public:
  /// `covariance`: #F x #F, row by row, symmetric, positive definite.
  NonNegativeKriging(std::vector<double> covariance, std::size_t site_count);

  /// `sites`: rows and columns of K to use; `to_target`: k, as many. Returns w, as many; valid until the next call.
  std::span<const double> solve(std::span<const std::size_t> sites, std::span<const double> to_target);

 private:
  /// Appends a row to Cholesky's factor of K over the passive sites.
  void extend_factor(std::size_t row);
  void solve_passive(std::span<const double> to_target);
  /// The place of the site that is not passive whose weight would lower the objective most; the number of sites if
  /// none would.
  [[nodiscard]] std::size_t most_gain(std::span<const double> to_target) const;
  [[nodiscard]] double covariance(std::size_t a, std::size_t b) const { return covariance_[a * site_count_ + b]; }

  std::vector<double> covariance_;
  std::size_t site_count_;
  std::vector<double> weights_;       ///< of all sites of the call
  std::vector<std::size_t> passive_;  ///< places in `sites` whose weight may be positive
  std::vector<std::uint8_t> is_passive_;
  std::vector<std::size_t> last_;  ///< passive sites of the last solution
  std::vector<double> trial_;      ///< unconstrained weights of passive_
  std::vector<double> factor_;     ///< below the diagonal, row by row, #F wide
  std::vector<double> inverse_;    ///< of its diagonal
  std::span<const std::size_t> sites_;
};

}  // namespace semblante
