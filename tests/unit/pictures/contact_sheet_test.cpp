#include "tests/pictures/contact_sheet.h"

#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

namespace semblante::pictures {
namespace {

using render::Picture;
using render::Rgb;

TEST(ContactSheet, OfFive_HasThreeColumnsAndLabels) {
  const Rgb red = {255, 0, 0};
  const std::vector<LabelledPicture> pictures(5, {"label", Picture(40, 30, red)});
  const Picture sheet = contact_sheet(pictures, "title");
  // ceil(sqrt 5) = 3 columns, so 2 rows.
  EXPECT_GT(sheet.width, 3 * 40);
  EXPECT_LT(sheet.width, 4 * 40 + 60);
  std::size_t reds = 0;
  std::size_t darks = 0;
  for (std::size_t i = 0; i < sheet.rgb.size(); i += 3) {
    reds += sheet.rgb[i] == 255 && sheet.rgb[i + 1] == 0 ? 1 : 0;
    darks += sheet.rgb[i] < 100 ? 1 : 0;
  }
  EXPECT_EQ(reds, 5U * 40 * 30);
  EXPECT_GT(darks, 100U) << "the letters";
}

}  // namespace
}  // namespace semblante::pictures
