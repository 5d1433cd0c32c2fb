#pragma once

#include <deque>

#include <Eigen/Core>

namespace semblante::bench {

/// L-BFGS with a backtracking line search. `value_and_slope(x, slope)` returns the value and writes the gradient.
template <class Function>
Eigen::VectorXd minimize(Function value_and_slope, Eigen::VectorXd x, int iterations) {
  constexpr std::size_t memory = 10;
  struct Step {
    Eigen::VectorXd moved, slope_change;
    double curvature;
  };
  std::deque<Step> steps;
  Eigen::VectorXd slope(x.size());
  double value = value_and_slope(x, slope);
  for (int turn = 0; turn < iterations; ++turn) {
    Eigen::VectorXd direction = -slope;
    std::vector<double> along;
    for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
      along.push_back(step->moved.dot(direction) / step->curvature);
      direction -= along.back() * step->slope_change;
    }
    if (!steps.empty()) direction *= steps.back().curvature / steps.back().slope_change.squaredNorm();
    for (Step& step : steps) {
      const double back = step.slope_change.dot(direction) / step.curvature;
      direction += (along.back() - back) * step.moved;
      along.pop_back();
    }
    const double descent = slope.dot(direction);
    if (!(descent < 0.0)) break;
    double length = steps.empty() ? 1.0 / slope.norm() : 1.0;
    Eigen::VectorXd next(x.size());
    Eigen::VectorXd next_slope(x.size());
    double next_value = value;
    for (int tries = 0; tries < 30; ++tries, length /= 2.0) {
      next = x + length * direction;
      next_value = value_and_slope(next, next_slope);
      if (next_value <= value + 1e-4 * length * descent) break;
    }
    if (!(next_value < value)) break;
    Step step{next - x, next_slope - slope, 0.0};
    step.curvature = step.moved.dot(step.slope_change);
    if (step.curvature > 1e-12 * step.slope_change.squaredNorm()) {
      steps.push_back(std::move(step));
      if (steps.size() > memory) steps.pop_front();
    }
    x = next;
    slope = next_slope;
    value = next_value;
  }
  return x;
}

}  // namespace semblante::bench
