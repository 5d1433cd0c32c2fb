#include "tests/bench/weights/smooth_shares.h"

#include "core/parametrize/smooth_weights.h"

namespace semblante::bench {

Shares shares_of_table(const ExpressionStudy& study, const WeightTable<double>& table) {
  Shares shares(study.member_count() * study.point_count(), 0.0);
  for (std::size_t m = 0; m < study.member_count(); ++m) {
    for (std::size_t k = 0; k < table.points_of(m).size(); ++k) {
      for (std::size_t f = 0; f < study.point_count(); ++f) {
        if (study.distances.points[f].id == table.points_of(m)[k]) {
          shares[m * study.point_count() + f] = table.weights_of(m)[k];
        }
      }
    }
  }
  return shares;
}

Shares smooth_shares(const ExpressionStudy& study, const WeightPrior& prior) {
  return shares_of_table(study, smooth_part_weights(study.surface, study.distances, study.eye_separation,
                                                    margin_sites(study.surface, study.distances.points), prior));
}

}  // namespace semblante::bench
