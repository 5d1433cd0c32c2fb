// Every reader of model files takes time in proportion to the bytes of the file, whatever stands in it.

#include "tests/support/growth.h"

#include <cmath>
#include <functional>
#include <string>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

#include "core/import/displacements_file.h"
#include "core/import/feature_points_file.h"
#include "core/import/relative_path.h"
#include "tests/unit/import/test_files.h"

namespace semblante::test {
namespace {

using MakeText = std::function<std::string(std::size_t)>;
using MakeBytes = std::function<Bytes(std::size_t)>;

void expect_linear_model(const std::string& what, ModelFormat format, std::size_t most, const MakeBytes& make) {
  expect_linear(what, {.from = most / 1024 + 1, .most = most}, make,
                [&](const Bytes& bytes) { (void)import_model(bytes, format); });
}

/// A file of `begin`, `one` for each of n numbers, and `end`.
MakeText lines(const std::string& begin, const std::function<void(std::string&, std::size_t)>& one,
               const std::string& end = "") {
  return [=](std::size_t n) {
    std::string text = begin;
    for (std::size_t i = 0; i < n; ++i) one(text, i);
    return text += end;
  };
}

/// The same, of lines that do not differ.
MakeText lines(const std::string& begin, const std::string& line, const std::string& end = "") {
  return lines(
      begin, [line](std::string& text, std::size_t) { text += line; }, end);
}

void expect_linear_text(const std::string& what, ModelFormat format, std::size_t most, const MakeText& make) {
  expect_linear_model(what, format, most, [&](std::size_t n) { return to_bytes(make(n)); });
}

// ---- OBJ

const std::string quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ImportGrowth, Obj_Lines) {
  const auto obj = [](const std::string& what, const MakeText& make, std::size_t most = 400'000) {
    expect_linear_text("OBJ: " + what, ModelFormat::obj, most, make);
  };
  obj("vertices", lines("", "v 0.5 -1e-3 7\n", "f 1 2 3\n"));
  obj("faces", lines(quad, "f 1/1/1 2/1/1 3/1/1 4/1/1\n", "vt 0 0\nvn 0 0 1\n"));
  obj("faces by negative indices", lines(quad, "v 1 2 3\nf -1 -2 -3\n"));
  obj("faces before their vertices",
      lines(
          "", [](std::string& text, std::size_t i) { text += "f 1 2 " + std::to_string(i + 3) + "\nv 1 2 3\n"; },
          "v 0 0 0\nv 0 1 0\n"));
  obj("objects", lines(quad, "o x\nf 1 2 3\n"));
  obj("groups of different names",
      lines(quad, [](std::string& text, std::size_t i) { text += "g " + std::to_string(i) + "\nf 1 2 3\n"; }));
  obj("groups without faces", lines(quad + "f 1 2 3\n", "g a b c\n"));
  obj("materials by turns", lines(quad, "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n"));
  obj("materials",
      lines(quad, [](std::string& text, std::size_t i) { text += "usemtl " + std::to_string(i) + "\nf 1 2 3\n"; }),
      4000);
  obj("materials of long names",
      lines(quad,
            [](std::string& text, std::size_t i) {
              text += "usemtl " + std::string(1000, 'm') + std::to_string(i) + "\nf 1 2 3\n";
            }),
      4000);
  obj("material files", lines(quad + "f 1 2 3\n", "mtllib a.mtl\n"));
  obj("comments", lines(quad + "f 1 2 3\n", "# no more\n"));
  obj("empty lines", lines(quad + "f 1 2 3\n", "\r\n"), 4'000'000);
  obj("lines that are none", lines(quad + "f 1 2 3\n", "hello there\n"));
  obj("lines joined by backslashes", lines(quad + "f 1 2 3", " \\\n", "\n"));
  obj("faces joined by backslashes", lines(quad, "f 1 \\\n2 \\\n3\n"));
  obj("faces of two corners", lines(quad + "f 1 2 3\n", "f 1 2\n"));
  obj("numbers behind a vertex", lines(quad + "f 1 2 3\nv 0 0 0", " 7"));
  obj("digits of a number", lines(quad + "f 1 2 3\nv 0 0 0.", "7", "\n"), 8'000'000);
}

TEST(ImportGrowth, Obj_FacesOfManyCorners) {
  const auto polygon = [](const std::string& what, const std::function<double(std::size_t)>& radius) {
    // Up to 1000 corners ears are clipped in the square of their number: what a polygon may spend bounds that.
    const auto make = [&](std::size_t n) {
      std::string text;
      std::string face = "f";
      for (std::size_t i = 0; i < n; ++i) {
        const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(n);
        text.append("v ").append(std::to_string(1e4 * radius(i) * std::cos(angle)));
        text.append(" ").append(std::to_string(1e4 * radius(i) * std::sin(angle))).append(" 0\n");
        face += " " + std::to_string(i + 1);
      }
      return to_bytes(text + face + "\n");
    };
    expect_linear("OBJ: " + what, {.from = 4000, .most = 200'000}, make,
                  [](const Bytes& bytes) { (void)import_model(bytes, ModelFormat::obj); });
  };
  polygon("a star", [](std::size_t i) { return i % 2 == 0 ? 1.0 : 0.5; });
  polygon("one that crosses itself", [](std::size_t i) { return 0.1 + static_cast<double>(i * 7919 % 100) / 100.0; });
  expect_linear_text("OBJ: corners on a line", ModelFormat::obj, 400'000, [](std::size_t n) {
    std::string text = "v 0 1 0\n";
    std::string face = "f 1";
    for (std::size_t i = 0; i < n; ++i) {
      text.append("v ").append(std::to_string(i)).append(" 0 0\n");
      face.append(" ").append(std::to_string(i + 2));
    }
    return text + face + "\n";
  });
  expect_linear_text("OBJ: one corner again and again", ModelFormat::obj, 400'000, lines(quad + "f 1 2 3", " 4", "\n"));
}

// ---- PLY and STL

std::string ply_header(const std::string& format, std::size_t vertices, std::size_t faces) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(faces) +
         "\nproperty list int int vertex_indices\nend_header\n";
}

TEST(ImportGrowth, Ply) {
  const auto text = [](const std::string& what, const MakeText& make, std::size_t most = 400'000) {
    expect_linear_text("PLY: " + what, ModelFormat::ply, most, make);
  };
  text("vertices", [](std::size_t n) { return lines(ply_header("ascii", n, 1), "0.5 1e-3 -2\n", "3 0 1 2\n")(n); });
  text("faces",
       [](std::size_t n) { return lines(ply_header("ascii", 3, n) + "0 0 0\n1 0 0\n0 1 0\n", "3 0 1 2\n")(n); });
  text("one face", [](std::size_t n) {
    return lines(ply_header("ascii", 3, 1) + "0 0 0\n1 0 0\n0 1 0\n" + std::to_string(n), " 1")(n);
  });
  const auto strips = [](std::size_t items) {
    return replaced(ply_header("ascii", 3, 1), "element face", "element tristrips") + "0 0 0\n1 0 0\n0 1 0\n" +
           std::to_string(items);
  };
  text("one strip", [&](std::size_t n) { return lines(strips(3 * n), " 0 1 2", "\n")(n); });
  text("short strips", [&](std::size_t n) { return lines(strips(4 * n), " 0 1 2 -1", "\n")(n); });
  text("restarts only", [&](std::size_t n) { return lines(strips(3 + n) + " 0 1 2", " -1", "\n")(n); });
  text("faces without corners",
       [](std::size_t n) { return lines(ply_header("ascii", 3, n + 1) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "0\n")(n); });
  text("numbers on lines of their own",
       [](std::size_t n) { return lines(ply_header("ascii", n, 1), "0.5\n\n1e-3\n-2\n", "3 0 1 2\n")(n); });
  text("comments", lines("ply\nformat ascii 1.0\n", "comment no more\n",
                         "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                         "property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
  text("kinds of elements", lines("ply\nformat ascii 1.0\n", "element x 0\nproperty int y\n", "end_header\n"));
  text("properties", lines("ply\nformat ascii 1.0\nelement vertex 3\n", "property float x\n", "end_header\n"));
  text("a header without an end", lines("ply\n", "comment\n"));
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const std::string format = order == std::endian::little ? "binary_little_endian" : "binary_big_endian";
    expect_linear_model("PLY: binary", ModelFormat::ply, 400'000, [&](std::size_t n) {
      Packer packer(order);
      packer.bytes = to_bytes(ply_header(format, n, n));
      for (std::size_t i = 0; i < n; ++i) packer.put(static_cast<float>(i)).put(0.5F).put(static_cast<float>(i % 7));
      for (std::size_t i = 0; i < n; ++i) packer.put(std::int32_t{3}).put(std::int32_t{0}).put(std::int32_t{1}).put(2);
      return packer.bytes;
    });
    expect_linear_model("PLY: one binary face", ModelFormat::ply, 1'000'000, [&](std::size_t n) {
      Packer packer(order);
      packer.bytes = to_bytes(ply_header(format, 3, 1));
      for (int i = 0; i < 3; ++i) packer.put(static_cast<float>(i)).put(static_cast<float>(i % 2)).put(0.0F);
      packer.put(static_cast<std::int32_t>(n));
      for (std::size_t i = 0; i < n; ++i) packer.put(static_cast<std::int32_t>(i % 3));
      return packer.bytes;
    });
  }
}

TEST(ImportGrowth, Stl) {
  const std::string facet = "facet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  expect_linear_text("STL: equal facets", ModelFormat::stl, 100'000, lines("solid\n", facet, "endsolid\n"));
  expect_linear_text("STL: solids", ModelFormat::stl, 100'000, lines("", "solid x\n" + facet + "endsolid\n"));
  expect_linear_text("STL: different facets", ModelFormat::stl, 100'000,
                     lines(
                         "solid\n",
                         [](std::string& text, std::size_t i) {
                           text +=
                               "facet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 " + std::to_string(i) + "\nendfacet\n";
                         },
                         "endsolid\n"));
  for (const std::uint32_t step : {1U, 1U << 8U, 1U << 13U}) {
    expect_linear_model("STL: binary, step " + std::to_string(step), ModelFormat::stl, 400'000, [&](std::size_t n) {
      Packer packer;
      packer.bytes.resize(80);
      packer.put(static_cast<std::uint32_t>(n));
      for (std::uint32_t i = 0; i < n; ++i) {
        for (int k = 0; k < 3; ++k) packer.put(0.0F);
        // Bits that differ in few places, from a small number on: what a weak hash lets fall together.
        for (std::uint32_t k = 0; k < 9; ++k) packer.put(std::bit_cast<float>(0x3F000000U + (i * 9 + k) % 400 * step));
        packer.put(std::uint16_t{0});
      }
      return packer.bytes;
    });
  }
}

// ---- glTF

/// A glTF of `more` members beside asset, buffers and one accessor of three vertices in 36 bytes (POSITION).
Bytes glb_with(const std::string& more) {
  Packer packer;
  for (const float value : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) packer.put(value);
  for (int i = 0; i < 16; ++i) packer.put(i % 5 == 0 ? 1.0F : 0.0F);
  return make_glb(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":100}],)" + more + "}", packer.bytes);
}
const std::string three_vertices =
    R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":64}],)"
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}])";
const std::string triangle = R"({"attributes":{"POSITION":0}})";

