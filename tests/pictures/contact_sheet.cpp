#include "tests/pictures/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "clients/native/render/text_quads.h"

namespace semblante::pictures {
namespace {

constexpr render::Rgb paper = {246, 245, 242};
constexpr render::Rgb ink = {52, 50, 48};
constexpr int gap = 12;
constexpr int label_height = 24;
constexpr int title_height = 44;

}  // namespace

void draw_label(render::Picture& picture, std::string_view text, int x, int y, int scale, render::Rgb color) {
  for (const render::TextQuad& quad : render::text_quads(text)) {
    const auto clamp_x = [&](float v) { return std::clamp(x + static_cast<int>(v * scale), 0, picture.width); };
    const auto clamp_y = [&](float v) { return std::clamp(y + static_cast<int>(v * scale), 0, picture.height); };
    for (int row = clamp_y(quad.top); row < clamp_y(quad.bottom); ++row) {
      for (int column = clamp_x(quad.left); column < clamp_x(quad.right); ++column) {
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
