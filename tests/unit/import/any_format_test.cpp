// What holds for every format: the quad comes out whole, and no damage to a file gets past the readers.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "core/types/letter_case.h"
#include "tests/unit/import/test_files.h"

namespace semblante::test {
namespace {

/// The promises of Model, checked from outside.
void expect_sound(const Model& model, const std::string& what) {
  ASSERT_FALSE(model.triangles.empty()) << what;
  for (const glm::vec3& p : model.positions) {
    ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << what;
  }
  for (const Triangle& t : model.triangles) {
    ASSERT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) << what;
    for (const std::uint32_t index : t) ASSERT_LT(index, model.positions.size()) << what;
  }
  const auto expect_corners = [&](const std::vector<Triangle>& corners, std::size_t count) {
    ASSERT_TRUE(corners.empty() || corners.size() == model.triangles.size()) << what;
    ASSERT_EQ(corners.empty(), count == 0) << what;
    for (const Triangle& t : corners) {
      for (const std::uint32_t index : t) ASSERT_TRUE(index == Model::no_index || index < count) << what;
    }
  };
  expect_corners(model.uv_triangles, model.uvs.size());
  expect_corners(model.normal_triangles, model.normals.size());
  for (const Triangle& t : model.normal_triangles) {
    for (const std::uint32_t index : t) {
      if (index == Model::no_index) continue;
      const glm::vec3& n = model.normals[index];
      ASSERT_NEAR(std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z), 1.0F, 1e-5F) << what;
    }
  }
  std::uint32_t covered = 0;
  for (const Primitive& primitive : model.primitives) {
    ASSERT_EQ(primitive.first_triangle, covered) << what;
    ASSERT_LT(primitive.material, static_cast<int>(model.materials.size())) << what;
    covered += primitive.triangle_count;
  }
  ASSERT_EQ(covered, model.triangles.size()) << what;
  for (const Material& material : model.materials) {
    ASSERT_LT(material.base_color_image, static_cast<int>(model.images.size())) << what;
    ASSERT_LT(material.normal_image, static_cast<int>(model.images.size())) << what;
  }
}

TEST(AnyFormat, Quad_HasFourVerticesAndTwoTriangles_InEveryFormat) {
  for (const NamedFile& file : all_quads()) {
    const auto model = import_model(file.bytes, file.format);
    ASSERT_TRUE(model) << file.name << ": " << model.error().where << ": " << model.error().message;
    expect_sound(*model, file.name);
    EXPECT_EQ(model->positions.size(), 4U) << file.name;
    EXPECT_EQ(model->triangles.size(), 2U) << file.name;
    glm::vec3 sum(0.0F);
    for (const glm::vec3& p : model->positions) sum += p;
    // Draco quantizes to 11 bits or so of the box; the others are exact.
    EXPECT_NEAR(sum.x, 2.0F, 1e-3F) << file.name;
    EXPECT_NEAR(sum.y, 2.0F, 1e-3F) << file.name;
    EXPECT_NEAR(sum.z, 0.0F, 1e-3F) << file.name;
  }
}

TEST(AnyFormat, Detection_NeedsNoName_WhereTheBytesSpeak) {
  for (const NamedFile& file : all_quads()) {
    EXPECT_EQ(detect_format(file.bytes, ""), file.format) << file.name;
    EXPECT_EQ(detect_format(file.bytes, "wrong.txt"), file.format) << file.name;
  }
  EXPECT_EQ(detect_format(to_bytes(quad_gltf_json()), "x"), ModelFormat::gltf);
  EXPECT_EQ(detect_format(to_bytes("\xEF\xBB\xBF\n  { }"), ""), ModelFormat::gltf);
  EXPECT_EQ(detect_format(to_bytes("hello"), "head.OBJ"), ModelFormat::obj);
  EXPECT_EQ(detect_format(to_bytes("hello"), "head.txt"), std::nullopt);
  EXPECT_EQ(detect_format({}, ""), std::nullopt);
  EXPECT_EQ(detect_format({}, "head.glb"), ModelFormat::glb);
}

