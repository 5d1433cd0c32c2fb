#pragma once

#include <memory>
#include <string>

#include "server/api/common.h"
#include "server/streams/player.h"

namespace semblante::api {

/// How something is to be played, from the query: fps, loop, from (ms), take_over. Refuses what is none.
streams::PlayOptions play_options(const http::Request& request);

/// Plays a source into a stream: 202 with where it can be seen and stopped. Refuses with 409 when somebody else
/// publishes or plays, with 422 when it is to begin after its end.
http::Response play_into(Context& context, const std::string& stream,
                         std::shared_ptr<const streams::FrameSource> source, const streams::PlayOptions& options);

}  // namespace semblante::api
