#include "tests/pictures/contact_sheet.h"

#include <algorithm>
#include <cmath>

// The header defines functions; those unused here would be warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

namespace semblante::pictures {
namespace {

constexpr render::Rgb paper = {246, 245, 242};
constexpr render::Rgb ink = {52, 50, 48};
constexpr int gap = 12;
constexpr int label_height = 24;
constexpr int title_height = 44;

/// stb_easy_font writes four of these vertices per quad.
struct FontVertex {
  float x, y, z;
  std::uint8_t color[4];
};

}  // namespace

void draw_label(render::Picture& picture, std::string_view text, int x, int y, int scale, render::Rgb color) {
  std::string printable(text);
  for (char& c : printable) {
    c = c < ' ' || c > '~' ? '?' : c;
  }
  std::vector<FontVertex> quads((printable.size() + 1) * 70);
  const int count = stb_easy_font_print(0, 0, printable.data(), nullptr, quads.data(),
                                        static_cast<int>(quads.size() * sizeof(FontVertex)));
  for (int q = 0; q < count; ++q) {
    const FontVertex& a = quads[static_cast<std::size_t>(q) * 4];
    const FontVertex& b = quads[static_cast<std::size_t>(q) * 4 + 2];
    const auto clamp_x = [&](float v) { return std::clamp(x + static_cast<int>(v * scale), 0, picture.width); };
    const auto clamp_y = [&](float v) { return std::clamp(y + static_cast<int>(v * scale), 0, picture.height); };
    for (int row = clamp_y(a.y); row < clamp_y(b.y); ++row) {
      for (int column = clamp_x(a.x); column < clamp_x(b.x); ++column) {
        std::copy(color.begin(), color.end(),
                  picture.rgb.begin() + (static_cast<std::ptrdiff_t>(row) * picture.width + column) * 3);
      }
    }
  }
}

render::Picture contact_sheet(const std::vector<LabelledPicture>& pictures, std::string_view title, int columns) {
  const int count = static_cast<int>(pictures.size());
  if (columns <= 0) {
    columns = static_cast<int>(std::ceil(std::sqrt(count)));
  }
  columns = std::clamp(columns, 1, std::max(1, count));
  const int rows = (count + columns - 1) / columns;
  int cell_width = 1;
  int cell_height = 1;
  for (const LabelledPicture& entry : pictures) {
    cell_width = std::max(cell_width, entry.picture.width);
    cell_height = std::max(cell_height, entry.picture.height);
  }
  const int top = title.empty() ? gap : title_height;
  render::Picture sheet(gap + columns * (cell_width + gap), top + rows * (cell_height + label_height + gap), paper);
  if (!title.empty()) {
    draw_label(sheet, title, gap, gap, 3, ink);
  }
  for (int i = 0; i < count; ++i) {
    const int x = gap + i % columns * (cell_width + gap);
    const int y = top + i / columns * (cell_height + label_height + gap);
    const LabelledPicture& entry = pictures[static_cast<std::size_t>(i)];
    draw_label(sheet, entry.label, x + 2, y + 5, 2, ink);
    sheet.paste(entry.picture, x, y + label_height);
  }
  return sheet;
}

}  // namespace semblante::pictures