TEST(AnyFormat, WhatPeopleSendInPlaceOfAModel_IsCalledByItsName) {
  const auto words = [](std::string_view text, std::string_view name) {
    const auto format = format_of(to_bytes(text), name);
    return format ? std::string(to_string(*format)) : format.error().message;
  };
  const std::string none_of = ", none of GLB, VRM, glTF, OBJ, PLY, STL, ZIP";
  const std::string page = "the file is a web page, not a model";
  EXPECT_EQ(words(std::string_view("Kaydara FBX Binary  \0\x1A", 22), "a.fbx"),
            "the format of the file is FBX" + none_of);
  EXPECT_EQ(words("; FBX 7.3.0 project file\nv 1\n", "a.fbx"), "the format of the file is FBX" + none_of);
  EXPECT_EQ(words("#usda 1.0\n", ""), "the format of the file is USD" + none_of);
  EXPECT_EQ(words("\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"x\">", ""),
            "the format of the file is COLLADA" + none_of);
  EXPECT_EQ(words(std::string_view("MM\x0A\0\0\0abcd", 10), "x"), "the format of the file is 3DS" + none_of);
  EXPECT_EQ(words("Rar!\x1A\x07", "a.obj"), "the file is packed (RAR)");
  EXPECT_EQ(words("\x89PNG\r\n", "a.obj"), "the file is a picture (PNG), not a model");
  EXPECT_EQ(words("\n <!DOCTYPE html><title>404</title>", "head.glb"), page) << "a download that failed";
  EXPECT_EQ(words("version https://git-lfs.github.com/spec/v1\noid", "head.glb"),
            "the file is a pointer of Git LFS in place of the model");
  EXPECT_EQ(words("<html>", ""), page);
  EXPECT_EQ(words("MM is a name", "x"), "the file is none of GLB, VRM, glTF, OBJ, PLY, STL, ZIP")
      << "no 3DS by its size";
  EXPECT_EQ(words("# FBX to OBJ\nv 0 0 0\n", ""), "obj");
  for (const NamedFile& file : all_quads()) EXPECT_TRUE(format_of(file.bytes, file.name)) << file.name;
}

TEST(AnyFormat, WhatPeopleSendInPlaceOfAModel_HasWhatHelps) {
  const auto advice = [](std::string_view text) {
    const auto format = format_of(to_bytes(text), "head.glb.txt");
    return format ? std::nullopt : format.error().advice;
  };
  EXPECT_EQ(advice("Kaydara FBX Binary  "), Advice::export_as_glb);
  EXPECT_EQ(advice("<COLLADA xmlns=\"x\">"), Advice::export_as_glb);
  EXPECT_EQ(advice("Rar!\x1A\x07"), Advice::unpack);
  EXPECT_EQ(advice("\x89PNG\r\n"), Advice::choose_model);
  EXPECT_EQ(advice("<!DOCTYPE html>"), Advice::download_model);
  EXPECT_EQ(advice("version https://git-lfs.github.com/spec/v1\noid"), Advice::fetch_from_lfs);
  EXPECT_EQ(advice("of no known format"), Advice::export_as_glb);
  const auto too_large = import_model(to_bytes("v 0 0 0\n"), ModelFormat::obj, {.max_file_bytes = 4});
  EXPECT_EQ(too_large.error().advice, Advice::reduce_model);
}

TEST(AnyFormat, GltfWithFilesBesideIt_AloneHasWhatHelps) {
  const auto model =
      import_model(to_bytes(R"({"asset": {"version": "2.0"}, "buffers": [{"uri": "a.bin", "byteLength": 4}],
    "bufferViews": [{"buffer": 0, "byteLength": 4}], "accessors": [{"bufferView": 0, "componentType": 5126, "count": 1,
    "type": "VEC3"}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": [{"mesh": 0}],
    "scenes": [{"nodes": [0]}]})"),
                   ModelFormat::gltf);
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().where, "/buffers/0/uri");
  EXPECT_EQ(model.error().message, "refers to 'a.bin', which is another file");
  EXPECT_EQ(model.error().advice, Advice::send_all_files);
}

/// A scan in the coordinates of a map.
TEST(AnyFormat, FarFromTheOrigin_TheLossOfItsShape_IsToldOnImport) {
  const auto warnings = [](double away, double size) {
    std::string obj;
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
      obj += "v " + std::to_string(away + size * x) + " " + std::to_string(size * y) + " 0\n";
    const auto model = import_model(to_bytes(obj + "f 1 2 3 4\n"), ModelFormat::obj);
    return model ? model->warnings : std::vector<std::string>{model.error().message};
  };
  const auto far = warnings(500000.0, 0.25);
  ASSERT_EQ(far.size(), 1U);
  EXPECT_EQ(far.front(),
            "the model is so far from the origin that its coordinates are rounded to 0.0312, and it is only 0.354 "
            "large: move it to the origin before the export");
  EXPECT_TRUE(warnings(1000.0, 0.25).empty()) << "a tenth of a millimetre";
  EXPECT_TRUE(warnings(0.0, 0.25).empty());
  EXPECT_TRUE(warnings(1e7, 1e6).empty());
}

