#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "protocol/clips/clip.h"
#include "server/api/api.h"

namespace semblante::api {

/// Limit of the frames of a clip, which are in memory: half an hour at 25 per second.
inline constexpr std::size_t max_clip_memory_frames = 50'000;

/// Frames on a level of detail of a parametrized model as a GLB, made in memory. Refuses with 409 a model that has no
/// face package or no clip, and with 413 a clip over the limits of make_clip. `pointer`: the place in the request that
/// names the model. Take a slot of context.exports first.
std::string clip_of_model(Context& context, const store::ModelRecord& model, std::size_t level,
                          std::span<const TimedValues> frames, const ClipOptions& options,
                          const std::string& pointer = {});

}  // namespace semblante::api
