// The opacity of an OBJ's materials: of the colour image, or of an image of its own.
#include <memory>

#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include "core/gltf/encode_image.h"
#include "core/import/import.h"
#include "tests/unit/import/shown_pixels.h"
#include "tests/unit/import/test_files.h"

namespace semblante::test {
namespace {

using enum Material::AlphaMode;

constexpr int side = 4;

/// Grey pixels, from `values`, row by row.
Bytes grey_png(const std::vector<std::uint8_t>& values, int width = side) {
  Bytes rgb;
  for (const std::uint8_t value : values) rgb.insert(rgb.end(), 3, value);
  return encode_png(rgb, width, static_cast<int>(values.size()) / width, 3);
}

Bytes brown_jpeg() {
  Bytes rgb;
  for (int i = 0; i < side * side; ++i) rgb.insert(rgb.end(), {120, 80, 40});
  return encode_jpeg(rgb, side, side, 3, 95);
}

/// Half clear, half opaque.
const std::vector<std::uint8_t> strip = {0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 255, 255};
const std::vector<std::uint8_t> strands = {0, 100, 200, 255, 0, 100, 200, 255, 0, 100, 200, 255, 0, 100, 200, 255};
const std::vector<std::uint8_t> solid(std::size_t{side} * side, 255);

/// A quad whose material "skin" has these lines, with these files beside it.
Model read_quad(const std::string& lines, std::vector<std::pair<std::string, Bytes>> files,
                const ImportLimits& limits = {}) {
  files.emplace_back("head.obj", quad_obj());
  files.emplace_back("quad.mtl", to_bytes("newmtl skin\n" + lines));
  auto model = import_model(make_zip(files), ModelFormat::gltf_zip, limits);
  EXPECT_TRUE(model) << model.error().message;
  return model ? std::move(*model) : Model{};
}

std::vector<std::uint8_t> alphas_of(const Image& image) {
  std::vector<std::uint8_t> alphas;
  const Bytes pixels = pixels_of(image).rgba;
  for (std::size_t i = 3; i < pixels.size(); i += 4) alphas.push_back(pixels[i]);
  return alphas;
}

TEST(ObjOpacity, OfTheColorImage_IsAMask) {
  struct Case {
    const char* lines;
    int channels;
    Material::AlphaMode mode;
  };
  for (const Case& test :
       {Case{"map_Kd hair.png\nmap_d -imfchan m hair.png\n", 4, mask},
        Case{"map_Kd hair.png\nmap_d hair.png\nd 0.5\n", 4, blend},
        Case{"map_Kd hair.png\nmap_d hair.png\n", 3, opaque}, Case{"map_Kd hair.png\n", 4, opaque}}) {
    const Bytes png =
        encode_png(Bytes(static_cast<std::size_t>(side * side * test.channels), 90), side, side, test.channels);
    const Model model = read_quad(test.lines, {{"hair.png", png}});
    EXPECT_EQ(model.materials[0].alpha_mode, test.mode) << test.lines;
    EXPECT_TRUE(model.warnings.empty()) << test.lines;
    ASSERT_EQ(model.images.size(), 1U);
    EXPECT_EQ(model.images[0].bytes, png) << "the file's own bytes";
  }
}

TEST(ObjOpacity, OfAnImageOfItsOwn_IsThatOfTheColors) {
  const Model model = read_quad("map_Kd hair.jpg\nmap_d opacity.png\n",
                                {{"hair.jpg", brown_jpeg()}, {"opacity.png", grey_png(strands)}});
  EXPECT_TRUE(model.warnings.empty()) << model.warnings.front();
  ASSERT_EQ(model.images.size(), 1U) << "the image of colour alone is not used";
  EXPECT_EQ(model.images[0].mime_type, "image/png");
  EXPECT_EQ(alphas_of(model.images[0]), strands);
  const Bytes pixels = pixels_of(model.images[0]).rgba;
  EXPECT_NEAR(pixels[0], 120, 3);
  EXPECT_NEAR(pixels[1], 80, 3);
  EXPECT_NEAR(pixels[2], 40, 3);
  EXPECT_EQ(model.materials[0].base_color_image, 0);
  EXPECT_EQ(model.materials[0].alpha_mode, blend) << "strands are neither opaque nor clear";
  EXPECT_FALSE(model.materials[0].is_color_lost);
}

TEST(ObjOpacity, WithoutSoftEdges_IsAMask_AndOpacityEverywhereIsNone) {
  const Bytes color = brown_jpeg();
  const Model cut =
      read_quad("map_d opacity.png\nmap_Kd hair.jpg\n", {{"hair.jpg", color}, {"opacity.png", grey_png(strip)}});
  EXPECT_EQ(cut.materials[0].alpha_mode, mask);
  EXPECT_EQ(alphas_of(cut.images.at(0)), strip);
  const Model whole =
      read_quad("map_Kd hair.jpg\nmap_d opacity.png\n", {{"hair.jpg", color}, {"opacity.png", grey_png(solid)}});
  EXPECT_EQ(whole.materials[0].alpha_mode, opaque);
  EXPECT_EQ(whole.images.at(0).bytes, color);
}

TEST(ObjOpacity, OfAnImageWithAlpha_IsItsAlpha) {
  Bytes rgba;
  for (const std::uint8_t alpha : strip) rgba.insert(rgba.end(), {7, 7, 7, alpha});
  const Model model = read_quad("map_Kd hair.jpg\nmap_d opacity.png\n",
                                {{"hair.jpg", brown_jpeg()}, {"opacity.png", encode_png(rgba, side, side, 4)}});
  EXPECT_EQ(alphas_of(model.images.at(0)), strip);
}

TEST(ObjOpacity, OfAnotherSize_IsTheMeanOfWhatAPixelCovers) {
  std::vector<std::uint8_t> fine;  // twice the side of `strands`
  for (int y = 0; y < 2 * side; ++y) {
    for (int x = 0; x < 2 * side; ++x) fine.push_back(static_cast<std::uint8_t>(x % 2 == 0 ? 40 : 60));
  }
  const Model smaller = read_quad("map_Kd hair.jpg\nmap_d opacity.png\n",
                                  {{"hair.jpg", brown_jpeg()}, {"opacity.png", grey_png(fine, 2 * side)}});
  EXPECT_EQ(alphas_of(smaller.images.at(0)), std::vector<std::uint8_t>(std::size_t{side} * side, 50));
  const Model larger = read_quad("map_Kd hair.jpg\nmap_d opacity.png\n",
                                 {{"hair.jpg", brown_jpeg()}, {"opacity.png", grey_png({0, 255}, 2)}});
  EXPECT_EQ(alphas_of(larger.images.at(0)), strip);
}

TEST(ObjOpacity, WithoutAnImageOfColor_IsThatOfTheColor) {
  const Model model = read_quad("Kd 0.5 0.25 0.125\nd 0\nmap_d opacity.png\n", {{"opacity.png", grey_png(strip)}});
  EXPECT_EQ(model.materials[0].base_color, glm::vec4(0.5F, 0.25F, 0.125F, 1.0F)) << "0 beside an image means nothing";
  EXPECT_EQ(model.materials[0].alpha_mode, mask);
  EXPECT_FALSE(model.materials[0].is_color_lost);
  EXPECT_EQ(alphas_of(model.images.at(0)), strip);
  EXPECT_EQ(pixels_of(model.images.at(0)).rgba[0], 255);
}

TEST(ObjOpacity, OfADamagedOrMissingImage_IsOmitted_WithAWarning) {
  const Bytes color = brown_jpeg();
  Bytes damaged = grey_png(strands);
  std::fill(damaged.begin() + 40, damaged.end(), std::uint8_t{0});
  for (const auto& [file, fault] :
       {std::pair{damaged, "the image 'opacity.png' is a PNG that cannot be decoded; it is omitted"},
        {Bytes{}, "opacity.png"}}) {
    std::vector<std::pair<std::string, Bytes>> files = {{"hair.jpg", color}};
    if (!file.empty()) files.emplace_back("opacity.png", file);
    const Model model = read_quad("map_Kd hair.jpg\nmap_d opacity.png\n", files);
    ASSERT_EQ(model.warnings.size(), 1U);
    EXPECT_NE(model.warnings[0].find(fault), std::string::npos) << model.warnings[0];
    EXPECT_EQ(model.materials[0].alpha_mode, opaque);
    EXPECT_EQ(model.images.at(0).bytes, color);
  }
}

TEST(ObjOpacity, IsNotDecoded_BeyondTheLimit) {
  ImportLimits limits;
  limits.max_image_pixels = 15;
  const Model model = read_quad("map_Kd hair.jpg\nmap_d opacity.png\n",
                                {{"hair.jpg", brown_jpeg()}, {"opacity.png", grey_png(strands)}}, limits);
  ASSERT_EQ(model.warnings.size(), 1U);
  EXPECT_EQ(model.warnings[0], "the image 'opacity.png' is a PNG of 4 x 4, more than 15 pixels; it is omitted");
  EXPECT_EQ(model.materials[0].alpha_mode, opaque);
  EXPECT_EQ(model.images.size(), 1U);
}

}  // namespace
}  // namespace semblante::test