TEST(ModelFormats, EveryFormat_HasAnEnding_AndItsName) {
  for (const NamedFile& file : all_quads()) EXPECT_EQ(parse_model_format(to_string(file.format)), file.format);
  for (const auto& [format, name] : model_formats) {
    EXPECT_EQ(to_string(format), name);
    EXPECT_EQ(parse_model_format(name), format);
    EXPECT_NE(std::ranges::count(model_files, format, &ModelFile::format), 0) << name;
  }
  EXPECT_EQ(parse_model_format(""), std::nullopt);
  EXPECT_EQ(format_of_name("Ana.of.1.VRM"), ModelFormat::glb);
  EXPECT_EQ(format_of_name("head.fbx"), std::nullopt);
}

/// Texts for people name every format: README.md of the project and of core/import.
TEST(ModelFormats, ReadMes_NameEach) {
  for (const char* path : {"/README.md", "/core/import/README.md"}) {
    std::ifstream file(std::string(SEMBLANTE_SOURCE_DIR) + path);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (const ModelFile& format : model_files) {
      const std::string lower = lower_case(format.title);
      EXPECT_TRUE(text.find(format.title) != std::string::npos || text.find(lower) != std::string::npos)
          << path << " does not name " << format.title;
    }
  }
}

TEST(AnyFormat, EmptyFile_IsRefused_InEveryFormat) {
  for (const auto& [format, name] : model_formats) {
    EXPECT_FALSE(import_model({}, format)) << name;
    EXPECT_FALSE(import_model(Bytes{0}, format)) << name;
    EXPECT_FALSE(import_model(Bytes(1000, 0xFF), format)) << name;
  }
}

TEST(AnyFormat, Limits_AreKept_InEveryFormat) {
  for (const NamedFile& file : all_quads()) {
    ImportLimits limits;
    limits.max_vertices = 3;
    auto model = import_model(file.bytes, file.format, limits);
    EXPECT_FALSE(model) << file.name;
    limits = {};
    limits.max_triangles = 1;
    model = import_model(file.bytes, file.format, limits);
    ASSERT_FALSE(model) << file.name;
    EXPECT_EQ(static_cast<int>(model.error().code), static_cast<int>(ErrorCode::too_large)) << file.name;
    limits = {};
    limits.max_file_bytes = file.bytes.size() - 1;
    model = import_model(file.bytes, file.format, limits);
    ASSERT_FALSE(model) << file.name;
    EXPECT_EQ(static_cast<int>(model.error().code), static_cast<int>(ErrorCode::too_large)) << file.name;
  }
}

TEST(AnyFormat, EveryPrefix_IsAModelOrAnError_NeverACrash) {
  for (const NamedFile& file : all_quads()) {
    for (std::size_t size = 0; size < file.bytes.size(); ++size) {
      // A copy of exactly this size, so that a read past its end is one past an allocation.
      const Bytes prefix(file.bytes.begin(), file.bytes.begin() + static_cast<std::ptrdiff_t>(size));
      const auto model = import_model(prefix, file.format);
      if (model) expect_sound(*model, file.name + " cut at " + std::to_string(size));
      const bool is_text = file.format == ModelFormat::obj || file.name == "ply_text" || file.name == "ply_strips" ||
                           file.name == "stl_text";
      // A text may lose its last line end, or the tail of a number, and say something else that is valid.
      if (!is_text) {
        EXPECT_FALSE(model) << file.name << " cut at " << size;
      }
    }
  }
}

TEST(AnyFormat, EveryChangedByte_IsAModelOrAnError_NeverACrash) {
  for (const NamedFile& file : all_quads()) {
    Bytes bytes = file.bytes;
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      const std::uint8_t kept = bytes[at];
      for (const unsigned flip : {0x01U, 0x02U, 0x04U, 0x08U, 0x10U, 0x20U, 0x40U, 0x80U, 0xFFU}) {
        bytes[at] = static_cast<std::uint8_t>(kept ^ flip);
        const auto model = import_model(bytes, file.format);
        if (model) expect_sound(*model, file.name + " changed at " + std::to_string(at));
      }
      bytes[at] = kept;
    }
  }
}

}  // namespace
}  // namespace semblante::test
