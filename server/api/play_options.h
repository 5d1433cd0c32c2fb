#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/api/common.h"
#include "server/streams/player.h"

namespace semblante::api {

/// The playback options in the query: fps, loop, from (ms), take_over. Refuses invalid values.
streams::PlayOptions play_options(const http::Request& request);

/// Plays a source into a stream: 202 with the URL at which its status can be read and it can be stopped. Refuses with
/// 409 when another source holds the stream, with 400 when `from` is after the end, with 507 when it does not fit into
/// memory beside the other sources. `warnings`: of the posted file, if its format has warnings.
http::Response play_into(Context& context, const std::string& stream,
                         std::shared_ptr<const streams::FrameSource> source, const streams::PlayOptions& options,
                         const std::optional<std::vector<std::string>>& warnings = std::nullopt);

}  // namespace semblante::api
