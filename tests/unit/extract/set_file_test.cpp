#include "core/extract/set_file.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/meshes.h"

namespace semblante {
namespace {

TEST(SetFile, ReadsASet) {
  const auto set = parse_displacement_set(
      R"({"name": "Grin", "kind": "viseme", "displacements": {"8.3": [102.4, -1, 0], "2.1": [0, -512, 3e2],
          "2.2": [0, 0, 0]}, "created": "whenever"})");
  ASSERT_TRUE(set);
  EXPECT_EQ(set->name, "Grin");
  EXPECT_EQ(set->kind, SetKind::viseme);
  ASSERT_EQ(set->displacements.size(), 2U);
  EXPECT_EQ(set->displacements[0].point, testing::fp("2.1"));
  EXPECT_EQ(set->displacements[0].value, glm::vec3(0, -512, 300));
  EXPECT_EQ(set->displacements[1].value, glm::vec3(102.4F, -1, 0));
}

TEST(SetFile, NameAndKindMayBeLeftOut) {
  const auto set = parse_displacement_set(R"({"displacements": {}})");
  ASSERT_TRUE(set);
  EXPECT_EQ(set->name, "");
  EXPECT_EQ(set->kind, SetKind::expression);
  EXPECT_TRUE(set->displacements.empty());
}

TEST(SetFile, NamesWhatIsWrong) {
  const auto where = [](std::string_view json) {
    const auto set = parse_displacement_set(json);
    return set ? "nothing" : set.error().where;
  };
  EXPECT_EQ(where("[]"), "");
  EXPECT_EQ(where("{"), "");
  EXPECT_EQ(where("{}"), "/displacements");
  EXPECT_EQ(where(R"({"displacements": []})"), "/displacements");
  EXPECT_EQ(where(R"({"displacements": null})"), "/displacements");
  EXPECT_EQ(where(R"({"displacements": {"12.1": [0, 0, 0]}})"), "/displacements/12.1");
  EXPECT_EQ(where(R"({"displacements": {"2.1": [0, 0]}})"), "/displacements/2.1");
  EXPECT_EQ(where(R"({"displacements": {"2.1": null}})"), "/displacements/2.1");
  EXPECT_EQ(where(R"({"displacements": {"2.1": [0, "1", 0]}})"), "/displacements/2.1/1");
  EXPECT_EQ(where(R"({"displacements": {"2.1": [0, 102401, 0]}})"), "/displacements/2.1");
  EXPECT_EQ(where(R"({"displacements": {"2.1": [0, 1e999, 0]}})"), "/displacements/2.1/1");
  EXPECT_EQ(where(R"({"displacements": {"2.1": [0, 1, 0], "2.1": [0, 1, 0]}})"), "/displacements/2.1");
  EXPECT_EQ(where(R"({"kind": "mood", "displacements": {}})"), "/kind");
  EXPECT_EQ(where(R"({"name": 3, "displacements": {}})"), "/name");
  EXPECT_EQ(where(R"({"name": "a\u0007", "displacements": {}})"), "/name");
  EXPECT_EQ(where(R"({"name": ")" + std::string(201, 'x') + R"(", "displacements": {}})"), "/name");
}

TEST(SetFile, WritesWhatItReadsToTheBit_AndNoLongerThanNeeded) {
  const NamedSet set{"Grin",
                     SetKind::viseme,
                     {{testing::fp("2.1"), {0.1F, -512.0F, 1.0F / 3.0F}}, {testing::fp("11.6"), {1e-7F, 99999.9F, 0}}}};
  const std::string text = write_displacement_set(set);
  EXPECT_NE(text.find("0.1,"), std::string::npos) << text;
  EXPECT_EQ(text.find("0.100000001"), std::string::npos) << text;
  const auto back = parse_displacement_set(text);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->name, set.name);
  EXPECT_EQ(back->kind, set.kind);
  ASSERT_EQ(back->displacements.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back->displacements[i].point, set.displacements[i].point);
    EXPECT_EQ(back->displacements[i].value, set.displacements[i].value);
  }
}

}  // namespace
}  // namespace semblante
