#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace semblante {

/// Transfers positions of one head to another with some known points: the displacement between the heads is modelled as
/// a smooth random field (a global stretch plus local deviations that fade with distance), and estimated from the known
/// displacements by kriging. All lengths in ES0.
class ProportionField {
 public:
  struct Sample {
    glm::dvec3 from, to;
    double noise;  ///< standard deviation of `to`
  };
  struct Guess {
    glm::dvec3 place;
    double deviation;  ///< standard deviation of each coordinate by the model of the field
  };

  explicit ProportionField(std::vector<Sample> samples);

  [[nodiscard]] Guess at(const glm::dvec3& from) const;

 private:
  /// Solves L y = b in place.
  void solve_lower(std::vector<double>& b) const;

  std::vector<Sample> samples_;
  std::vector<double> lower_;        ///< #samples by #samples, row by row: Cholesky factor of the covariance
  std::vector<glm::dvec3> weights_;  ///< #samples: covariance^-1 * displacements
};

}  // namespace semblante
