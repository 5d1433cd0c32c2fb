#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace semblante {

/// How well weights predict one shape of a head that they were not fitted to. Sums over vertices of the skin of squared
/// lengths, in model units.
struct ShapeError {
  std::string name;
  double moved = 0.0;         ///< of the true displacements
  double wrong = 0.0;         ///< of the errors of weights fitted to the other shapes
  double smooth_wrong = 0.0;  ///< of the errors of the smooth weights
};

/// The shapes that weights were fitted to, each predicted by a fit without it.
struct WeightFit {
  std::vector<ShapeError> shapes;
  std::vector<std::string> ignored;  ///< names of the shapes that could not be used

  /// Mean over the shapes of wrong / moved: 0 is perfect, 1 a face that does not move.
  [[nodiscard]] double error() const { return mean(&ShapeError::wrong); }
  [[nodiscard]] double smooth_error() const { return mean(&ShapeError::smooth_wrong); }

 private:
  [[nodiscard]] double mean(double ShapeError::*wrong) const {
    double sum = 0.0;
    std::size_t count = 0;
    for (const ShapeError& shape : shapes) {
      if (!(shape.moved > 0.0)) continue;
      sum += shape.*wrong / shape.moved;
      ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
  }
};

}  // namespace semblante
