#include "protocol/cpp/quantizers.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/tables/mpeg4.h"
#include "core/types/decimal.h"

namespace semblante {

static_assert(last_low_level_fap == mpeg4::fap_count);
static_assert(low_level_fap_count == last_low_level_fap - first_low_level_fap + 1);

const QuantizerSteps& standard_quantizers() {
  static const QuantizerSteps steps = [] {
    QuantizerSteps result{};
    result.fill(1.0);
    for (const auto& fap : mpeg4::faps) result[fap.number] = fap.quantizer_step;
    return result;
  }();
  return steps;
}

bool is_quantizer_scale(double scale) {
  return std::find(quantizer_scales.begin(), quantizer_scales.end(), scale) != quantizer_scales.end();
}

QuantizerSteps scaled_quantizers(double scale) {
  assert(is_quantizer_scale(scale));
  QuantizerSteps result = standard_quantizers();
  for (std::size_t fap = first_low_level_fap; fap <= last_low_level_fap; ++fap) result[fap] *= scale;
  return result;
}

std::vector<double> header_quantizers(double scale) {
  if (scale == 1.0) return {};
  const QuantizerSteps steps = scaled_quantizers(scale);
  return {steps.begin() + first_low_level_fap, steps.end()};
}

FaceFrame requantized(const FaceFrame& frame, const QuantizerSteps& from, const QuantizerSteps& to) {
  constexpr double most = max_level;
  FaceFrame result = frame;
  for (std::size_t fap = first_low_level_fap; fap <= last_low_level_fap; ++fap) {
    if (from[fap] == to[fap]) continue;
    result.level[fap] =
        static_cast<std::int16_t>(std::clamp(std::round(frame.level[fap] * from[fap] / to[fap]), -most, most));
  }
  return result;
}

QuantizerSteps quantizers_of(const Header& header) {
  if (header.quantizers.empty()) return standard_quantizers();
  QuantizerSteps result{};
  result.fill(1.0);
  for (std::size_t i = 0; i < header.quantizers.size() && i < low_level_fap_count; ++i) {
    result[first_low_level_fap + i] = header.quantizers[i];
  }
  return result;
}

Result<std::int16_t> quantize(double fap_units, double step) {
  if (!std::isfinite(fap_units)) return Error{ErrorCode::not_finite, "", "must be finite"};
  const double level = std::round(fap_units / step);
  if (std::abs(level) > static_cast<double>(max_level)) {
    return Error{ErrorCode::out_of_range, "", "beyond 32767 levels of " + shortest_fixed_text(step) + " FAP units"};
  }
  return static_cast<std::int16_t>(level);
}

}  // namespace semblante
