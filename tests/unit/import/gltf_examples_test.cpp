// Morph targets, kept aside as examples.
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "core/import/axes.h"
#include "tests/unit/import/gltf_writer.h"

namespace semblante::test {
namespace {

using Json = nlohmann::json;

std::size_t sparse_target(GltfWriter& writer, const std::vector<std::uint16_t>& indices,
                          const std::vector<float>& values) {
  const std::size_t index_view = writer.view(bytes_of(indices));
  const std::size_t value_view = writer.view(bytes_of(values));
  writer.json["accessors"].push_back({{"componentType", f32},
                                      {"count", 4},
                                      {"type", "VEC3"},
                                      {"sparse",
                                       {{"count", indices.size()},
                                        {"indices", {{"bufferView", index_view}, {"componentType", u16}}},
                                        {"values", {{"bufferView", value_view}}}}}});
  return writer.json["accessors"].size() - 1;
}

TEST(Examples, DenseAndSparseTargets_KeepOnlyWhatMoves_AndTheirNames) {
  GltfWriter writer;
  writer.add_quad();
  const auto dense = writer.floats({0, 0, 0, 0, 0, 0, 0.5F, 0, 0, 0, 0.25F, 0}, "VEC3");
  const auto sparse = sparse_target(writer, {1, 3}, {0, 0, 1, 0, 0, 0});
  writer.primitive()["targets"] = {{{"POSITION", dense}}, {{"POSITION", sparse}}};
  writer.json["meshes"][0]["extras"] = {{"targetNames", {"jawOpen", "blink"}}};
  const auto model = writer.import();
  ASSERT_TRUE(model) << model.error().where << " " << model.error().message;
  EXPECT_EQ(model->positions[2], glm::vec3(1, 1, 0)) << "the base shape is the neutral face";
  ASSERT_EQ(model->examples.size(), 2U);
  EXPECT_EQ(model->examples[0].name, "jawOpen");
  EXPECT_EQ(model->examples[0].vertices, (std::vector<std::uint32_t>{2, 3}));
  EXPECT_EQ(model->examples[0].at(3), glm::vec3(0, 0.25F, 0));
  EXPECT_EQ(model->examples[0].at(0), glm::vec3(0));
  EXPECT_EQ(model->examples[1].name, "blink");
  EXPECT_EQ(model->examples[1].vertices, (std::vector<std::uint32_t>{1})) << "a sparse zero is no displacement";
}

TEST(Examples, TargetThatTheFileShows_IsNamedByAWarning) {
  const auto warnings = [](auto change) {
    GltfWriter writer;
    writer.add_quad();
    const auto up = writer.floats({0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3");
    writer.primitive()["targets"] = {{{"POSITION", up}}, {{"POSITION", up}}};
    writer.json["meshes"][0]["extras"] = {{"targetNames", {"jawOpen", "Nose"}}};
    change(writer.json);
    const auto model = writer.import();
    EXPECT_TRUE(model) << model.error().where << " " << model.error().message;
    EXPECT_EQ(model->positions[2], glm::vec3(1, 1, 0));
    return model->warnings;
  };
  const std::vector<std::string> nose = {"the file shows its morph target 'Nose' at 0.7; the head is read without it"};
  EXPECT_EQ(warnings([](Json& file) { file["meshes"][0]["weights"] = {0, 0.7}; }), nose);
  EXPECT_EQ(warnings([](Json& file) { file["nodes"][0]["weights"] = {0, 0.7}; }), nose);
  for (const Json& none : {Json({0, 0}), Json({0, 0.001}), Json({"a", 0}), Json(7), Json::array()})
    EXPECT_TRUE(warnings([&](Json& file) { file["meshes"][0]["weights"] = none; }).empty()) << none;
  EXPECT_TRUE(warnings([](Json& file) {
                file["meshes"][0]["weights"] = {1, 1};
                file["nodes"][0]["weights"] = {0, 0};
              }).empty())
      << "the node's weights are those that are shown";
}

TEST(Examples, SparseRows_ReplaceDenseOnes_InAnyOrder) {
  GltfWriter writer;
  writer.add_quad();
  const auto target = sparse_target(writer, {3, 0, 3}, {9, 9, 9, 0, 0, 0, 0, 0, 2});
  writer.json["accessors"][target]["bufferView"] = writer.view(bytes_of<float>({1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0}));
  writer.primitive()["targets"] = {{{"POSITION", target}}};
  const auto model = writer.import();
  ASSERT_TRUE(model) << model.error().where << " " << model.error().message;
  const Example& example = model->examples.at(0);
  EXPECT_EQ(example.name, "target 0");
  EXPECT_EQ(example.vertices, (std::vector<std::uint32_t>{1, 3}));
  EXPECT_EQ(example.at(3), glm::vec3(0, 0, 2));
}

TEST(Examples, OfOneName_InSeveralMeshes_AreOne_MovedWithTheirNodes) {
  GltfWriter writer;
  writer.add_quad();
  const auto up = writer.floats({0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3");
  writer.primitive()["targets"] = {{{"POSITION", up}}};
  writer.primitive()["extras"] = {{"targetNames", {"smile"}}};  // where some exporters put them
  Json second = writer.json["meshes"][0];
  writer.json["meshes"].push_back(second);
  writer.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 1}, {"translation", {9, 9, 9}}, {"scale", {2, -3, 2}}}};
  writer.json["scenes"][0]["nodes"] = {0, 1};
  const auto model = writer.import();
  ASSERT_TRUE(model) << model.error().where << " " << model.error().message;
  ASSERT_EQ(model->examples.size(), 1U);
  EXPECT_EQ(model->examples[0].vertices.size(), 8U);
  EXPECT_EQ(model->examples[0].at(0), glm::vec3(0, 1, 0));
  EXPECT_EQ(model->examples[0].at(4), glm::vec3(0, -3, 0)) << "scaled, not translated";
  EXPECT_EQ(model->triangles[2], (Triangle{4, 6, 5})) << "a negative scale turns the winding";
}

TEST(Examples, FollowTheJoints_OfASkin) {
  GltfWriter writer;
  writer.add_quad();
  writer.primitive()["targets"] = {{{"POSITION", writer.floats({1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3")}}};
  writer.primitive()["attributes"]["JOINTS_0"] =
      writer.accessor(writer.view(Bytes{0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}), u8, 4, "VEC4");
  writer.primitive()["attributes"]["WEIGHTS_0"] =
      writer.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  writer.json["skins"] = {{{"joints", {1, 2}}}};
  // Joint 1 turns a quarter about z: what went along x goes along y.
  writer.json["nodes"] = {
      {{"mesh", 0}, {"skin", 0}, {"children", {1, 2}}}, {{"rotation", {0, 0, 0.70710678, 0.70710678}}}, Json::object()};
  const auto model = writer.import();
  ASSERT_TRUE(model) << model.error().where << " " << model.error().message;
  EXPECT_NEAR(model->examples.at(0).at(0).y, 1.0F, 1e-6F);
  EXPECT_NEAR(model->examples.at(0).at(0).x, 0.0F, 1e-6F);
}

TEST(Examples, TurnWithTheirModel) {
  GltfWriter writer;
  writer.add_quad();
  writer.primitive()["targets"] = {{{"POSITION", writer.floats({1, 2, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3")}}};
  auto model = writer.import();
  ASSERT_TRUE(model);
  change_axes(*model, glm::dmat3(0, 1, 0, 0, 0, 1, 1, 0, 0));  // x -> y, y -> z, z -> x
  EXPECT_EQ(model->examples.at(0).at(0), glm::vec3(3, 1, 2));
}

TEST(Examples, BeyondTheLimit_AreLeftOut_WithAWarning) {
  GltfWriter writer;
  writer.add_quad();
  const auto dense = writer.floats({1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3");
  writer.primitive()["targets"] = Json::array();
  for (int i = 0; i < 3; ++i) writer.primitive()["targets"].push_back({{"POSITION", dense}});
  ImportLimits limits;
  limits.max_example_rows = 11;  // a target of four vertices costs 5
  const auto model = writer.import(limits);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->examples.size(), 2U);
  ASSERT_EQ(model->warnings.size(), 1U);
  EXPECT_NE(model->warnings[0].find("morph targets"), std::string::npos);
}

TEST(Examples, Faults_NameTheirPlace) {
  const auto refused = [](const std::function<void(GltfWriter&)>& change) {
    GltfWriter writer;
    writer.add_quad();
    writer.primitive()["targets"] = {{{"POSITION", writer.floats({1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3")}}};
    change(writer);
    const auto model = writer.import();
    return model ? std::string("read") : model.error().where;
  };
  EXPECT_EQ(refused([](GltfWriter& w) { w.primitive()["targets"][0]["POSITION"] = 99; }),
            "/meshes/0/primitives/0/targets/0/POSITION");
  EXPECT_EQ(refused([](GltfWriter& w) {
              w.primitive()["targets"] = {{"POSITION", 1}};
            }),
            "/meshes/0/primitives/0/targets");
  EXPECT_EQ(refused([](GltfWriter& w) { w.json["accessors"][2]["type"] = "VEC2"; }), "/accessors/2/type");
  EXPECT_EQ(refused([](GltfWriter& w) {
              w.primitive()["targets"][0]["POSITION"] =
                  w.floats({std::numeric_limits<float>::quiet_NaN(), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3");
            }),
            "/accessors/3");
  // Names that are no names do no harm; a target of another size is left out.
  EXPECT_EQ(refused([](GltfWriter& w) { w.json["meshes"][0]["extras"] = {{"targetNames", {1, "x"}}}; }), "read");
  EXPECT_EQ(refused([](GltfWriter& w) { w.json["meshes"][0]["extras"] = 7; }), "read");
  EXPECT_EQ(refused([](GltfWriter& w) {
              w.primitive()["targets"][0]["POSITION"] = w.floats({1, 0, 0}, "VEC3");
            }),
            "read");
}

}  // namespace
}  // namespace semblante::test
