#pragma once

#include <span>
#include <string>
#include <utility>

namespace semblante::http {

using Header = std::pair<std::string, std::string>;

/// Headers of every answer: no page may frame it, no browser guesses another media type, and no address of ours is told
/// to another site.
std::span<const Header> security_headers();

/// Headers of a file of the web root: scripts, styles and connections of this server only, and no handle on its window
/// for the page that opened it. `blob:` and `data:` are what a page has made itself: the mesh decoder's worker, images
/// inside a model, files to save.
std::span<const Header> page_headers();

}  // namespace semblante::http
