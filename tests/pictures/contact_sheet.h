#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "clients/native/render/picture.h"

namespace semblante::pictures {

struct LabelledPicture {
  std::string label;
  render::Picture picture;
};

/// Draws ASCII text with its top left corner at (x, y); a letter is about 7 * scale pixels high.
void draw_label(render::Picture& picture, std::string_view text, int x, int y, int scale, render::Rgb color);

/// Draws a grid, row by row, each picture under its label, with an optional title on top. Cells have the size of the
/// largest picture. `columns` of 0: a sheet about as wide as high.
render::Picture contact_sheet(const std::vector<LabelledPicture>& pictures, std::string_view title = {},
                              int columns = 0);

}  // namespace semblante::pictures
