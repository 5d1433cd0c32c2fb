#include "core/parametrize/non_negative_kriging.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace semblante {
namespace {
/// A gradient below this is a rounding error and does not add a site. The covariance of a site with itself is 1.
constexpr double least_gain = 1e-10;
}  // namespace

NonNegativeKriging::NonNegativeKriging(std::vector<double> covariance, std::size_t site_count)
    : covariance_(std::move(covariance)),
      site_count_(site_count),
      factor_(site_count * site_count),
      inverse_(site_count) {
  assert(covariance_.size() == site_count * site_count);
}

void NonNegativeKriging::extend_factor(std::size_t row) {
  double* const own = &factor_[row * site_count_];
  const std::size_t site = sites_[passive_[row]];
  double rest = covariance(site, site);
  for (std::size_t c = 0; c < row; ++c) {
    const double* const other = &factor_[c * site_count_];
    double sum = covariance(site, sites_[passive_[c]]);
    for (std::size_t i = 0; i < c; ++i) sum -= own[i] * other[i];
    own[c] = sum * inverse_[c];
    rest -= own[c] * own[c];
  }
  inverse_[row] = 1.0 / std::sqrt(std::max(rest, least_gain));
}

void NonNegativeKriging::solve_passive(std::span<const double> to_target) {
  const std::size_t count = passive_.size();
  trial_.resize(count);
  for (std::size_t r = 0; r < count; ++r) {
    const double* const row = &factor_[r * site_count_];
    double sum = to_target[passive_[r]];
    for (std::size_t i = 0; i < r; ++i) sum -= row[i] * trial_[i];
    trial_[r] = sum * inverse_[r];
  }
  for (std::size_t r = count; r-- > 0;) {
    double sum = trial_[r];
    for (std::size_t i = r + 1; i < count; ++i) sum -= factor_[i * site_count_ + r] * trial_[i];
    trial_[r] = sum * inverse_[r];
  }
}

std::size_t NonNegativeKriging::most_gain(std::span<const double> to_target) const {
  std::size_t best = sites_.size();
  double best_gain = least_gain;
  // Several sites side by side: their sums need not wait for each other.
  constexpr std::size_t width = 4;
  for (std::size_t first = 0; first < sites_.size(); first += width) {
    std::array<std::size_t, width> site{};
    std::array<double, width> gain{};
    for (std::size_t k = 0; k < width; ++k) {
      const std::size_t s = std::min(first + k, sites_.size() - 1);
      site[k] = sites_[s];
      gain[k] = to_target[s];
    }
    for (std::size_t p = 0; p < passive_.size(); ++p) {
      const double* const row = &covariance_[sites_[passive_[p]] * site_count_];
      for (std::size_t k = 0; k < width; ++k) gain[k] -= row[site[k]] * trial_[p];
    }
    for (std::size_t k = 0; k < width && first + k < sites_.size(); ++k) {
      if (!(gain[k] > best_gain) || is_passive_[first + k] != 0) continue;
      best_gain = gain[k];
      best = first + k;
    }
  }
  return best;
}

// The active-set method of Lawson and Hanson, on the normal equations (K is well conditioned). `passive_` keeps the
// order of insertion, so that Cholesky's factor only grows; it is rebuilt from the first removed site on. It starts
// from the sites of the last solution, which for a neighbouring target are nearly always those of this one.
std::span<const double> NonNegativeKriging::solve(std::span<const std::size_t> sites,
                                                  std::span<const double> to_target) {
  assert(sites.size() == to_target.size());
  sites_ = sites;
  weights_.assign(sites.size(), 0.0);
  is_passive_.assign(sites.size(), 0);
  passive_.clear();
  bool is_factor_valid = true;  // the last solution's factor holds up to its first site that is out of reach now
  for (const std::size_t site : last_) {
    const auto at = std::find(sites.begin(), sites.end(), site);
    if (at == sites.end()) {
      is_factor_valid = false;
      continue;
    }
    passive_.push_back(static_cast<std::size_t>(at - sites.begin()));
    is_passive_[passive_.back()] = 1;
    if (!is_factor_valid) extend_factor(passive_.size() - 1);
  }
  // Every iteration lowers the objective and no passive set repeats; the limit is only for rounding errors.
  for (std::size_t turn = 0; turn < 3 * sites.size(); ++turn) {
    solve_passive(to_target);
    while (std::any_of(trial_.begin(), trial_.end(), [](double w) { return !(w > 0.0); })) {
      double step = 1.0;  // step towards the trial up to which all weights stay positive
      for (std::size_t p = 0; p < passive_.size(); ++p) {
        const double from = weights_[passive_[p]];
        if (!(trial_[p] > 0.0)) step = std::min(step, from > 0.0 ? from / (from - trial_[p]) : 0.0);
      }
      std::size_t kept = 0;
      std::size_t first_left = passive_.size();
      for (std::size_t p = 0; p < passive_.size(); ++p) {
        const std::size_t s = passive_[p];
        double& weight = weights_[s];
        const bool leaves =
            !(trial_[p] > 0.0) && (!(weight > 0.0) || weight / (weight - trial_[p]) <= step * (1.0 + 1e-12));
        weight += step * (trial_[p] - weight);
        if (leaves) {
          weight = 0.0;
          is_passive_[s] = 0;
          first_left = std::min(first_left, p);
        } else {
          passive_[kept++] = s;
        }
      }
      passive_.resize(kept);
      for (std::size_t row = first_left; row < kept; ++row) extend_factor(row);
      solve_passive(to_target);
    }
    for (std::size_t p = 0; p < passive_.size(); ++p) weights_[passive_[p]] = trial_[p];
    const std::size_t best = most_gain(to_target);
    if (best == sites.size()) break;
    passive_.push_back(best);
    is_passive_[best] = 1;
    extend_factor(passive_.size() - 1);
  }
  last_.clear();
  for (const std::size_t p : passive_) last_.push_back(sites[p]);
  return weights_;
}

}  // namespace semblante
