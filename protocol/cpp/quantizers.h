#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/messages.h"

namespace semblante {

/// By FAP number (entries 0..2 are 1 and unused): FAP units per quantized level.
using QuantizerSteps = std::array<double, 69>;

/// The steps of the standard's table.
const QuantizerSteps& standard_quantizers();

/// What a stream's steps may be of the standard ones: as they are, or finer.
inline constexpr std::array<double, 4> quantizer_scales = {1.0, 0.5, 0.25, 0.125};
bool is_quantizer_scale(double scale);

/// The standard steps times one of quantizer_scales.
QuantizerSteps scaled_quantizers(double scale);

/// A header's `quantizers` for such steps: empty for 1.
std::vector<double> header_quantizers(double scale);

/// The same face in levels of other steps, to the nearest (halves away from zero); what is beyond +-32767 levels
/// becomes that. From coarse to fine and back is exact.
FaceFrame requantized(const FaceFrame& frame, const QuantizerSteps& from, const QuantizerSteps& to);

/// The steps a stream uses: its header's own, or the standard ones when it gives none.
QuantizerSteps quantizers_of(const Header& header);

/// value in FAP units -> level, rounded to nearest (halves away from zero). Errors: not_finite; out_of_range beyond
/// +-32767 levels. `where` is left to the caller.
Result<std::int16_t> quantize(double fap_units, double step);

}  // namespace semblante