/// `one` n times, between commas.
std::string list(std::size_t n, const std::function<std::string(std::size_t)>& one) {
  std::string text;
  for (std::size_t i = 0; i < n; ++i) text.append(i == 0 ? "" : ",").append(one(i));
  return text;
}
std::string list(std::size_t n, const std::string& one) {
  return list(n, [&](std::size_t) { return one; });
}

TEST(ImportGrowth, Gltf_Nodes) {
  const auto nodes = [](const std::string& what, const MakeText& make, std::size_t most = 200'000) {
    expect_linear_model("glTF: " + what, ModelFormat::glb, most, [&](std::size_t n) {
      return glb_with(three_vertices + R"(,"meshes":[{"primitives":[)" + triangle + "]}]," + make(n));
    });
  };
  nodes("a chain of nodes", [](std::size_t n) {
    return R"("nodes":[{"mesh":0},)" +
           list(n, [](std::size_t i) { return R"({"children":[)" + std::to_string(i) + "]}"; }) + "]";
  });
  nodes("a chain of nodes, from its end", [](std::size_t n) {
    return R"("scenes":[{"nodes":[0]}],"nodes":[)" +
           list(n,
                [](std::size_t i) { return R"({"rotation":[0,0,0,1],"children":[)" + std::to_string(i + 1) + "]}"; }) +
           R"(,{"mesh":0}])";
  });
  nodes("a loop of nodes", [](std::size_t n) {
    return R"("scenes":[{"nodes":[0]}],"nodes":[)" +
           list(n, [n](std::size_t i) { return R"({"children":[)" + std::to_string((i + 1) % n) + "]}"; }) + "]";
  });
  nodes("children of one node", [](std::size_t n) {
    return R"("nodes":[{"children":[)" + list(n, [](std::size_t i) { return std::to_string(i + 1); }) + "]}," +
           list(n, R"({"mesh":0})") + "]";
  });
  nodes("the same child again and again",
        [](std::size_t n) { return R"("nodes":[{"children":[)" + list(n, "1") + R"(]},{"mesh":0}])"; });
  nodes("roots", [](std::size_t n) {
    return R"("scenes":[{"nodes":[)" + list(n, [](std::size_t i) { return std::to_string(i); }) + R"(]}],"nodes":[)" +
           list(n, R"({"mesh":0})") + "]";
  });
  nodes("scenes",
        [](std::size_t n) { return R"("nodes":[{"mesh":0}],"scenes":[)" + list(n, R"({"nodes":[0]})") + "]"; });
  nodes("animations", [](std::size_t n) {
    return R"("nodes":[{"mesh":0}],"animations":[)" + list(n, R"({"channels":[{}],"samplers":[{"input":0}]})") + "]";
  });
  nodes("extensions", [](std::size_t n) {
    return R"("nodes":[{"mesh":0}],"extensionsUsed":[)" + list(n, "\"KHR_materials_unlit\"") +
           R"(],"extensionsRequired":[)" + list(n, "\"KHR_materials_unlit\"") + "]";
  });
}

