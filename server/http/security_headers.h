#pragma once

#include <span>
#include <string>
#include <utility>

#include "server/http/message.h"

namespace semblante::http {

using Header = std::pair<std::string, std::string>;

/// Headers of every answer: no page may frame it, no browser guesses another media type, no address of ours is told to
/// another site, and no page of another origin loads it without CORS.
std::span<const Header> security_headers();

/// Headers of a file of the web root: scripts, styles and connections of this server only, and no handle on its window
/// for the page that opened it. `blob:` and `data:` are what a page has made itself: the mesh decoder's worker, images
/// inside a model, files to save.
std::span<const Header> page_headers();

/// Lets pages of these origins frame an answer that has the headers above.
void allow_frames(Response& response, std::span<const std::string> origins);

}  // namespace semblante::http
