#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "core/kernel/semblante_kernel.h"
#include "core/types/result.h"

namespace semblante {

/// The 15 visemes of Oculus Lipsync (and of those who took them over), in their order, which is that of FAP 1:
/// sil PP FF TH DD kk CH SS nn RR aa E ih oh ou.
inline constexpr std::size_t oculus_count = SEMBLANTE_VISEME_COUNT;
using OculusWeights = std::array<float, oculus_count>;

/// "PP"; lives as long as the program.
std::string_view oculus_name(std::size_t index);
/// Small and capital letters are the same; empty for any other name.
std::optional<std::size_t> find_oculus(std::string_view name);

struct FrameFromOculus {
  semblante_frame frame;
  std::size_t clamped = 0;  ///< weights that were outside 0..1 and were taken as 0 or 1
};

enum class OculusBlend {
  two_visemes,  ///< FAP 1 alone: what any player of MPEG-4 shows
  all_visemes,  ///< low-level FAPs of the mouth for the sum of all weights, over the same FAP 1
};

/// Weights -> a frame. Of the visemes but silence those that sum to more than 1 are divided by their sum; what is
/// missing to 1 is silence, whatever weight silence has. FAP 1 holds two visemes whose strengths sum to 1, so it gets
/// the nearest pair (least squares over the weights, silence costing nothing): the two strongest, if what they lack to
/// 1 is less than 1.41 times the weaker, else the strongest with silence. Ties go to the lower number. Refused with
/// `not_finite` and the viseme's name where a weight is NaN or infinite.
Result<FrameFromOculus> frame_from_oculus(std::span<const float, oculus_count> weights,
                                          OculusBlend blend = OculusBlend::two_visemes);

/// What weights a mouth has: exactly those of FAP 1 where nothing else moves it; low-level FAPs of jaw, lips and
/// tongue change them to what comes nearest (least squares over the FPs), drawn to FAP 1's. At least 0, sum 1: what is
/// missing is silence. Expressions do not count. The frame's FAPs must be finite.
OculusWeights oculus_from_frame(const semblante_frame& frame);

}  // namespace semblante
