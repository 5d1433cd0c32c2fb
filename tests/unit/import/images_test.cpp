// Images of all formats: what is kept, what is converted, and what is left out with a warning.
#include <gtest/gtest.h>

#include "core/import/image_reader.h"
#include "tests/unit/import/compressed_quads.h"
#include "tests/unit/import/shown_pixels.h"
#include "tests/unit/import/webp_images.h"

namespace semblante::test {
namespace {

const Bytes png = png_of(4, 4);

nlohmann::json by_extension(const char* name, int source) { return {{"extensions", {{name, {{"source", source}}}}}}; }

TEST(Webp, WithoutLoss_BecomesAPng_PixelByPixel) {
  const auto model = webp_quad().import();
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_TRUE(model->warnings.empty()) << model->warnings.front();
  ASSERT_EQ(model->images.size(), 1U);
  EXPECT_EQ(model->images[0].mime_type, "image/png");
  const ShownPixels pixels = pixels_of(model->images[0]);
  EXPECT_EQ(pixels.width, 2);
  EXPECT_EQ(pixels.rgba, (Bytes{255, 0, 0, 255, 0, 255, 0, 128, 0, 0, 255, 255, 10, 20, 30, 0}));
  EXPECT_EQ(model->materials[0].base_color_image, 0);
  EXPECT_FALSE(model->materials[0].is_color_lost);
}

TEST(Webp, WithLossAndOpaque_BecomesAJpeg_AlsoAsAPlainImage) {
  const auto model = quad_with_texture({{"source", 0}}, {lossy_webp}).import();
  ASSERT_TRUE(model) << model.error().message;
  ASSERT_EQ(model->images.size(), 1U);
  EXPECT_EQ(model->images[0].mime_type, "image/jpeg");
  const ShownPixels pixels = pixels_of(model->images[0]);
  ASSERT_EQ(pixels.rgba.size(), 16U * 16 * 4);
  const auto expect_color = [&](std::size_t x, int red, int green, int blue) {
    const std::size_t at = (8 * 16 + x) * 4;
    EXPECT_NEAR(pixels.rgba[at], red, 12);
    EXPECT_NEAR(pixels.rgba[at + 1], green, 12);
    EXPECT_NEAR(pixels.rgba[at + 2], blue, 12);
  };
  expect_color(3, 200, 40, 80);
  expect_color(12, 200, 160, 80);
}

TEST(Webp, BesideAPng_IsNotNeeded) {
  nlohmann::json texture = by_extension("EXT_texture_webp", 1);
  texture["source"] = 0;
  const auto model = quad_with_texture(texture, {png, lossy_webp}).import();
  ASSERT_TRUE(model) << model.error().message;
  ASSERT_EQ(model->images.size(), 1U);
  EXPECT_EQ(model->images[0].bytes, png);
}

TEST(Webp, BesideKtx2_IsUsed) {
  nlohmann::json texture = by_extension("KHR_texture_basisu", 0);
  texture["extensions"]["EXT_texture_webp"] = {{"source", 1}};
  const auto model = quad_with_texture(texture, {ktx2, lossy_webp}).import();
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->images.size(), 1U);
  EXPECT_TRUE(model->warnings.empty());
}

TEST(Webp, OfAnObjInAZip_IsConverted) {
  const Bytes zip = make_zip({{"head.obj", to_bytes("mtllib a.mtl\nusemtl skin\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n"
                                                    "f 1/1 2/1 3/1\nusemtl cloth\nf 3/1 2/1 1/1\n")},
                              {"a.mtl", to_bytes("newmtl skin\nmap_Kd skin.webp\nnewmtl cloth\nmap_Kd cloth.ktx2\n")},
                              {"skin.webp", lossless_webp},
                              {"cloth.ktx2", ktx2}});
  const auto model = import_model(zip, ModelFormat::gltf_zip);
  ASSERT_TRUE(model) << model.error().message;
  ASSERT_EQ(model->images.size(), 1U);
  EXPECT_EQ(model->images[0].mime_type, "image/png");
  EXPECT_EQ(model->materials[0].base_color_image, 0);
  EXPECT_FALSE(model->materials[0].is_color_lost);
  EXPECT_TRUE(model->materials[1].is_color_lost);
  ASSERT_EQ(model->warnings.size(), 1U);
  EXPECT_NE(model->warnings[0].find("KTX2"), std::string::npos) << model->warnings[0];
}

/// What is wrong with an image, as its warning says; the model must be read all the same.
std::string warning_of(const Bytes& image, const ImportLimits& limits = {}) {
  const auto model = quad_with_texture({{"source", 0}}, {image}).import(limits);
  EXPECT_TRUE(model) << model.error().message;
  if (!model) return {};
  EXPECT_TRUE(model->images.empty());
  EXPECT_EQ(model->materials[0].base_color_image, -1);
  EXPECT_TRUE(model->materials[0].is_color_lost);
  EXPECT_EQ(model->warnings.size(), 1U);
  return model->warnings.empty() ? "" : model->warnings[0];
}

TEST(Images, ThatCannotBeRead_AreLeftOut_AndSayWhy) {
  EXPECT_EQ(warning_of(to_bytes("GIF89a")), "image 0 is neither PNG nor JPEG nor WebP; it is omitted");
  EXPECT_EQ(warning_of(ktx2),
            "image 0 is a KTX2 texture (Basis Universal), which cannot be read here; PNG, JPEG and "
            "WebP can; it is omitted");
  EXPECT_EQ(warning_of(Bytes(lossy_webp.begin(), lossy_webp.begin() + 40)),
            "image 0 is a WebP image that cannot be decoded; it is omitted");
  // VP8X with the flag of an animation.
  Bytes moving = to_bytes(std::string_view("RIFF\x16\0\0\0WEBPVP8X\x0A\0\0\0\x02\0\0\0\x01\0\0\x01\0\0", 30));
  EXPECT_EQ(warning_of(moving), "image 0 is a WebP image that moves, which no texture can; it is omitted");
}

TEST(Images, OfKtx2_ThatAFileRequires_AreAWarning) {
  GltfWriter writer = quad_with_texture(by_extension("KHR_texture_basisu", 0), {ktx2});
  writer.json["extensionsRequired"].push_back("KHR_texture_basisu");
  const auto model = writer.import();
  ASSERT_TRUE(model) << model.error().message;
  ASSERT_EQ(model->warnings.size(), 1U);
  EXPECT_NE(model->warnings[0].find("KTX2"), std::string::npos) << model->warnings[0];
  EXPECT_TRUE(model->materials[0].is_color_lost);
}

/// A JPEG up to the size of its frame, behind a comment and fill bytes.
Bytes jpeg_of(std::uint16_t width, std::uint16_t height) {
  Bytes jpeg = to_bytes(std::string_view("\xFF\xD8\xFF\xFE\0\x04hi\xFF\xFF\xFF\xC2\0\x11\x08", 15));
  for (const int side : {height, width}) {
    jpeg.push_back(static_cast<std::uint8_t>(side >> 8));
    jpeg.push_back(static_cast<std::uint8_t>(side & 0xFF));
  }
  return jpeg;
}

TEST(Images, LargerThanViewersCanShow_AreLeftOut) {
  const std::string bound = " pixels, more than 8192 along a side; it is omitted";
  EXPECT_EQ(warning_of(png_of(60'000, 60'000)), "image 0 is an image of 60000 x 60000" + bound);
  EXPECT_EQ(warning_of(png_of(8, 0xFFFFFFFF)), "image 0 is an image of 8 x 4294967295" + bound);
  EXPECT_EQ(warning_of(jpeg_of(65'535, 8)), "image 0 is an image of 65535 x 8" + bound);
  import::ImageReader reader{ImportLimits {}};
  EXPECT_TRUE(reader.read(png_of(8192, 8192)));
  EXPECT_TRUE(reader.read(jpeg_of(8192, 8192)));
}

TEST(Images, WithoutASize_AreLeftOut) {
  const std::string nothing = ", of which nothing can be shown; it is omitted";
  EXPECT_EQ(warning_of(png_of(0, 0)), "image 0 is a PNG of 0 x 0 pixels" + nothing);
  EXPECT_EQ(warning_of(png_of(8, 0)), "image 0 is a PNG of 8 x 0 pixels" + nothing);
  EXPECT_EQ(warning_of(jpeg_of(0, 8)), "image 0 is a JPEG of 0 x 8 pixels" + nothing);
  EXPECT_EQ(warning_of(to_bytes("\x89PNG, it says, and more than twenty four bytes")),
            "image 0 is a PNG without a whole header" + nothing);
  import::ImageReader reader{ImportLimits {}};
  for (const Bytes& whole : {png_of(64, 64), jpeg_of(64, 64)}) {
    EXPECT_TRUE(reader.read(whole));
    for (std::size_t size = 8; size < whole.size(); ++size)
      EXPECT_FALSE(reader.read(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)))) << size;
  }
}

TEST(Webp, ThatDeclaresMorePixelsThanAllowed_IsNotDecoded) {
  Bytes huge = lossless_webp;  // 16384 x 16384: a gigabyte
  for (std::size_t i = 0; i < 3; ++i) huge[lossless_webp_size_at + i] = 0xFF;
  huge[lossless_webp_size_at + 3] |= 0x0F;
  EXPECT_EQ(warning_of(huge), "image 0 is a WebP of 16384 x 16384, more than 16777216 pixels; it is omitted");
  ImportLimits limits;
  limits.max_image_pixels = 3;
  EXPECT_EQ(warning_of(lossless_webp, limits), "image 0 is a WebP of 2 x 2, more than 3 pixels; it is omitted");
}

TEST(Webp, AllTogether_HaveALimit) {
  ImportLimits limits;
  limits.max_decoded_pixels = 9;
  import::ImageReader reader(limits);
  EXPECT_TRUE(reader.read(lossless_webp));
  EXPECT_TRUE(reader.read(lossless_webp));
  const auto third = reader.read(lossless_webp);
  ASSERT_FALSE(third);
  EXPECT_EQ(third.error().code, ErrorCode::too_large);
  EXPECT_TRUE(reader.read(png)) << "what is not decoded does not count";
}

TEST(Webp, EveryPrefix_AndEveryChangedByte_IsAnImageOrAnError) {
  for (const Bytes& whole : {lossless_webp, lossy_webp}) {
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const Bytes prefix(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_FALSE(import::ImageReader(ImportLimits{}).read(prefix)) << size;
    }
    for (std::size_t at = 0; at < whole.size(); ++at) {
      for (const std::uint8_t value : {0x00, 0x01, 0x7F, 0x80, 0xFF}) {
        Bytes changed = whole;
        changed[at] = value;
        ImportLimits limits;
        limits.max_image_pixels = 1 << 16;  // a changed size must not make this test long
        const auto image = import::ImageReader(limits).read(changed);
        if (image) pixels_of(*image);
      }
    }
  }
}

}  // namespace
}  // namespace semblante::test
