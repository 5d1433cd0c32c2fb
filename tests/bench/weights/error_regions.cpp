#include "tests/bench/weights/error_regions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

namespace semblante::bench {
namespace {

enum Region : std::size_t { lips, chin, lids, brows, cheeks, nose, rest, mouth, sockets };

Region region_of_point(FeaturePointId id) {
  const std::string name = to_string(id);
  const auto is_one_of = [&](std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (is_one_of({"2.1", "2.10", "2.11", "2.12", "2.13", "2.14"})) return chin;
  switch (name.front()) {
    case '2':
    case '8':
      return lips;
    case '3':
      return lids;
    case '4':
      return brows;
    case '5':
      return cheeks;
    case '9':
      return nose;
    default:
      return rest;
  }
}

std::vector<Region> regions_of(const ExpressionStudy& study) {
  std::vector<Region> regions;
  for (std::size_t m = 0; m < study.member_count(); ++m) {
    double nearest = std::numeric_limits<double>::infinity();
    Region region = rest;
    for (std::size_t f = 0; f < study.point_count(); ++f) {
      const double distance = glm::distance(study.position(m), study.position(study.member_of_point[f]));
      if (distance >= nearest) continue;
      nearest = distance;
      region = region_of_point(study.distances.points[f].id);
    }
    if (study.hidden[m]) region = region == lids || region == brows ? sockets : mouth;
    // Farther than half the distance of the eyes from every point: neck and scalp.
    if (!study.hidden[m] && nearest > 0.5 * study.eye_separation) region = rest;
    regions.push_back(region);
  }
  return regions;
}

/// sum of squares of `amount(expression, vertex)` by region over that of the displacements, mean of the expressions.
template <class Amount>
ByRegion squares_by_region(const ExpressionStudy& study, Amount amount) {
  const std::vector<Region> regions = regions_of(study);
  ByRegion result{};
  for (const Expression& expression : study.expressions) {
    ByRegion squares{};
    double all = 0.0;
    for (std::size_t m = 0; m < regions.size(); ++m) {
      const glm::dvec3 value = amount(expression, m);
      squares[regions[m]] += glm::dot(value, value);
      all += glm::dot(expression.displacement[m], expression.displacement[m]);
    }
    for (std::size_t r = 0; r < result.size(); ++r)
      result[r] += squares[r] / all / static_cast<double>(study.expressions.size());
  }
  return result;
}

/// The least squares problem of one vertex over some points: w'Gw / 2 - h'w.
struct LeastSquares {
  std::vector<double> gram;  ///< n x n
  std::vector<double> right;

  /// Non-negative least squares with `price` subtracted from the right side, by coordinate descent from `weights`.
  void solve(double price, std::vector<double>& weights) const {
    const std::size_t n = right.size();
    for (int sweep = 0; sweep < 300; ++sweep) {
      double change = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        const double diagonal = gram[i * n + i];
        if (!(diagonal > 0.0)) continue;
        const double slope =
            std::inner_product(weights.begin(), weights.end(), gram.begin() + static_cast<std::ptrdiff_t>(i * n), 0.0);
        const double next = std::max(0.0, weights[i] + (right[i] - price - slope) / diagonal);
        change = std::max(change, std::abs(next - weights[i]));
        weights[i] = next;
      }
      if (change < 1e-5) return;
    }
  }

  /// The same with a sum of at most one: the price of weight that makes it so, by halving.
  [[nodiscard]] std::vector<double> solve() const {
    std::vector<double> weights(right.size(), 0.0);
    const auto sum = [&] { return std::accumulate(weights.begin(), weights.end(), 0.0); };
    solve(0.0, weights);
    if (sum() <= 1.0) return weights;
    double low = 0.0;
    double high = *std::max_element(right.begin(), right.end());
    for (int step = 0; step < 24; ++step) {
      const double middle = (low + high) / 2.0;
      solve(middle, weights);
      (sum() > 1.0 ? low : high) = middle;
    }
    solve(high, weights);
    return weights;
  }
};

}  // namespace

ByRegion error_by_region(const ExpressionStudy& study, const Shares& shares) {
  const std::size_t points = study.point_count();
  return squares_by_region(study, [&](const Expression& expression, std::size_t m) {
    glm::dvec3 wrong = -expression.displacement[m];
    for (std::size_t f = 0; f < points; ++f)
      wrong += shares[m * points + f] * expression.displacement[study.member_of_point[f]];
    return wrong;
  });
}

ByRegion motion_by_region(const ExpressionStudy& study) {
  return squares_by_region(study,
                           [](const Expression& expression, std::size_t m) { return expression.displacement[m]; });
}

Shares best_shares(const ExpressionStudy& study, std::size_t most) {
  const std::size_t points = study.point_count();
  // Each expression counts by its size, as in Figures::error.
  std::vector<double> importance;
  for (const Expression& expression : study.expressions) {
    double all = 0.0;
    for (const glm::dvec3& d : expression.displacement) all += glm::dot(d, d);
    importance.push_back(1.0 / all);
  }
  const auto moved = [&](std::size_t expression, std::size_t f) {
    return study.expressions[expression].displacement[study.member_of_point[f]];
  };
  std::vector<double> gram(points * points, 0.0);
  for (std::size_t e = 0; e < importance.size(); ++e) {
    for (std::size_t a = 0; a < points; ++a) {
      for (std::size_t b = 0; b < points; ++b)
        gram[a * points + b] += importance[e] * glm::dot(moved(e, a), moved(e, b));
    }
  }
  LeastSquares all{gram, {}};
  Shares shares(study.member_count() * points, 0.0);
  for (std::size_t m = 0; m < study.member_count(); ++m) {
    std::vector<double> right(points, 0.0);
    for (std::size_t e = 0; e < importance.size(); ++e) {
      for (std::size_t f = 0; f < points; ++f)
        right[f] += importance[e] * glm::dot(moved(e, f), study.expressions[e].displacement[m]);
    }
    all.right = right;
    std::vector<double> free(points, 0.0);
    all.solve(0.0, free);
    std::vector<std::size_t> kept(points);
    std::iota(kept.begin(), kept.end(), std::size_t{0});
    std::stable_sort(kept.begin(), kept.end(), [&](std::size_t a, std::size_t b) { return free[a] > free[b]; });
    kept.resize(std::min(most, points));
    LeastSquares few;
    for (const std::size_t a : kept) {
      few.right.push_back(right[a]);
      for (const std::size_t b : kept) few.gram.push_back(gram[a * points + b]);
    }
    const std::vector<double> weights = few.solve();
    for (std::size_t i = 0; i < kept.size(); ++i) shares[m * points + kept[i]] = weights[i];
  }
  return shares;
}

}  // namespace semblante::bench