TEST(ImportGrowth, Gltf_Meshes) {
  const auto model = [](const std::string& what, const MakeText& make, std::size_t most = 100'000) {
    expect_linear_model("glTF: " + what, ModelFormat::glb, most, [&](std::size_t n) { return glb_with(make(n)); });
  };
  model("primitives over one accessor",
        [](std::size_t n) { return three_vertices + R"(,"meshes":[{"primitives":[)" + list(n, triangle) + "]}]"; });
  model("meshes in nodes", [](std::size_t n) {
    return three_vertices + R"(,"meshes":[)" + list(n, R"({"primitives":[)" + triangle + "]}") + R"(],"nodes":[)" +
           list(n, [](std::size_t i) { return R"({"mesh":)" + std::to_string(i) + "}"; }) + "]";
  });
  model("accessors, views and buffers", [](std::size_t n) {
    const std::string data = R"(,{"byteLength":3,"uri":"data:;base64,AAAA"})";
    return R"("bufferViews":[)" + list(n, R"({"buffer":0,"byteLength":36})") + R"(],"accessors":[)" +
           list(n,
                [](std::size_t i) {
                  return R"({"componentType":5126,"count":3,"type":"VEC3","bufferView":)" + std::to_string(i) + "}";
                }) +
           R"(],"meshes":[{"primitives":[)" +
           list(n, [](std::size_t i) { return R"({"attributes":{"POSITION":)" + std::to_string(i) + "}}"; }) + "]}]";
  });
  model("buffers in data URIs", [](std::size_t n) {
    return R"("images":[)" + list(n, R"({"uri":"data:image/png;base64,AAAA"})") + R"(],"textures":[)" +
           list(n, [](std::size_t i) { return R"({"source":)" + std::to_string(i) + "}"; }) + R"(],"materials":[)" +
           list(std::min<std::size_t>(n, 4000),
                [](std::size_t i) { return R"({"normalTexture":{"index":)" + std::to_string(i) + "}}"; }) +
           "]," + three_vertices + R"(,"meshes":[{"primitives":[)" + triangle + "]}]";
  });
  model(
      "morph targets",
      [](std::size_t n) {
        return three_vertices + R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"targets":[)" +
               list(n, R"({"POSITION":0})") + "]}]}]";
      },
      4000);
  model("primitives with morph targets", [](std::size_t n) {
    return three_vertices + R"(,"meshes":[{"extras":{"targetNames":["a","b"]},"primitives":[)" +
           list(n, R"({"attributes":{"POSITION":0},"targets":[{"POSITION":0},{"POSITION":0}]})") + "]}]";
  });
  model("names of morph targets", [](std::size_t n) {
    return three_vertices + R"(,"meshes":[{"extras":{"targetNames":[)" + list(n, "\"a\"") + R"(]},"primitives":[)" +
           list(n, R"({"attributes":{"POSITION":0},"targets":[{"POSITION":0}]})") + "]}]";
  });
  model("points and lines", [](std::size_t n) {
    return three_vertices + R"(,"meshes":[{"primitives":[)" + list(n, R"({"mode":0,"attributes":{"POSITION":0}})") +
           "," + triangle + "]}]";
  });
}

