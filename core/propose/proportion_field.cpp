#include "core/propose/proportion_field.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace semblante {
namespace {

// Statistics of displacements between heads after alignment of pose and size.
constexpr double shift = 0.1;     ///< of the whole head
constexpr double stretch = 0.12;  ///< standard deviation of the entries of the linear part
constexpr double bump = 0.12;     ///< height of the bumps
constexpr double bump_size = 1.2;

double covariance(const glm::dvec3& p, const glm::dvec3& q) {
  return shift * shift + stretch * stretch * glm::dot(p, q) + bump * bump * std::exp(-glm::distance(p, q) / bump_size);
}

}  // namespace

ProportionField::ProportionField(std::vector<Sample> samples)
    : samples_(std::move(samples)), lower_(samples_.size() * samples_.size()), weights_(samples_.size()) {
  const std::size_t n = samples_.size();
  for (std::size_t row = 0; row < n; ++row) {
    for (std::size_t column = 0; column <= row; ++column) {
      double value = covariance(samples_[row].from, samples_[column].from);
      if (row == column) value += samples_[row].noise * samples_[row].noise;
      for (std::size_t k = 0; k < column; ++k) value -= lower_[row * n + k] * lower_[column * n + k];
      lower_[row * n + column] =
          row == column ? std::sqrt(std::max(value, 1e-12)) : value / lower_[column * n + column];
    }
  }
  std::vector<double> column(n);
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < n; ++i) column[i] = samples_[i].to[axis] - samples_[i].from[axis];
    solve_lower(column);
    for (std::size_t i = n; i-- > 0;) {
      for (std::size_t k = i + 1; k < n; ++k) column[i] -= lower_[k * n + i] * column[k];
      column[i] /= lower_[i * n + i];
      weights_[i][axis] = column[i];
    }
  }
}

void ProportionField::solve_lower(std::vector<double>& b) const {
  const std::size_t n = samples_.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= lower_[i * n + k] * b[k];
    b[i] /= lower_[i * n + i];
  }
}

ProportionField::Guess ProportionField::at(const glm::dvec3& from) const {
  std::vector<double> cross(samples_.size());
  glm::dvec3 displacement{0.0};
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    cross[i] = covariance(from, samples_[i].from);
    displacement += cross[i] * weights_[i];
  }
  solve_lower(cross);
  double variance = covariance(from, from);
  for (const double c : cross) variance -= c * c;
  return {from + displacement, std::sqrt(std::max(0.0, variance))};
}

}  // namespace semblante
