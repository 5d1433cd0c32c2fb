// A clip played by a plain glTF player against the kernel on the same package.
#include "server/package/clip.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/geometry/surface.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/place_feature_points.h"
#include "protocol/cpp/kernel_values.h"
#include "protocol/cpp/rig_kernel.h"
#include "server/package/package.h"
#include "tests/oracle/real_heads.h"
#include "tests/support/sample_head_model.h"
#include "tests/unit/package/gltf_player.h"

namespace semblante {
namespace {

using testing::GltfPlayer;

/// A package, and the kernel on it.
struct TestFace {
  FacePackage package;
  PackedFace packed;
  KernelRig kernel;

  [[nodiscard]] FaceParts parts() const {
    FaceParts parts;
    parts.mesh_drc = package.mesh_drc.bytes;
    parts.weights = package.weights.bytes;
    parts.rig_json = {reinterpret_cast<const char*>(package.rig_json.bytes.data()), package.rig_json.bytes.size()};
    parts.image = [this](const Sha256& hash) -> Result<std::vector<std::uint8_t>> {
      for (const Artefact& image : package.images) {
        if (image.sha256 == hash) return image.bytes;
      }
      return Error{ErrorCode::missing, to_hex(hash), "no such image"};
    };
    return parts;
  }

  [[nodiscard]] semblante_pose pose(const FaceValues& values, std::optional<float> share = {}) const {
    semblante_rig rig = kernel.view();
    if (share) rig.viseme_share = *share;
    const semblante_frame frame = to_kernel_frame(values);
    semblante_pose out{};
    semblante_evaluate(&rig, &frame, &out);
    return out;
  }

  [[nodiscard]] std::vector<glm::vec3> deformed(const semblante_pose& pose) const {
    semblante_face face{};
    face.vertex_count = packed.table.vertex_count;
    face.rest = &packed.mesh.positions.front().x;
    face.row_offsets = packed.table.rows.offsets.data();
    face.row_points = reinterpret_cast<const std::uint8_t*>(packed.table.rows.points.data());
    face.row_weights = packed.table.rows.weights.data();
    face.rigid = packed.table.rigid.data();
    std::vector<glm::vec3> out(packed.mesh.positions.size());
    semblante_deform(&face, &pose, &out.front().x);
    return out;
  }
};

std::unique_ptr<TestFace> face_of(const Model& model, const FeaturePointSet& points, WeightMethod method) {
  const Surface surface = build_surface(model);
  ParametrizeOptions options;
  options.weights = method;
  const auto rig = parametrize(model, surface, points, options);
  if (!rig) throw std::runtime_error(rig.error().message);
  auto package = build_package(model, surface, *rig, {});
  if (!package) throw std::runtime_error(package.error().message);
  auto face = std::make_unique<TestFace>();
  face->package = std::move(*package);
  auto packed = open_package(face->parts());
  if (!packed) throw std::runtime_error(packed.error().where + packed.error().message);
  face->packed = std::move(*packed);
  face->kernel = to_kernel_rig(face->packed.rig);
  return face;
}

/// "sample paper", "sample smooth", "ict-facekit", "makehuman"; null where the real heads are not there.
const TestFace* test_face(const std::string& name) {
  static std::map<std::string, std::unique_ptr<TestFace>> made;
  const auto at = made.find(name);
  if (at != made.end()) return at->second.get();
  std::unique_ptr<TestFace>& face = made[name];
  if (name.starts_with("sample")) {
    face = face_of(testing::sample_head_model(), testing::sample_head_points(),
                   name == "sample paper" ? WeightMethod::paper : WeightMethod::smooth);
  } else if (const auto faces = oracle::faces_folder()) {
    const Model model = oracle::import_head(*faces / name / (name == "makehuman" ? "head.glb" : "neutral.obj"));
    const Surface surface = build_surface(model);
    const auto points = place_feature_points(
        model, surface, oracle::read_trusted_points(*faces / name / (name + ".fps.json")), nullptr);
    if (!points) throw std::runtime_error(points.error().message);
    face = face_of(model, *points, WeightMethod::smooth);
  }
  return face.get();
}

/// Every FAP but the roll of the tongue, each viseme and expression, Eq. 5, turns of the head; 40 ms apart.
std::vector<TimedValues> many_frames() {
  std::vector<TimedValues> frames;
  const auto add = [&](const FaceValues& values) {
    frames.push_back({static_cast<std::uint32_t>(1000 + frames.size() * 40), values});
  };
  add({});
  for (std::size_t fap = 3; fap <= 68; ++fap) {
    if (fap == 47) continue;
    FaceValues values;
    const bool turns = (fap >= 23 && fap <= 26) || (fap >= 48 && fap <= 50);
    values.fap[fap] = turns ? 20000.0 : fap == 29 || fap == 30 ? 300.0 : 250.0;
    add(values);
    if (fap == 29 || fap == 30) {
      values.fap[fap] = -300.0;
      add(values);
    }
  }
  for (std::uint8_t viseme = 1; viseme < 15; ++viseme) {
    FaceValues values;
    values.viseme = {viseme, static_cast<std::uint8_t>(15 - viseme), 40};
    values.fap[48] = viseme * 2000.0 - 15000.0;
    values.fap[49] = 30000.0 - viseme * 4000.0;
    values.fap[50] = viseme * 1500.0;
    add(values);
    values.expression = {static_cast<std::uint8_t>(1 + viseme % 6), 50, 2, 20};
    values.fap[23] = values.fap[24] = viseme * 1000.0;
    values.fap[25] = values.fap[26] = -viseme * 1500.0;
    add(values);
  }
  add({});
  return frames;
}

/// The greatest distance between what the player shows and `expected`, vertex by vertex.
double worst(const TestFace& face, const GltfPlayer& player, float seconds, const std::vector<glm::vec3>& expected,
             std::size_t sets = 99) {
  const auto shown = player.at(seconds, sets);
  double greatest = 0.0;
  std::size_t seen = 0;
  for (std::size_t p = 0; p < shown.size(); ++p) {
    const GltfPlayer::Primitive& primitive = player.primitives()[p];
    std::size_t in_primitive = 0;
    for (std::size_t v = 0; v < expected.size(); ++v) {
      if (face.packed.mesh.materials[v] != primitive.material) continue;
      EXPECT_EQ(primitive.positions.at(in_primitive), face.packed.mesh.positions[v]);
      greatest = std::max<double>(greatest, glm::distance(shown[p][in_primitive], expected[v]));
      ++in_primitive;
      ++seen;
    }
    EXPECT_EQ(in_primitive, primitive.positions.size());
  }
  EXPECT_EQ(seen, expected.size());
  return greatest;
}

float seconds_of(const std::vector<TimedValues>& frames, std::size_t i) {
  return static_cast<float>((frames[i].time - frames[0].time) / 1000.0);
}

class ClipOfHead : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    face_ = test_face(GetParam());
    if (face_ == nullptr) GTEST_SKIP() << "SEMBLANTE_FACES_DIR has no heads";
  }
  const TestFace* face_ = nullptr;
};