TEST(ImportGrowth, Gltf_OneSkinOfManyMeshes) {
  // Each joint stands elsewhere, so that no matrix can stand for all.
  expect_linear_model("glTF: joints times meshes", ModelFormat::glb, 40'000, [](std::size_t n) {
    const std::string meshes = list(n, R"({"primitives":[)" + triangle + "]}");
    const std::string shown = list(n, [](std::size_t i) { return R"({"skin":0,"mesh":)" + std::to_string(i) + "}"; });
    const std::string joints =
        list(n, [](std::size_t i) { return R"({"translation":[)" + std::to_string(i) + ",0,0]}"; });
    return glb_with(three_vertices + R"(,"meshes":[)" + meshes + R"(],"nodes":[)" + shown + "," + joints +
                    R"(],"skins":[{"joints":[)" + list(n, [n](std::size_t i) { return std::to_string(n + i); }) +
                    "]}]");
  });
}

Bytes draco_grid(std::size_t triangles) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(triangles));
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  constexpr std::size_t row = 200;
  const auto corner = [](std::size_t i) {
    return std::array<float, 3>{static_cast<float>(i % row), static_cast<float>(i / row), 0.0F};
  };
  for (std::size_t t = 0; t < triangles; ++t) {
    const std::size_t at = t / 2;
    const auto a = corner(t % 2 == 0 ? at : at + row + 1);
    const auto b = corner(t % 2 == 0 ? at + 1 : at + row);
    const auto c = corner(t % 2 == 0 ? at + row : at + 1);
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(static_cast<std::uint32_t>(t)), a.data(), b.data(),
                                      c.data());
  }
  const auto mesh = builder.Finalize();
  draco::Encoder encoder;
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  return {buffer.data(), buffer.data() + buffer.size()};
}

