#include "core/materials/painted_mouth.h"

#include <gtest/gtest.h>

#include "core/materials/materials.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

/// A strip of 6 by 1 cells; the vertices of columns 2 to 4 lie in the mouth.
class StripWithAMouth {
 public:
  StripWithAMouth() {
    model.primitives.assign(1, {"head", -1, 0, static_cast<std::uint32_t>(model.triangles.size())});
    parts[0].role = PartRole::skin;
    inside.resize(surface.vertex_count());
    for (std::size_t v = 0; v < inside.size(); ++v) inside[v] = v % 7 >= 2 && v % 7 <= 4;
  }

  /// By column: the name of the material of both its triangles.
  [[nodiscard]] std::vector<std::string> painted() {
    paint_mouth(model, surface, parts, inside);
    const MaterialAssignment assigned = assign_materials(model, surface, parts);
    std::vector<std::string> names;
    for (std::size_t t = 0; t < model.triangles.size(); t += 2) {
      EXPECT_EQ(assigned.of_triangle[t], assigned.of_triangle[t + 1]);
      names.push_back(assigned.materials[assigned.of_triangle[t]].name);
    }
    return names;
  }

  Model model = testing::make_grid(6, 1);
  Surface surface = build_surface(model);
  std::vector<Part> parts = std::vector<Part>(1);
  std::vector<bool> inside;
};

using Names = std::vector<std::string>;

TEST(PaintMouth, DividesPlainSkin_WhereAllCornersAreInside) {
  StripWithAMouth strip;
  EXPECT_EQ(strip.painted(), (Names{"skin", "skin", "mouth", "mouth", "skin", "skin"}));
  EXPECT_EQ(strip.model.primitives.size(), 3U);
  std::uint32_t next = 0;
  for (const Primitive& primitive : strip.model.primitives) {
    EXPECT_EQ(primitive.first_triangle, next);
    EXPECT_EQ(primitive.name, "head");
    next += primitive.triangle_count;
  }
  EXPECT_EQ(next, strip.model.triangles.size());
}

TEST(PaintMouth, LeavesColorsOfVertices) {
  StripWithAMouth strip;
  strip.model.colors.assign(strip.model.positions.size(), {200, 150, 120});
  strip.model.primitives[0].has_colors = true;
  EXPECT_EQ(strip.painted(), Names(6, "skin"));
}

TEST(PaintMouth, LeavesALookOfTheFile_OtherPartsAndHeadsWithoutAMouth) {
  StripWithAMouth coloured;
  coloured.model.materials.emplace_back();
  coloured.model.materials[0].name = "green";
  coloured.model.materials[0].base_color = {0.1F, 0.5F, 0.1F, 1.0F};
  coloured.model.primitives[0].material = 0;
  EXPECT_EQ(coloured.painted(), Names(6, "green"));

  StripWithAMouth teeth;
  teeth.parts[0].role = PartRole::upper_teeth;
  EXPECT_EQ(teeth.painted(), Names(6, "teeth"));

  StripWithAMouth closed;
  closed.inside.clear();
  EXPECT_EQ(closed.painted(), Names(6, "skin"));
  EXPECT_EQ(closed.model.primitives.size(), 1U);
}

}  // namespace
}  // namespace semblante
