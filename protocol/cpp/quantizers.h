#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/messages.h"

namespace semblante {

/// FAP units per quantized level, by FAP number (entries 0..2 are 1 and unused).
using QuantizerSteps = std::array<double, 69>;

/// The quantizer steps of the standard.
const QuantizerSteps& standard_quantizers();

/// Allowed ratios of a stream's steps to the standard ones.
inline constexpr std::array<double, 4> quantizer_scales = {1.0, 0.5, 0.25, 0.125};
bool is_quantizer_scale(double scale);

/// The standard steps times one of quantizer_scales.
QuantizerSteps scaled_quantizers(double scale);

/// The header's `quantizers` for such steps; empty for scale 1.
std::vector<double> header_quantizers(double scale);

/// Converts a frame to levels of other steps, rounded to the nearest (halves away from zero) and clamped to +-32767
/// levels. A conversion from coarse to fine and back is exact.
FaceFrame requantized(const FaceFrame& frame, const QuantizerSteps& from, const QuantizerSteps& to);

/// The quantizer steps of a stream: those of its header, else the standard's.
QuantizerSteps quantizers_of(const Header& header);

/// Quantizes a value in FAP units to the nearest level (halves away from zero). Errors: not_finite; out_of_range
/// beyond +-32767 levels. The caller sets `where`.
Result<std::int16_t> quantize(double fap_units, double step);

}  // namespace semblante
