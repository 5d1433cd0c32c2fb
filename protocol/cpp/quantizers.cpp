#include "protocol/cpp/quantizers.h"

#include <cmath>

#include "core/tables/mpeg4.h"

namespace semblante {

const QuantizerSteps& standard_quantizers() {
  static const QuantizerSteps steps = [] {
    QuantizerSteps result{};
    result.fill(1.0);
    for (const auto& fap : mpeg4::faps) result[fap.number] = fap.quantizer_step;
    return result;
  }();
  return steps;
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
    return Error{ErrorCode::out_of_range, "", "beyond 32767 levels of " + std::to_string(step) + " FAP units"};
  }
  return static_cast<std::int16_t>(level);
}

}  // namespace semblante
