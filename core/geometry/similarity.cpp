#include "core/geometry/similarity.h"

#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

namespace semblante {
namespace {

glm::dvec3 mean(std::span<const glm::dvec3> points) {
  glm::dvec3 sum{0.0};
  for (const glm::dvec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// The Frobenius norm, an upper bound of the absolute eigenvalues.
double frobenius(const glm::dmat4& m) {
  double sum = 0.0;
  for (int c = 0; c < 4; ++c) sum += glm::dot(m[c], m[c]);
  return std::sqrt(sum);
}

/// Second largest of the three spreads of `points` about `center`, relative to the largest, by the invariants of their
/// scatter matrix: 0 for points on a line.
double width(std::span<const glm::dvec3> points, const glm::dvec3& center) {
  glm::dmat3 s{0.0};
  for (const glm::dvec3& p : points) s += glm::outerProduct(p - center, p - center);
  const double trace = s[0][0] + s[1][1] + s[2][2];
  if (!(trace > 0.0)) return 0.0;
  const double minors = s[0][0] * s[1][1] - s[0][1] * s[1][0] + s[0][0] * s[2][2] - s[0][2] * s[2][0] +
                        s[1][1] * s[2][2] - s[1][2] * s[2][1];
  return std::sqrt(std::max(0.0, minors)) / trace;
}

}  // namespace

glm::dvec4 principal_axis(const glm::dmat4& symmetric) {
  const double shift = frobenius(symmetric);
  if (!(shift > 0.0)) return {1.0, 0.0, 0.0, 0.0};
  // With the shift all eigenvalues are positive; repeated squaring leaves the largest.
  glm::dmat4 power = symmetric + glm::dmat4(shift);
  constexpr int squarings = 40;
  for (int i = 0; i < squarings; ++i) {
    power = power * power;
    power = power / frobenius(power);
  }
  int longest = 0;
  for (int c = 1; c < 4; ++c) {
    if (glm::dot(power[c], power[c]) > glm::dot(power[longest], power[longest])) longest = c;
  }
  return glm::normalize(power[longest]);
}

std::optional<Similarity> fit_similarity(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to) {
  assert(from.size() == to.size());
  constexpr double on_a_line = 0.02;
  if (from.size() < 3) return std::nullopt;
  Similarity fit;
  fit.from = mean(from);
  fit.to = mean(to);
  if (width(from, fit.from) < on_a_line || width(to, fit.to) < on_a_line) return std::nullopt;

  glm::dmat3 s{0.0};  // s[c][r] = sum a_r b_c
  double from_spread = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const glm::dvec3 a = from[i] - fit.from;
    s += glm::outerProduct(a, to[i] - fit.to);
    from_spread += glm::dot(a, a);
  }
  const auto at = [&s](int row, int column) { return s[column][row]; };
  const glm::dmat4 n(at(0, 0) + at(1, 1) + at(2, 2), at(1, 2) - at(2, 1), at(2, 0) - at(0, 2), at(0, 1) - at(1, 0),  //
                     at(1, 2) - at(2, 1), at(0, 0) - at(1, 1) - at(2, 2), at(0, 1) + at(1, 0), at(2, 0) + at(0, 2),  //
                     at(2, 0) - at(0, 2), at(0, 1) + at(1, 0), at(1, 1) - at(0, 0) - at(2, 2), at(1, 2) + at(2, 1),  //
                     at(0, 1) - at(1, 0), at(2, 0) + at(0, 2), at(1, 2) + at(2, 1), at(2, 2) - at(0, 0) - at(1, 1));
  const glm::dvec4 q = principal_axis(n);
  fit.rotation = glm::mat3_cast(glm::dquat(q[0], q[1], q[2], q[3]));

  double along = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    along += glm::dot(to[i] - fit.to, fit.rotation * (from[i] - fit.from));
  }
  fit.scale = along / from_spread;
  if (!(fit.scale > 0.0) || !std::isfinite(fit.scale)) return std::nullopt;
  return fit;
}

}  // namespace semblante
