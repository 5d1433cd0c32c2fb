#pragma once

#include <string>
#include <vector>

#include "clients/native/render/renderer.h"
#include "core/types/result.h"

namespace semblante::tools {

/// What to draw, as people write it: "front", "three-quarter:face", "below:mouth". Without a subject: the whole head.
struct Shot {
  std::string name;
  render::View view = render::View::front;
  render::Subject subject = render::Subject::all;
};

/// Errors: invalid_argument, naming the word and the words that would do.
Result<Shot> parse_shot(const std::string& text);
/// Several, in their order; the first that is none is the error.
Result<std::vector<Shot>> parse_shots(const std::vector<std::string>& texts);
/// "640x480" or "512" for a square. Errors: invalid_argument.
Result<render::PictureSize> parse_size(const std::string& text);

}  // namespace semblante::tools
