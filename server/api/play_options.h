#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/api/common.h"
#include "server/streams/player.h"

namespace semblante::api {

/// Of a .fap file; others have limits of their own.
inline constexpr std::size_t max_fap_body_bytes = std::size_t{16} << 20U;

/// From the disk if it lies there, so that requests that are still on their way take no memory.
std::string text_of_body(const http::Request& request);

/// How something is to be played, from the query: fps, loop, from (ms), take_over. Refuses what is none.
streams::PlayOptions play_options(const http::Request& request);

/// Plays a source into a stream: 202 with where it can be seen and stopped. Refuses with 409 when somebody else
/// publishes or plays, with 400 when it is to begin after its end, with 507 when it does not fit beside what plays.
/// `warnings`: of what was posted, if it can have any.
http::Response play_into(Context& context, const std::string& stream,
                         std::shared_ptr<const streams::FrameSource> source, const streams::PlayOptions& options,
                         const std::optional<std::vector<std::string>>& warnings = std::nullopt);

}  // namespace semblante::api
