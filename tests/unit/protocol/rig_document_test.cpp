#include "protocol/cpp/rig_document.h"

#include <functional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace semblante {
namespace {

using nlohmann::json;

FeaturePointId point(std::string_view id) { return *parse_feature_point(id); }

RigDocument sample() {
  RigDocument rig;
  rig.name = "A \"head\" / of Zoë";
  rig.mesh = {parse_sha256(std::string(64, 'a')).value(), 100, 180, 5000, {0, 1, 2, std::nullopt, 4, std::nullopt}};
  rig.weights = {parse_sha256(std::string(64, '1')).value(), 900, 12, 7, 4.5, 0.0001};
  rig.fapu.value = {0.01, 0.06, 0.04, std::nullopt, 0.05};
  rig.feature_points = {{point("2.1"), 99, {0.1F, -0.2F, 0.3F}}, {point("7.1"), std::nullopt, {0.0F, 1e-7F, -3.0F}}};
  rig.eye_pivots = {glm::vec3(0.3F, 0.0F, 0.0F), glm::vec3(-0.3F, 0.0F, 0.0F)};
  rig.head_pivot = {0.0F, -1.0F, -0.5F};
  rig.parts = {{"skin", PartRole::skin, 90, 170}, {"", PartRole::left_eye, 10, 10}};
  rig.visemes[0].name = "sil";
  for (std::size_t i = 1; i < rig.visemes.size(); ++i) {
    rig.visemes[i] = {std::to_string(i) + " viseme", {{point("2.2"), {0.0F, 0.1F, 0.0F}}, {point("8.10"), {1, 2, 3}}}};
  }
  rig.expressions[0].name = "none";
  for (std::size_t i = 1; i < rig.expressions.size(); ++i) rig.expressions[i].name = std::to_string(i) + "e";
  rig.bounds_min = {-1, -1, -1};
  rig.bounds_max = {1, 1, 1};
  RigDocument::MaterialInfo material;
  material.name = "skin";
  material.base_color = {0.8F, 0.6F, 0.5F, 1.0F};
  material.alpha_mode = RigDocument::MaterialInfo::AlphaMode::mask;
  material.base_color_image = parse_sha256(std::string(64, 'f'));
  rig.materials = {material};
  rig.images = {{parse_sha256(std::string(64, 'f')).value(), "image/png", 12345}};
  rig.warnings = {"8.1 is not marked"};
  return rig;
}

TEST(RigDocument, Read_NotJson_IsRefused) {
  for (const char* text : {"", "{", "[]", "null", "{\"format\":", "\xff\xfe"}) {
    const auto result = read_rig(text);
    ASSERT_FALSE(result.ok()) << text;
    EXPECT_EQ(result.error().code, ErrorCode::malformed) << text;
  }
}

/// Changes a member of a valid document and expects the error and its pointer.
struct ChangedRig {
  json good;
  void refused(const char* pointer, ErrorCode code, const std::function<void(json&)>& change) const {
    json changed = good;
    change(changed);
    const auto result = read_rig(changed.dump());
    ASSERT_FALSE(result.ok()) << pointer;
    EXPECT_EQ(result.error().where, pointer) << result.error().message;
    EXPECT_EQ(result.error().code, code) << pointer << ": " << result.error().message;
  }
};

TEST(RigDocument, Read_InvalidMembers_AreNamedByTheirPointer) {
  const ChangedRig rig{json::parse(write_rig(sample()))};
  rig.refused("/format", ErrorCode::malformed, [](json& j) { j["format"] = "other"; });
  rig.refused("/version", ErrorCode::unsupported, [](json& j) { j["version"] = 2; });
  rig.refused("/name", ErrorCode::malformed, [](json& j) { j["name"] = 3; });
  rig.refused("/mesh", ErrorCode::missing, [](json& j) { j.erase("mesh"); });
  rig.refused("/mesh", ErrorCode::malformed, [](json& j) { j["mesh"] = 1; });
  rig.refused("/mesh/sha256", ErrorCode::malformed, [](json& j) { j["mesh"]["sha256"] = "abc"; });
  rig.refused("/mesh/vertices", ErrorCode::out_of_range, [](json& j) { j["mesh"]["vertices"] = 0; });
  rig.refused("/mesh/vertices", ErrorCode::out_of_range, [](json& j) { j["mesh"]["vertices"] = 4000001; });
  rig.refused("/mesh/vertices", ErrorCode::malformed, [](json& j) { j["mesh"]["vertices"] = 1.5; });
  rig.refused("/mesh/triangles", ErrorCode::out_of_range, [](json& j) { j["mesh"]["triangles"] = -1; });
  rig.refused("/mesh/attributes/position", ErrorCode::missing,
              [](json& j) { j["mesh"]["attributes"]["position"] = nullptr; });
  rig.refused("/weights/bits", ErrorCode::out_of_range, [](json& j) { j["weights"]["bits"] = 17; });
  rig.refused("/fapu/MW", ErrorCode::malformed, [](json& j) { j["fapu"]["MW"] = "wide"; });
  rig.refused("/feature_points/0/vertex", ErrorCode::out_of_range,
              [](json& j) { j["feature_points"][0]["vertex"] = 100; });
  rig.refused("/feature_points/0/id", ErrorCode::invalid_argument,
              [](json& j) { j["feature_points"][0]["id"] = "2.99"; });
  rig.refused("/feature_points/1/id", ErrorCode::malformed, [](json& j) { j["feature_points"][1]["id"] = "2.1"; });
  rig.refused("/feature_points/0/position", ErrorCode::out_of_range, [](json& j) {
    j["feature_points"][0]["position"] = {1, 2};
  });
  rig.refused("/feature_points/0/position/2", ErrorCode::out_of_range,
              [](json& j) { j["feature_points"][0]["position"][2] = 1e300; });
  rig.refused("/parts/1/role", ErrorCode::invalid_argument, [](json& j) { j["parts"][1]["role"] = "hat"; });
  rig.refused("/viseme_share", ErrorCode::out_of_range, [](json& j) { j["viseme_share"] = 1.5; });
  rig.refused("/visemes", ErrorCode::out_of_range, [](json& j) { j["visemes"].erase(0); });
  rig.refused("/visemes/3/displacements/99.1", ErrorCode::invalid_argument, [](json& j) {
    j["visemes"][3]["displacements"]["99.1"] = {0, 0, 0};
  });
  rig.refused("/expressions/6/displacements/2.1/0", ErrorCode::malformed, [](json& j) {
    j["expressions"][6]["displacements"]["2.1"] = {"x", 0, 0};
  });
  rig.refused("/materials", ErrorCode::out_of_range, [](json& j) { j["materials"] = json::array(); });
  rig.refused("/materials/0/double_sided", ErrorCode::malformed,
              [](json& j) { j["materials"][0]["double_sided"] = 1; });
  rig.refused("/images/0/sha256", ErrorCode::malformed,
              [](json& j) { j["images"][0]["sha256"] = std::string(64, 'g'); });
  rig.refused("/warnings/0", ErrorCode::malformed, [](json& j) { j["warnings"][0] = 1; });
  const auto infinite = read_rig(R"({"format":1e999})");
  ASSERT_FALSE(infinite.ok());
  EXPECT_EQ(infinite.error().code, ErrorCode::not_finite);
}

TEST(RigDocument, Read_EveryMemberRemoved_IsRefusedByName) {
  const json good = json::parse(write_rig(sample()));
  for (const auto& [name, value] : good.items()) {
    json changed = good;
    changed.erase(name);
    const auto result = read_rig(changed.dump());
    ASSERT_FALSE(result.ok()) << name;
    EXPECT_EQ(result.error().code, ErrorCode::missing);
    EXPECT_EQ(result.error().where, std::string("/").append(name));
  }
}

TEST(RigDocument, RoundTrip_GivesTheSameText) {
  const std::string text = write_rig(sample());
  const auto rig = read_rig(text);
  ASSERT_TRUE(rig.ok()) << rig.error().where << " " << rig.error().message;
  EXPECT_EQ(write_rig(*rig), text);
  EXPECT_EQ(rig->feature_points[1].position, sample().feature_points[1].position);
  EXPECT_EQ(rig->visemes[3].displacements[1].by, glm::vec3(1, 2, 3));
}

TEST(RigDocument, Articulation_IsThereIfItIsNotTheUsual) {
  EXPECT_FALSE(json::parse(write_rig(sample())).contains("articulation"));
  RigDocument rig = sample();
  rig.articulation = 2.5;
  json written = json::parse(write_rig(rig));
  EXPECT_EQ(written["articulation"], 2.5);
  EXPECT_EQ(read_rig(written.dump())->articulation, 2.5);
  for (const json& wrong : {json(0.2), json(4.5), json("2"), json()}) {
    written["articulation"] = wrong;
    const auto read = read_rig(written.dump());
    ASSERT_FALSE(read.ok()) << wrong;
    EXPECT_EQ(read.error().where, "/articulation");
  }
}

RigDocument with_moving_parts() {
  RigDocument rig = sample();
  rig.irises[1] = Iris{{0.0F, 0.6F, 0.8F}, 0.1F, 0.3F, -2.0F};
  rig.tongue = Tongue{{0, 1, 2}, {1, 0, 0}, {0, 0.8F, 0.6F}, 2.0F, 2.5F};
  return rig;
}

TEST(RigDocument, MovingParts_AreThereOnlyWhereTheHeadHasThem) {
  EXPECT_FALSE(json::parse(write_rig(sample())).contains("irises"));
  EXPECT_FALSE(json::parse(write_rig(sample())).contains("tongue"));
  const std::string text = write_rig(with_moving_parts());
  const auto rig = read_rig(text);
  ASSERT_TRUE(rig.ok()) << rig.error().where << " " << rig.error().message;
  EXPECT_EQ(write_rig(*rig), text);
  EXPECT_FALSE(rig->irises[0].has_value());
  EXPECT_EQ(rig->irises[1]->axis, glm::vec3(0.0F, 0.6F, 0.8F));
  EXPECT_EQ(rig->irises[1]->bend, -2.0F);
  EXPECT_EQ(rig->tongue->half_width, 2.0F);
}

TEST(RigDocument, Read_InvalidMovingParts_AreNamedByTheirPointer) {
  const ChangedRig rig{json::parse(write_rig(with_moving_parts()))};
  rig.refused("/irises", ErrorCode::out_of_range, [](json& j) { j["irises"].erase(0); });
  rig.refused("/irises/1/axis", ErrorCode::missing, [](json& j) { j["irises"][1].erase("axis"); });
  rig.refused("/irises/1/axis", ErrorCode::out_of_range, [](json& j) { j["irises"][1]["axis"] = {0, 0, 0}; });
  rig.refused("/irises/1/pupil_radius", ErrorCode::out_of_range, [](json& j) { j["irises"][1]["pupil_radius"] = 0; });
  rig.refused("/irises/1/iris_radius", ErrorCode::out_of_range, [](json& j) { j["irises"][1]["iris_radius"] = 0.1; });
  rig.refused("/irises/1/bend", ErrorCode::malformed, [](json& j) { j["irises"][1]["bend"] = nullptr; });
  rig.refused("/tongue/left", ErrorCode::out_of_range, [](json& j) { j["tongue"]["left"] = {2, 0, 0}; });
  rig.refused("/tongue/up", ErrorCode::out_of_range, [](json& j) { j["tongue"]["up"] = {1, 0, 0}; });
  rig.refused("/tongue/half_width", ErrorCode::out_of_range, [](json& j) { j["tongue"]["half_width"] = -1; });
  rig.refused("/tongue/roll_limit", ErrorCode::out_of_range, [](json& j) { j["tongue"]["roll_limit"] = 8; });
}

RigDocument with_lids_and_companions() {
  RigDocument rig = sample();
  Lids lids;
  lids.gaze = {0.0F, 0.6F, 0.8F};
  lids.opening = 0.5F;
  lids.slit = 0.75F;
  lids.ball.fill(2.0F);
  lids.lift = 0.25F;
  rig.lids[1] = lids;
  const auto id = [](const char* name) { return *parse_feature_point(name); };
  rig.companions = {{id("2.10"), id("2.1"), 0.95F, false},
                    {id("5.1"), id("2.1"), 0.25F, false},
                    {id("5.1"), id("8.3"), 0.5F, false},
                    {id("2.3"), id("2.1"), 0.9F, true}};
  return rig;
}

TEST(RigDocument, LidsAndCompanions_AreThereOnlyWhereTheHeadHasThem) {
  for (const char* member : {"lids", "companions", "lower_lip"})
    EXPECT_FALSE(json::parse(write_rig(sample())).contains(member)) << member;
  const std::string text = write_rig(with_lids_and_companions());
  const auto rig = read_rig(text);
  ASSERT_TRUE(rig.ok()) << rig.error().where << " " << rig.error().message;
  EXPECT_EQ(write_rig(*rig), text);
  EXPECT_FALSE(rig->lids[0].has_value());
  EXPECT_EQ(rig->lids[1]->slit, 0.75F);
  EXPECT_EQ(rig->lids[1]->lift, 0.25F);
  ASSERT_EQ(rig->companions.size(), 4U);
  EXPECT_EQ(rig->companions[2].leader, *parse_feature_point("8.3"));
  EXPECT_TRUE(rig->companions[3].is_choice);
}

TEST(RigDocument, Read_InvalidLidsAndCompanions_AreNamedByTheirPointer) {
  const ChangedRig rig{json::parse(write_rig(with_lids_and_companions()))};
  rig.refused("/lids", ErrorCode::out_of_range, [](json& j) { j["lids"].erase(0); });
  rig.refused("/lids/1/gaze", ErrorCode::out_of_range, [](json& j) { j["lids"][1]["gaze"] = {0, 0, 0.8}; });
  rig.refused("/lids/1/opening", ErrorCode::out_of_range, [](json& j) { j["lids"][1]["opening"] = 0; });
  rig.refused("/lids/1/slit", ErrorCode::out_of_range, [](json& j) { j["lids"][1]["slit"] = -0.1; });
  rig.refused("/lids/1/lift", ErrorCode::out_of_range, [](json& j) { j["lids"][1]["lift"] = 1.5; });
  rig.refused("/lids/1/ball", ErrorCode::out_of_range, [](json& j) { j["lids"][1]["ball"].erase(0); });
  rig.refused("/lids/1/ball/16", ErrorCode::malformed, [](json& j) { j["lids"][1]["ball"][16] = "round"; });
  rig.refused("/companions/2.10/2.1", ErrorCode::out_of_range, [](json& j) { j["companions"]["2.10"]["2.1"] = 11; });
  rig.refused("/companions/2.15", ErrorCode::invalid_argument, [](json& j) { j["companions"]["2.15"] = {{"2.1", 1}}; });
  rig.refused("/lower_lip/2.3/jaw", ErrorCode::invalid_argument, [](json& j) { j["lower_lip"]["2.3"]["jaw"] = 1; });
}

TEST(RigDocument, Levels_AreThereOnlyWhereThereAreSeveral) {
  RigDocument rig = sample();
  EXPECT_FALSE(json::parse(write_rig(rig)).contains("levels"));
  rig.levels = {{100, 180, 5900}, {40, 70, 2000}};
  rig.lod = 1;
  const json written = json::parse(write_rig(rig));
  const auto read = read_rig(written.dump());
  ASSERT_TRUE(read.ok()) << read.error().where;
  EXPECT_EQ(read->lod, 1U);
  ASSERT_EQ(read->levels.size(), 2U);
  EXPECT_EQ(read->levels[1].vertices, 40U);
  EXPECT_EQ(read->levels[1].bytes, 2000U);

  json beyond = written;
  beyond["lod"] = 2;
  EXPECT_EQ(read_rig(beyond.dump()).error().where, "/lod");
  json unnamed = written;
  unnamed.erase("lod");
  EXPECT_EQ(read_rig(unnamed.dump()).error().where, "/lod");
  json odd = written;
  odd["levels"][1]["bytes"] = -1;
  EXPECT_EQ(read_rig(odd.dump()).error().where, "/levels/1/bytes");
}

TEST(RigDocument, Read_UnknownMembers_AreSkipped) {
  json changed = json::parse(write_rig(sample()));
  changed["levels_of_detail"] = {1, 2};
  changed["mesh"]["later"] = "x";
  EXPECT_TRUE(read_rig(changed.dump()).ok());
}

TEST(RigDocument, Write_Floats_HaveTheirShortestDigits) {
  const std::string text = write_rig(sample());
  EXPECT_NE(text.find(R"("position":[0.1,-0.2,0.3])"), std::string::npos) << text;
}

TEST(RigDocument, Write_NameThatIsNotUtf8_StillGivesJson) {
  RigDocument rig = sample();
  rig.name = "\xff\xfe";
  EXPECT_TRUE(read_rig(write_rig(rig)).ok());
}

}  // namespace
}  // namespace semblante
