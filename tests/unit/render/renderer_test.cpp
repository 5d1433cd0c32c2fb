#include "clients/native/render/renderer.h"

#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include "core/gltf/encode_image.h"
#include "tests/unit/render/ball.h"

namespace semblante::testing {
namespace {

using render::Picture;
using render::Renderer;
using render::Rgb;
using render::Subject;
using render::View;

Renderer make(const Model& model) {
  auto scene = render::build_scene(model);
  EXPECT_TRUE(scene);
  auto renderer = Renderer::create(*std::move(scene));
  EXPECT_TRUE(renderer) << renderer.error().message;
  return *std::move(renderer);
}

Picture draw(Renderer& renderer, View view = View::front) {
  auto picture = renderer.draw(view, Subject::all, {96, 96});
  EXPECT_TRUE(picture) << picture.error().message;
  return *std::move(picture);
}

Rgb pixel(const Picture& picture, int x, int y) {
  const std::size_t at = (static_cast<std::size_t>(y) * picture.width + x) * 3;
  return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

TEST(Renderer, SkinBall_IsSkinInTheMiddleAndBackdropAtTheCorners) {
  Renderer renderer = make(seamed_ball());
  const Picture picture = draw(renderer);
  const Rgb middle = pixel(picture, 48, 48);
  EXPECT_GT(middle[0], middle[2] + 30) << "skin is redder than blue";
  const Rgb corner = pixel(picture, 2, 2);
  EXPECT_LT(std::abs(corner[0] - corner[2]), 12) << "the backdrop is grey";
}

TEST(Renderer, MovedVertices_ChangeThePicture) {
  const Model model = seamed_ball();
  Renderer renderer = make(model);
  const Picture before = draw(renderer);
  EXPECT_EQ(render::mean_difference(before, draw(renderer)), 0.0) << "the same frame twice";
  std::vector<glm::vec3> moved = model.positions;
  for (glm::vec3& p : moved) {
    p.y *= 0.6F;
  }
  ASSERT_TRUE(renderer.set_positions(moved));
  EXPECT_GT(render::mean_difference(before, draw(renderer)), 5.0);
  ASSERT_TRUE(renderer.set_positions(model.positions));
  EXPECT_EQ(render::mean_difference(before, draw(renderer)), 0.0);
}

TEST(Renderer, TexturedBall_ShowsTheTexturesRows) {
  // Red above, blue below: v = 0 is the first row of the image and the top of the ball.
  Model model = seamed_ball();
  std::vector<std::uint8_t> pixels = {255, 0, 0, 255, 0, 0, 0, 0, 255, 0, 0, 255};
  model.images.push_back({"image/png", encode_png(pixels, 2, 2, 3)});
  model.materials.emplace_back();
  model.materials[0].base_color_image = 0;
  model.primitives[0].material = 0;
  Renderer renderer = make(model);
  const Picture picture = draw(renderer);
  const Rgb above = pixel(picture, 48, 24);
  const Rgb below = pixel(picture, 48, 72);
  EXPECT_GT(above[0], above[2] + 50);
  EXPECT_GT(below[2], below[0] + 50);
}

TEST(Renderer, VertexColors_LookLikeATextureOfTheirColor) {
  constexpr Color8 color = {190, 110, 60};
  const auto ball_of = [](std::vector<std::uint8_t> rgb) {
    Model model = seamed_ball();
    model.images.push_back({"image/png", encode_png(rgb, 1, 1, 3)});
    model.materials.emplace_back();
    model.materials[0].base_color_image = 0;
    model.primitives[0].material = 0;
    return model;
  };
  Model colored = ball_of({255, 255, 255});
  colored.colors.assign(colored.positions.size(), color);
  colored.primitives[0].has_colors = true;
  Renderer of_colors = make(colored);
  Renderer of_texture = make(ball_of({color.begin(), color.end()}));
  const Picture picture = draw(of_colors);
  EXPECT_LT(render::mean_difference(picture, draw(of_texture)), 0.5);

  // Without a material they are the whole look, not that of skin under them.
  colored.primitives[0].material = -1;
  colored.colors.assign(colored.positions.size(), {40, 60, 200});
  Renderer of_colors_alone = make(colored);
  const Rgb middle = pixel(draw(of_colors_alone), 48, 48);
  EXPECT_GT(middle[2], middle[0] + 80);
}

TEST(Renderer, FullyMaskedAndClearMaterials_AreNotDrawn) {
  for (const auto mode : {Material::AlphaMode::mask, Material::AlphaMode::blend}) {
    Model model = seamed_ball();
    model.materials.emplace_back();
    model.materials[0].base_color = {1, 0, 0, 0};
    model.materials[0].alpha_mode = mode;
    model.primitives[0].material = 0;
    Renderer renderer = make(model);
    const Picture picture = draw(renderer);
    const Rgb middle = pixel(picture, 48, 48);
    EXPECT_LT(std::abs(middle[0] - middle[2]), 12);
  }
}

TEST(Renderer, BadArguments_AreRefused) {
  const Model model = seamed_ball();
  Renderer renderer = make(model);
  EXPECT_EQ(renderer.set_positions(std::span(model.positions).first(3)).error().code, ErrorCode::mismatch);
  EXPECT_EQ(renderer.draw(View::front, Subject::all, {8, 100}).error().code, ErrorCode::invalid_argument);
  EXPECT_EQ(renderer.draw(View::front, Subject::all, {100, 5000}).error().code, ErrorCode::invalid_argument);
}

TEST(Picture, Png_ReadsBackTheSame) {
  Picture picture(3, 2, {10, 20, 30});
  picture.paste(Picture(2, 2, {200, 100, 50}), 2, 1);  // three of its four pixels fall outside
  const std::vector<std::uint8_t> png = encode_png(picture);
  int width = 0;
  int height = 0;
  int channels = 0;
  stbi_uc* pixels = stbi_load_from_memory(png.data(), static_cast<int>(png.size()), &width, &height, &channels, 3);
  ASSERT_NE(pixels, nullptr);
  EXPECT_EQ(width, 3);
  EXPECT_EQ(height, 2);
  EXPECT_TRUE(std::equal(picture.rgb.begin(), picture.rgb.end(), pixels));
  EXPECT_EQ(pixels[(1 * 3 + 2) * 3], 200);
  EXPECT_EQ(pixels[0], 10);
  stbi_image_free(pixels);
}

TEST(Picture, Jpeg_ReadsBackNearlyTheSame) {
  Picture picture(32, 16, {40, 80, 160});
  picture.paste(Picture(16, 16, {200, 100, 50}), 16, 0);
  const std::vector<std::uint8_t> jpeg = encode_jpeg(picture, 90);
  Picture back(32, 16, {0, 0, 0});
  int width = 0;
  int height = 0;
  int channels = 0;
  stbi_uc* pixels = stbi_load_from_memory(jpeg.data(), static_cast<int>(jpeg.size()), &width, &height, &channels, 3);
  ASSERT_NE(pixels, nullptr);
  ASSERT_TRUE(width == 32 && height == 16);
  std::copy_n(pixels, back.rgb.size(), back.rgb.begin());
  stbi_image_free(pixels);
  EXPECT_LT(mean_difference(picture, back), 4.0);
  EXPECT_GT(encode_jpeg(picture, 90).size(), encode_jpeg(picture, 10).size());
  EXPECT_EQ(write_jpeg(picture, "/nowhere/at/all.jpg", 90).error().code, ErrorCode::io);
}

TEST(Picture, UnwritablePath_IsAnError) {
  const Status written = write_png(Picture(2, 2, {0, 0, 0}), "/nowhere/at/all.png");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::io);
  EXPECT_EQ(written.error().where, "/nowhere/at/all.png");
}

}  // namespace
}  // namespace semblante::testing
