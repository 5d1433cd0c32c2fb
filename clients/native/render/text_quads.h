#pragma once

#include <string_view>
#include <vector>

namespace semblante::render {

/// A rectangle of a letter, in pixels of the font: x to the right, y downwards from the top of the first line.
struct TextQuad {
  float left, top, right, bottom;
};

/// Height of a line, in pixels of the font.
inline constexpr float text_line_height = 12;

/// A text of ASCII, `\n` for a new line, as rectangles to fill (the font of stb_easy_font). Other characters become
/// '?'.
std::vector<TextQuad> text_quads(std::string_view text);

}  // namespace semblante::render
