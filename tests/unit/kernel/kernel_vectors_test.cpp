// The golden vectors: the native kernel gives them to the last bit (the WebAssembly module has its own test), and the
// oracle says that they are right.
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/kernel/semblante_kernel.h"
#include "tests/oracle/kernel_oracle.h"

namespace {

using nlohmann::json;

struct Vectors {
  json file;
  std::vector<float> viseme, expression, rest, weights;
  std::vector<std::uint32_t> offsets{0};
  std::vector<std::uint8_t> points, rigid;
  semblante_rig rig{};
  semblante_face face{};

  Vectors() {
    std::ifstream in(std::string(SEMBLANTE_SOURCE_DIR) + "/protocol/vectors/kernel/small-face.json");
    file = json::parse(in);
    viseme = table(file["rig"]["visemes"]);
    expression = table(file["rig"]["expressions"]);
    rig.viseme = viseme.data();
    rig.expression = expression.data();
    for (std::size_t i = 0; i < 5; ++i) rig.fapu[i] = file["rig"]["fapu"][i];
    for (std::size_t i = 0; i < 3; ++i) {
      rig.eye_pivot[0][i] = file["rig"]["eye_pivot"][0][i];
      rig.eye_pivot[1][i] = file["rig"]["eye_pivot"][1][i];
      rig.head_pivot[i] = file["rig"]["head_pivot"][i];
    }
    rig.viseme_share = file["rig"]["viseme_share"];
    for (const json& p : file["face"]["rest"]) {
      for (const json& x : p) rest.push_back(x);
    }
    for (const json& row : file["face"]["rows"]) {
      for (const json& entry : row) {
        points.push_back(entry[0]);
        weights.push_back(entry[1]);
      }
      offsets.push_back(static_cast<std::uint32_t>(points.size()));
    }
    for (const json& r : file["face"]["rigid"]) rigid.push_back(r);
    face = {static_cast<std::uint32_t>(rest.size() / 3),
            rest.data(),
            offsets.data(),
            points.data(),
            weights.data(),
            rigid.data(),
            nullptr};
  }

  static std::vector<float> table(const json& sets) {
    std::vector<float> all(sets.size() * 84 * 3);
    for (std::size_t s = 0; s < sets.size(); ++s) {
      for (const auto& [fp, d] : sets[s].items()) {
        for (std::size_t i = 0; i < 3; ++i) all[(s * 84 + std::stoul(fp)) * 3 + i] = d[i];
      }
    }
    return all;
  }

  semblante_frame frame(std::size_t index) const {
    const json& source = file["cases"][index]["frame"];
    semblante_frame f{};
    f.viseme1 = source["viseme"]["select1"];
    f.viseme2 = source["viseme"]["select2"];
    f.viseme_blend = source["viseme"]["blend"];
    f.expression1 = source["expression"]["select1"];
    f.intensity1 = source["expression"]["intensity1"];
    f.expression2 = source["expression"]["select2"];
    f.intensity2 = source["expression"]["intensity2"];
    for (const auto& [number, value] : source["faps"].items()) f.fap[std::stoul(number)] = value;
    return f;
  }

  semblante_pose pose(std::size_t index) const {
    const semblante_frame f = frame(index);
    semblante_pose p;
    semblante_evaluate(&rig, &f, &p);
    return p;
  }

  std::vector<float> deform(const semblante_pose& p) const {
    std::vector<float> positions(rest.size());
    semblante_deform(&face, &p, positions.data());
    return positions;
  }
};

TEST(KernelVectors_Frames, ComeOutToTheLastBit) {
  const Vectors vectors;
  for (std::size_t i = 0; i < vectors.file["cases"].size(); ++i) {
    const json& expected = vectors.file["cases"][i];
    const semblante_pose pose = vectors.pose(i);
    std::vector<float> displacements(84 * 3);
    for (const auto& [fp, d] : expected["displacements"].items()) {
      for (std::size_t k = 0; k < 3; ++k) displacements[std::stoul(fp) * 3 + k] = d[k];
    }
    EXPECT_EQ(std::vector<float>(pose.fp, pose.fp + 84 * 3), displacements) << expected["name"];
    EXPECT_EQ(vectors.deform(pose), expected["positions"].get<std::vector<float>>()) << expected["name"];
  }
}

TEST(KernelVectors_Interpolations, ComeOutToTheLastBit) {
  const Vectors vectors;
  for (const json& x : vectors.file["interpolations"]) {
    const semblante_pose a = vectors.pose(x["from"]);
    const semblante_pose b = vectors.pose(x["to"]);
    semblante_pose between;
    semblante_interpolate(&a, &b, x["t"], &between);
    EXPECT_EQ(vectors.deform(between), x["positions"].get<std::vector<float>>()) << x["from"] << " to " << x["to"];
  }
}

TEST(KernelVectors_Positions, AreTheOracles) {
  const Vectors vectors;
  for (std::size_t i = 0; i < vectors.file["cases"].size(); ++i) {
    const auto pose = semblante::oracle::evaluate(vectors.rig, vectors.frame(i));
    const auto literal = semblante::oracle::deform(vectors.face, vectors.rig, pose);
    const auto positions = vectors.file["cases"][i]["positions"].get<std::vector<float>>();
    for (std::size_t k = 0; k < positions.size(); ++k) {
      ASSERT_NEAR(positions[k], literal[k / 3][k % 3], 1e-5) << vectors.file["cases"][i]["name"];
    }
  }
}

}  // namespace
