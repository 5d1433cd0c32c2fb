#include "tests/bench/weights/candidate_weights.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace semblante::bench {
namespace {

/// Solves A X = B by elimination with row pivots; A is n x n, B n x columns, both row by row. Returns X in B's place.
void solve_dense(std::vector<double> a, std::vector<double>& b, std::size_t n, std::size_t columns) {
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t r = k + 1; r < n; ++r) pivot = std::abs(a[r * n + k]) > std::abs(a[pivot * n + k]) ? r : pivot;
    if (pivot != k) {
      std::swap_ranges(&a[k * n], &a[k * n] + n, &a[pivot * n]);
      std::swap_ranges(&b[k * columns], &b[k * columns] + columns, &b[pivot * columns]);
    }
    for (std::size_t r = 0; r < n; ++r) {
      const double factor = a[r * n + k] / a[k * n + k];
      if (r == k || factor == 0.0) continue;
      for (std::size_t c = k; c < n; ++c) a[r * n + c] -= factor * a[k * n + c];
      for (std::size_t c = 0; c < columns; ++c) b[r * columns + c] -= factor * b[k * columns + c];
    }
  }
  for (std::size_t r = 0; r < n; ++r) {
    for (std::size_t c = 0; c < columns; ++c) b[r * columns + c] /= a[r * n + r];
  }
}

/// Shares of a kernel method: `basis(p)` gives the functions at a place, one a point and then the polynomial; `system`
/// is those at the points, completed.
template <class Basis>
Shares kernel_shares(const ExpressionStudy& study, const std::vector<double>& system, std::size_t size, Basis basis) {
  const std::size_t points = study.point_count();
  std::vector<double> inverse(size * size, 0.0);
  for (std::size_t i = 0; i < size; ++i) inverse[i * size + i] = 1.0;
  solve_dense(system, inverse, size, size);
  Shares shares(study.member_count() * points, 0.0);
  for (std::size_t m = 0; m < study.member_count(); ++m) {
    const std::vector<double> at = basis(study.position(m));
    for (std::size_t f = 0; f < points; ++f) {
      for (std::size_t i = 0; i < size; ++i) shares[m * points + f] += inverse[f * size + i] * at[i];
    }
  }
  return shares;
}

}  // namespace

Shares linear_rbf_shares(const ExpressionStudy& study) {
  const std::size_t points = study.point_count();
  const std::size_t size = points + 4;
  const auto basis = [&](const glm::dvec3& p) {
    std::vector<double> at;
    for (const SurfacePoint& point : study.distances.points) at.push_back(glm::distance(p, point.position));
    at.insert(at.end(), {1.0, p.x, p.y, p.z});
    return at;
  };
  std::vector<double> system(size * size, 0.0);
  for (std::size_t i = 0; i < points; ++i) {
    const std::vector<double> at = basis(study.distances.points[i].position);
    for (std::size_t j = 0; j < size; ++j) system[i * size + j] = system[j * size + i] = at[j];
  }
  return kernel_shares(study, system, size, basis);
}

Shares kriging_shares(const ExpressionStudy& study, double length) {
  const std::size_t points = study.point_count();
  const auto basis = [&](const glm::dvec3& p) {
    std::vector<double> at;
    for (const SurfacePoint& point : study.distances.points) {
      at.push_back(std::exp(-glm::distance(p, point.position) / (length * study.eye_separation)));
    }
    return at;
  };
  std::vector<double> system;
  for (const SurfacePoint& point : study.distances.points) {
    const std::vector<double> at = basis(point.position);
    system.insert(system.end(), at.begin(), at.end());
  }
  return kernel_shares(study, system, points, basis);
}

Shares harmonic_shares(const ExpressionStudy& study) {
  const std::size_t members = study.member_count();
  const std::size_t points = study.point_count();
  struct Neighbor {
    std::uint32_t to;
    double weight;
  };
  std::vector<std::vector<Neighbor>> neighbors(members);
  std::vector<double> diagonal(members, 0.0);
  for (const auto& [a, b, weight] : cotangent_edges(study)) {
    neighbors[a].push_back({b, weight});
    neighbors[b].push_back({a, weight});
    diagonal[a] += weight;
    diagonal[b] += weight;
  }
  std::vector<bool> fixed(members, false);
  for (const std::uint32_t m : study.member_of_point) fixed[m] = true;
  Shares shares(members * points, 0.0);
  // Conjugate gradients with the diagonal as preconditioner, one point after the other.
  std::vector<double> x(members), r(members), d(members), q(members);
  const auto laplacian = [&](const std::vector<double>& in, std::size_t m) {
    double sum = diagonal[m] * in[m];
    for (const Neighbor& n : neighbors[m]) sum -= n.weight * in[n.to];
    return sum;
  };
  for (std::size_t f = 0; f < points; ++f) {
    std::fill(x.begin(), x.end(), 0.0);
    x[study.member_of_point[f]] = 1.0;
    double rho = 0.0;
    for (std::size_t m = 0; m < members; ++m) {
      r[m] = fixed[m] ? 0.0 : -laplacian(x, m);
      d[m] = fixed[m] ? 0.0 : r[m] / diagonal[m];
      rho += r[m] * d[m];
    }
    const double enough = rho * 1e-16;
    for (int turn = 0; turn < 2000 && rho > enough; ++turn) {
      double curvature = 0.0;
      for (std::size_t m = 0; m < members; ++m) {
        q[m] = fixed[m] ? 0.0 : laplacian(d, m);
        curvature += d[m] * q[m];
      }
      const double step = rho / curvature;
      double next = 0.0;
      for (std::size_t m = 0; m < members; ++m) {
        x[m] += step * d[m];
        r[m] -= step * q[m];
        next += fixed[m] ? 0.0 : r[m] * r[m] / diagonal[m];
      }
      for (std::size_t m = 0; m < members; ++m) d[m] = fixed[m] ? 0.0 : r[m] / diagonal[m] + next / rho * d[m];
      rho = next;
    }
    for (std::size_t m = 0; m < members; ++m) shares[m * points + f] = x[m];
  }
  return shares;
}

}  // namespace semblante::bench