std::string draco_json(std::size_t bytes, std::size_t primitives, std::size_t vertices) {
  return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":)" + std::to_string(bytes) +
         R"(}],"bufferViews":[{"buffer":0,"byteLength":)" + std::to_string(bytes) +
         R"(}],"accessors":[{"componentType":5126,"type":"VEC3","count":)" + std::to_string(vertices) +
         R"(}],"meshes":[{"primitives":[)" +
         list(primitives, R"({"attributes":{"POSITION":0},"extensions":{"KHR_draco_mesh_compression":)"
                          R"({"bufferView":0,"attributes":{"POSITION":0}}}})") +
         "]}]}";
}

TEST(ImportGrowth, Gltf_Draco) {
  expect_linear_model("glTF: Draco", ModelFormat::glb, 400'000, [](std::size_t n) {
    const Bytes data = draco_grid(n);
    return make_glb(draco_json(data.size(), 1, n), data);
  });
}

/// A megabyte of metadata before two triangles.
TEST(ImportGrowth, Gltf_OneDracoViewOfManyPrimitives) {
  const auto with_metadata = [](std::size_t bytes) {
    Bytes plain = quad_draco_data(true);
    Bytes data(plain.begin(), plain.begin() + 11);
    data[10] = 0x80;    // flags: has metadata
    data.push_back(0);  // of no attribute
    const auto entries = static_cast<std::uint32_t>(bytes / 3);
    for (std::uint32_t rest = entries; true; rest >>= 7U) {
      data.push_back(static_cast<std::uint8_t>((rest & 0x7FU) | (rest >= 128 ? 0x80U : 0U)));
      if (rest < 128) break;
    }
    for (std::uint32_t i = 0; i < entries; ++i) data.insert(data.end(), {0, 1, 7});  // no name, one byte: 7
    data.push_back(0);                                                               // no metadata below
    data.insert(data.end(), plain.begin() + 11, plain.end());
    return data;
  };
  const Bytes small = with_metadata(30);
  ASSERT_TRUE(import_model(make_glb(draco_json(small.size(), 1, 4), small), ModelFormat::glb));
  expect_linear_model("glTF: Draco data times primitives", ModelFormat::glb, 100'000, [&](std::size_t n) {
    const Bytes data = with_metadata(100 * n);
    return make_glb(draco_json(data.size(), n, 4), data);
  });
}

