// check_kernel_vectors golden-frames.json: every way the kernel has of moving vertices, and its normals, against the
// golden numbers, within the file's own tolerance. Needs no test framework, since it also runs on other machines.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/kernel/semblante_normals.h"
#include "tests/support/prepared_face.h"

namespace {

using nlohmann::json;

template <class T>
void flatten(const json& from, std::vector<T>& to) {
  if (from.is_array()) {
    for (const json& item : from) flatten(item, to);
  } else {
    to.push_back(from.get<T>());
  }
}

template <class T>
std::vector<T> numbers(const json& from) {
  std::vector<T> values;
  flatten(from, values);
  return values;
}

void copy(const json& from, float* to) {
  const auto values = numbers<float>(from);
  std::copy(values.begin(), values.end(), to);
}

std::vector<float> table(const json& sets) {
  std::vector<float> all(sets.size() * 84 * 3);
  for (std::size_t s = 0; s < sets.size(); ++s) {
    for (const auto& [fp, d] : sets[s].items()) copy(d, &all[(s * 84 + std::stoul(fp)) * 3]);
  }
  return all;
}

struct Checker {
  json file;
  std::vector<float> viseme, expression, rest, rest_normals, computed_at_rest, weights;
  std::vector<std::uint32_t> offsets{0}, triangles, joined, scratch;
  std::vector<std::uint8_t> points, rigid, turn;
  std::vector<semblante_companion> companions;
  semblante_rig rig{};
  semblante_face face{};
  semblante_triangles mesh{};
  double worst_position = 0.0;
  double worst_normal = 0.0;
  bool same_bits = true;

  explicit Checker(const char* name) {
    std::ifstream in(name);
    file = json::parse(in);
    const json& r = file["rig"];
    viseme = table(r["visemes"]);
    expression = table(r["expressions"]);
    rig.viseme = viseme.data();
    rig.expression = expression.data();
    copy(r["fapu"], rig.fapu);
    copy(r["eye_pivot"], &rig.eye_pivot[0][0]);
    copy(r["head_pivot"], rig.head_pivot);
    rig.viseme_share = r["viseme_share"];
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const json& iris = r["irises"][eye];
      copy(iris["axis"], rig.iris[eye].axis);
      rig.iris[eye].pupil_radius = iris["pupil_radius"];
      rig.iris[eye].iris_radius = iris["iris_radius"];
      rig.iris[eye].bend = iris["bend"];
    }
    const json& tongue = r["tongue"];
    copy(tongue["origin"], rig.tongue.origin);
    copy(tongue["left"], rig.tongue.left);
    copy(tongue["up"], rig.tongue.up);
    rig.tongue.half_width = tongue["half_width"];
    rig.tongue.roll_limit = tongue["roll_limit"];

    for (std::size_t eye = 0; eye < 2; ++eye) {
      const json& lids = r["lids"][eye];
      semblante_lids& to = rig.lids[eye];
      copy(lids["gaze"], to.gaze);
      to.slit = lids["slit"];
      to.opening = lids["opening"];
      copy(lids["gaze_share"], to.gaze_share);
      copy(lids["ball"], to.ball);
    }
    for (const auto* const list : {"companions", "lower_lip"}) {
      const auto is_choice = static_cast<std::uint8_t>(std::string(list) == "lower_lip" ? 1 : 0);
      for (const json& c : r[list]) companions.push_back({c[0], c[1], is_choice, 0, c[2]});
    }
    rig.companion = companions.data();
    rig.companion_count = static_cast<std::uint32_t>(companions.size());

