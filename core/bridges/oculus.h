#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "core/kernel/semblante_kernel.h"
#include "core/types/result.h"

namespace semblante {

/// The 15 visemes of Oculus Lipsync, which other systems use too, in their order, which is also the order of FAP 1:
/// sil PP FF TH DD kk CH SS nn RR aa E ih oh ou.
inline constexpr std::size_t oculus_count = SEMBLANTE_VISEME_COUNT;
using OculusWeights = std::array<float, oculus_count>;

/// The name, such as "PP", with static lifetime.
std::string_view oculus_name(std::size_t index);
/// The index of a viseme by name, case-insensitive; nullopt for any other.
std::optional<std::size_t> find_oculus(std::string_view name);

struct FrameFromOculus {
  semblante_frame frame;
  std::size_t clamped = 0;  ///< weights that were outside 0..1 and were taken as 0 or 1
};

enum class OculusBlend {
  two_visemes,  ///< FAP 1 alone: what any player of MPEG-4 shows
  all_visemes,  ///< low-level FAPs of the mouth for the sum of all weights, over the same FAP 1
};

/// Converts weights to a frame. The weights except silence are divided by their sum if it exceeds 1; the rest to 1 is
/// silence, independent of the weight of silence. FAP 1 holds two visemes whose weights sum to 1, so it gets the
/// nearest pair (least squares over the weights, silence not counted): the two strongest, if 1 minus their sum is less
/// than 1.41 times the weaker, else the strongest and silence. Ties go to the lower number. Error: `not_finite` with
/// the viseme's name for a weight that is NaN or infinite.
Result<FrameFromOculus> frame_from_oculus(std::span<const float, oculus_count> weights,
                                          OculusBlend blend = OculusBlend::two_visemes);

/// The weights that fit a mouth: exactly FAP 1's if nothing else moves the mouth; low-level FAPs of jaw, lips and
/// tongue change them to the nearest fit (least squares over the FPs, regularized towards FAP 1's). Weights are at
/// least 0 and sum to 1; the rest is silence. Expressions are ignored. The frame's FAPs must be finite.
OculusWeights oculus_from_frame(const semblante_frame& frame);

}  // namespace semblante
