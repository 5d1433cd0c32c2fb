#pragma once

#include <array>
#include <span>

#include "core/types/result.h"
#include "protocol/cpp/messages.h"

namespace semblante {

/// By FAP number (entries 0..2 are 1 and unused): FAP units per quantized level.
using QuantizerSteps = std::array<double, 69>;

/// The steps of the standard's table.
const QuantizerSteps& standard_quantizers();

/// The steps a stream uses: its header's own, or the standard ones when it gives none.
QuantizerSteps quantizers_of(const Header& header);

/// value in FAP units -> level, rounded to nearest (halves away from zero). Errors: not_finite; out_of_range beyond
/// +-32767 levels. `where` is left to the caller.
Result<std::int16_t> quantize(double fap_units, double step);

}  // namespace semblante
