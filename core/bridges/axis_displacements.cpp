#include "core/bridges/axis_displacements.h"

#include <algorithm>
#include <vector>

#include "core/expressions/kernel_rig.h"
#include "core/expressions/library.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

using Dense = std::array<float, feature_point_count * 3>;

std::vector<Dense> dense_of(std::span<const DisplacementSet> sets) {
  std::vector<Dense> result;
  result.reserve(sets.size());
  for (const DisplacementSet& set : sets) result.push_back(to_dense(set.displacements));
  return result;
}

/// Two entries of a library with their weights; a missing entry has no effect.
class Blend {
 public:
  Blend(const std::vector<Dense>& sets, std::size_t first, double first_weight, std::size_t second,
        double second_weight)
      : first_(first < sets.size() ? &sets[first] : nullptr),
        second_(second < sets.size() ? &sets[second] : nullptr),
        first_weight_(first_weight),
        second_weight_(second_weight) {}

  [[nodiscard]] double at(std::size_t component) const {
    return (first_ != nullptr ? first_weight_ * (*first_)[component] : 0.0) +
           (second_ != nullptr ? second_weight_ * (*second_)[component] : 0.0);
  }
  [[nodiscard]] bool moves(std::size_t point) const {
    return at(3 * point) != 0.0 || at(3 * point + 1) != 0.0 || at(3 * point + 2) != 0.0;
  }

 private:
  const Dense* first_;
  const Dense* second_;
  double first_weight_, second_weight_;
};

double share_of_63(std::uint8_t value) { return std::min<int>(value, SEMBLANTE_BLEND_MAX) / 63.0; }

}  // namespace

std::array<double, SEMBLANTE_FAP_COUNT + 1> axis_displacements(const semblante_frame& frame) {
  static const std::vector<Dense> visemes = dense_of(viseme_library());
  static const std::vector<Dense> expressions = dense_of(expression_library());
  const double blend = share_of_63(frame.viseme_blend);
  const Blend viseme(visemes, frame.viseme1, blend, frame.viseme2, 1.0 - blend);
  const Blend expression(expressions, frame.expression1, share_of_63(frame.intensity1), frame.expression2,
                         share_of_63(frame.intensity2));
  std::array<double, SEMBLANTE_FAP_COUNT + 1> result{};
  for (std::size_t n = 3; n < result.size(); ++n) {
    result[n] = frame.fap[n];
    const mpeg4::Fap& fap = mpeg4::fap(n);
    if (result[n] != 0.0 || fap.kind != mpeg4::FapKind::translation) continue;
    const std::size_t point = fap.feature_points[0];
    const std::size_t component = 3 * point + static_cast<std::size_t>(fap.axis);
    const bool both = viseme.moves(point) && expression.moves(point);
    const double share = both ? static_cast<double>(default_viseme_share) : 1.0;
    result[n] = fap.sign * (share * viseme.at(component) + (both ? 1.0 - share : 1.0) * expression.at(component));
  }
  return result;
}

}  // namespace semblante