INSTANTIATE_TEST_SUITE_P(Heads, ClipOfHead,
                         ::testing::Values("sample paper", "sample smooth", "ict-facekit", "makehuman"),
                         [](const auto& info) {
                           std::string name = info.param;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

TEST_P(ClipOfHead, Played_AtTheFrames_IsTheKernelWithinTheStatedError) {
  const auto frames = many_frames();
  const double quantum = make_clip(face_->parts(), frames)->figures.quantum;
  for (const int influences : {4, 8, 16}) {
    ClipOptions options;
    options.influences = influences;
    const auto clip = make_clip(face_->parts(), frames, options);
    ASSERT_TRUE(clip.ok()) << clip.error().message;
    const GltfPlayer player(clip->glb);
    double greatest = 0.0;
    double first_four = 0.0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const auto exact = face_->deformed(face_->pose(frames[i].state));
      greatest = std::max(greatest, worst(*face_, player, seconds_of(frames, i), exact));
      first_four = std::max(first_four, worst(*face_, player, seconds_of(frames, i), exact, 1));
    }
    // Half a quantum for each of shift, turn of the eye and turn of the head: keys left out.
    std::printf(
        "%s, %d influences: %.2f quanta (stated %.2f), read with four %.2f (stated %.2f); %zu of %zu keys, %zu "
        "joints\n",
        GetParam(), influences, greatest / quantum, clip->figures.error / quantum, first_four / quantum,
        clip->figures.error_first_four / quantum, clip->figures.keys, clip->figures.keys_unthinned,
        clip->figures.joints);
    EXPECT_LE(greatest, clip->figures.error + 1.5 * quantum);
    EXPECT_LE(first_four, clip->figures.error_first_four + 1.5 * quantum);
    EXPECT_LT(clip->figures.error, (influences == 4 ? 200.0 : influences == 8 ? 80.0 : 40.0) * quantum);
  }
}

}  // namespace
}  // namespace semblante