    const json& f = file["face"];
    rest = numbers<float>(f["rest"]);
    rest_normals = numbers<float>(f["normals"]);
    triangles = numbers<std::uint32_t>(f["triangles"]);
    rigid = numbers<std::uint8_t>(f["rigid"]);
    turn = numbers<std::uint8_t>(f["turn"]);
    for (const json& row : f["rows"]) {
      for (const json& entry : row) {
        points.push_back(entry[0]);
        weights.push_back(entry[1]);
      }
      offsets.push_back(static_cast<std::uint32_t>(points.size()));
    }
    const auto count = static_cast<std::uint32_t>(rigid.size());
    face = {count, rest.data(), offsets.data(), points.data(), weights.data(), rigid.data(), turn.data()};
    joined.resize(count);
    scratch.resize(semblante_join_scratch(count));
    semblante_join_seams(count, rest.data(), rest_normals.data(), scratch.data(), joined.data());
    mesh = {count, static_cast<std::uint32_t>(triangles.size() / 3), triangles.data(), joined.data()};
    computed_at_rest.resize(rest.size());
    semblante_rest_normals(&mesh, rest.data(), rest_normals.data(), computed_at_rest.data());
  }

  semblante_pose pose(std::size_t index) const {
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
    semblante_rig chosen = rig;
    chosen.lip_share = file["cases"][index].value("jaw_takes_lip", false) ? 1.0F : 0.0F;
    semblante_pose p;
    semblante_evaluate(&chosen, &f, &p);
    return p;
  }

  void check(const semblante_pose& pose, const json& golden) {
    std::vector<float> positions(rest.size());
    semblante_deform(&face, &pose, positions.data());
    std::uint32_t count = 0;
    const semblante_deform_variant* const variants = semblante_deform_variants(&count);
    for (std::uint32_t v = 0; v < count; ++v) {
      for (const bool has_rig : {false, true}) {
        const semblante::testing::Prepared prepared(face, variants[v].group_size, has_rig ? &rig : nullptr);
        std::vector<float> found(rest.size());
        semblante_deform_by(&variants[v], prepared.face, &pose, found.data());
        same_bits = same_bits && std::memcmp(found.data(), positions.data(), found.size() * sizeof(float)) == 0;
      }
    }
    const auto expected = numbers<double>(golden["positions"]);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const double error = std::abs(positions[i] - expected[i]);
      worst_position = error <= worst_position ? worst_position : error;  // a NaN stays
    }
    std::vector<float> normals(rest.size());
    semblante_normals(&mesh, positions.data(), normals.data());
    semblante_turn_normals(mesh.vertex_count, rest_normals.data(), computed_at_rest.data(), normals.data());
    const auto golden_normals = numbers<double>(golden["vertex_normals"]);
    for (std::size_t i = 0; i < golden_normals.size(); i += 3) {
      double square = 0.0;  // of the chord between the two
      for (std::size_t k = 0; k < 3; ++k) square += std::pow(normals[i + k] - golden_normals[i + k], 2);
      const double degrees = 2.0 * std::asin(std::min(1.0, std::sqrt(square) / 2.0)) * 57.29577951308232;
      worst_normal = degrees <= worst_normal ? worst_normal : degrees;
    }
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  Checker checker(argv[1]);
  const json& file = checker.file;
  for (std::size_t i = 0; i < file["cases"].size(); ++i) checker.check(checker.pose(i), file["cases"][i]);
  for (const json& between : file["interpolations"]) {
    const semblante_pose a = checker.pose(between["from"]);
    const semblante_pose b = checker.pose(between["to"]);
    semblante_pose middle;
    semblante_interpolate(&a, &b, between["t"], &middle);
    checker.check(middle, between);
  }
  std::uint32_t count = 0;
  const semblante_deform_variant* const variants = semblante_deform_variants(&count);
  for (std::uint32_t v = 0; v < count; ++v) std::printf("%s ", variants[v].name);
  std::printf("over %zu frames: positions within %.2g, normals within %.2g degrees, variants %s\n",
              file["cases"].size(), checker.worst_position, checker.worst_normal,
              checker.same_bits ? "the same bits" : "DIFFER");
  return checker.worst_position <= file["tolerance"]["position"].get<double>() &&
                 checker.worst_normal <= file["tolerance"]["normal_degrees"].get<double>() && checker.same_bits
             ? 0
             : 1;
}
