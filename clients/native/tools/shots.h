#pragma once

#include <string>
#include <vector>

#include "clients/native/render/renderer.h"
#include "core/types/result.h"

namespace semblante::tools {

/// A view to draw, written as "front", "three-quarter:face" or "below:mouth". Without a subject: the whole head.
struct Shot {
  std::string name;
  render::View view = render::View::front;
  render::Subject subject = render::Subject::all;
};

/// Errors: invalid_argument, with the unknown word and the valid ones.
Result<Shot> parse_shot(const std::string& text);
/// Several shots, in their order; the first invalid one is the error.
Result<std::vector<Shot>> parse_shots(const std::vector<std::string>& texts);
/// "640x480" or "512" for a square. Errors: invalid_argument.
Result<render::PictureSize> parse_size(const std::string& text);

}  // namespace semblante::tools
