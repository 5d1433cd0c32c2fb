#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/frame/frame_guess.h"

namespace semblante::store {

/// {"unit": "cm", "metres_per_unit": 0.01, "axes": {"up": "+Y", "front": "+Z"}, "guessed": true,
///  "by_user": {"unit": false, "axes": false}, "sure": {"unit": true, "axes": true}, "reasons": ["..."]}:
/// the frame in answers, reports and the store. "guessed" is false when the user has given all of it. A tilted head has
/// "tilt" too: the three rows of ModelFrame::tilt.
nlohmann::json frame_to_json(const ModelFrame& frame, const FrameWish& wish);
/// The reverse, without the wish. Throws nlohmann::json::exception for anything else.
ModelFrame frame_from_json(const nlohmann::json& json);

/// {"unit": "cm", "up": "+Z", "front": "-Y"}: only the members that the user has given.
nlohmann::json wish_to_json(const FrameWish& wish);
/// The reverse. Throws nlohmann::json::exception for anything else.
FrameWish wish_from_json(const nlohmann::json& json);

}  // namespace semblante::store
