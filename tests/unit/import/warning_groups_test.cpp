#include "core/types/warning_groups.h"

#include <gtest/gtest.h>

#include "tests/unit/import/gltf_writer.h"

namespace semblante::test {
namespace {

using Sentences = std::vector<std::string>;

TEST(WarningGroups, DifferentWarnings_StayInTheirOrder) {
  const Sentences warnings = {"no part is the left eye; FAPs 23, 25 and 27 turn nothing",
                              "no part is the right eye; FAPs 24, 26 and 28 turn nothing",
                              "vertex colours are omitted"};
  EXPECT_EQ(grouped_warnings(warnings), warnings);
  EXPECT_EQ(grouped_warnings({}), Sentences());
}

TEST(WarningGroups, ThreeThatDifferInWhatTheyName_AreOne) {
  EXPECT_EQ(
      grouped_warnings({"mesh 1 'Hat' is in no node", "the file has colours", "mesh 2 'Shoe' is in no node",
                        "mesh 14 'A 2nd shoe' is in no node"}),
      (Sentences{"3 times: mesh 1 'Hat' is in no node; likewise 2 'Shoe', 14 'A 2nd shoe'", "the file has colours"}));
  EXPECT_EQ(grouped_warnings({"points 2.1 and 2.2 are at one place", "points 2.1 and 2.3 are at one place",
                              "points 2.2 and 2.3 are at one place"}),
            (Sentences{"3 times: points 2.1 and 2.2 are at one place; likewise 2.1 2.3, 2.2 2.3"}));
  EXPECT_EQ(grouped_warnings({"/meshes/0/primitives/1 is empty", "/meshes/0/primitives/2 is empty",
                              "/meshes/3/primitives/1 is empty"}),
            (Sentences{"3 times: /meshes/0/primitives/1 is empty; likewise /meshes/0/primitives/2, "
                       "/meshes/3/primitives/1"}));
}

TEST(WarningGroups, Two_AreSaidAsTheyAre_AndManyAreCounted) {
  Sentences warnings;
  const auto image = [](int i) { return "image " + std::to_string(i) + " is empty"; };
  for (int i = 0; i < 2; ++i) warnings.push_back(image(i));
  EXPECT_EQ(grouped_warnings(warnings), warnings);
  for (int i = 2; i < 22; ++i) warnings.push_back(image(i));
  EXPECT_EQ(grouped_warnings(warnings), (Sentences{"22 times: image 0 is empty; likewise 1, 2, 3, 4, ..."}));
  EXPECT_EQ(grouped_warnings(grouped_warnings(warnings)), grouped_warnings(warnings))
      << "a second time changes nothing";
}

TEST(WarningGroups, TheSameWarning_IsSaidOnceWithItsCount) {
  EXPECT_EQ(grouped_warnings({"a line is long.", "a line is long.", "a line is long."}),
            (Sentences{"3 times: a line is long."}));
}

TEST(WarningGroups, KindsBeyondTheLimit_AreCounted) {
  WarningGroups groups(2);
  for (const char* kind : {"a", "b", "c", "d", "a", "a"}) groups.add(kind);
  EXPECT_EQ(groups.sentences(), (Sentences{"3 times: a", "b", "and 2 more warnings"}));
}

TEST(WarningGroups, AnUnclosedQuote_IsNoName) {
  EXPECT_EQ(grouped_warnings({"it's 1", "it's 2", "'s 3", "' 4"}).size(), 4U);
}

TEST(Gltf, TwentyTwoTexturesThatCannotBeRead_AreOneWarning) {
  GltfWriter writer;
  writer.primitive()["attributes"]["POSITION"] = writer.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const std::size_t view = writer.view(to_bytes("GIF89a"));
  for (int i = 0; i < 22; ++i) {
    writer.json["images"].push_back({{"bufferView", view}, {"mimeType", "image/gif"}});
    writer.json["textures"].push_back({{"source", i}});
    writer.json["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}});
  }
  const auto model = import_model(writer.glb(), ModelFormat::glb);
  ASSERT_TRUE(model) << model.error().message;
  ASSERT_EQ(model->warnings.size(), 1U);
  EXPECT_EQ(model->warnings[0].rfind("22 times: image 0 ", 0), 0U) << model->warnings[0];
}

}  // namespace
}  // namespace semblante::test
