#include "clients/native/render/text_quads.h"

#include <cstdint>
#include <string>

// The header defines functions; those unused here would be warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

namespace semblante::render {
namespace {

/// stb_easy_font writes four of these vertices per quad.
struct FontVertex {
  float x, y, z;
  std::uint8_t color[4];
};

}  // namespace

std::vector<TextQuad> text_quads(std::string_view text) {
  std::string printable(text);
  for (char& c : printable) {
    c = c != '\n' && (c < ' ' || c > '~') ? '?' : c;
  }
  std::vector<FontVertex> vertices((printable.size() + 1) * 70);
  const int count = stb_easy_font_print(0, 0, printable.data(), nullptr, vertices.data(),
                                        static_cast<int>(vertices.size() * sizeof(FontVertex)));
  std::vector<TextQuad> quads(static_cast<std::size_t>(count));
  for (std::size_t q = 0; q < quads.size(); ++q) {
    const FontVertex& a = vertices[q * 4];
    const FontVertex& b = vertices[q * 4 + 2];
    quads[q] = {a.x, a.y, b.x, b.y};
  }
  return quads;
}

}  // namespace semblante::render