// ---- zip

TEST(ImportGrowth, Zip) {
  expect_linear_model("zip: entries", ModelFormat::gltf_zip, 4000, [](std::size_t n) {
    std::vector<std::pair<std::string, Bytes>> entries;
    for (std::size_t i = 0; i < n; ++i) entries.emplace_back("folder/" + std::to_string(i) + ".bin", Bytes(8));
    entries.emplace_back("quad.obj", quad_obj());
    return make_zip(entries);
  });
  expect_linear_model("zip: one large model", ModelFormat::gltf_zip, 400'000, [](std::size_t n) {
    return make_zip({{"quad.obj", to_bytes(lines(quad, "v 1 2 3\nf 1 2 3\n")(n))}});
  });
  expect_linear_model("zip: materials of an OBJ", ModelFormat::gltf_zip, 100'000, [](std::size_t n) {
    return make_zip({{"quad.obj", to_bytes("mtllib quad.mtl\n" + quad + "usemtl 0\nf 1 2 3\n")},
                     {"quad.mtl", to_bytes(lines("", [](std::string& text, std::size_t i) {
                        text += "newmtl " + std::to_string(i) + "\nKd 1 1 1\nmap_Kd x" + std::to_string(i) + ".png\n";
                      })(n))}});
  });
  expect_linear_model("zip: options of a map", ModelFormat::gltf_zip, 1'000'000, [](std::size_t n) {
    return make_zip({{"quad.obj", to_bytes("mtllib quad.mtl\n" + quad + "usemtl a\nf 1 2 3\n")},
                     {"quad.mtl", to_bytes(lines("newmtl a\nmap_Kd", " -s 1 1 1", " x.png\n")(n))}});
  });
  expect_linear_model("zip: bytes that look like the end of an archive", ModelFormat::gltf_zip, 2'000'000,
                      [](std::size_t n) {
                        Bytes bytes = make_zip({{"quad.obj", quad_obj()}});
                        const Bytes end = to_bytes(std::string("PK\x05\x06", 4));
                        for (std::size_t i = 0; i < n; ++i) bytes.insert(bytes.end(), end.begin(), end.end());
                        return bytes;
                      });
  expect_linear("path in a zip", {.from = 1000, .most = 4'000'000}, lines("", "a/../%41/./"),
                [](const std::string& path) { (void)import::resolve_below("folder/", path); });
}

// ---- JSON files

TEST(ImportGrowth, FeaturePointsAndDisplacements) {
  const auto points = [](const std::string& what, const MakeText& make, std::size_t most = 200'000) {
    expect_linear(what, {.from = 500, .most = most}, make, [](const std::string& text) {
      (void)parse_feature_points(text);
      (void)parse_displacements(text);
    });
  };
  points("points nobody knows", [](std::size_t n) {
    return R"({"points":{)" + list(n, [](std::size_t i) { return "\"" + std::to_string(i) + R"(":{"vertex":1})"; }) +
           "}}";
  });
  points("remarks of a point",
         [](std::size_t n) { return R"({"points":{"2.1":{"vertex":1,"remarks":[)" + list(n, "{}") + "]}}}"; });
  points("members beside the points", [](std::size_t n) {
    return R"({"points":{"2.1":{"vertex":1}},)" +
           list(n, [](std::size_t i) { return "\"" + std::to_string(i) + "\":[]"; }) + "}";
  });
  points("points that are lists", [](std::size_t n) { return R"({"points":[)" + list(n, "{}") + "]}"; });
}

}  // namespace
}  // namespace semblante::test
