// A clip played by a plain glTF player against the kernel on the same package.
#include "protocol/clips/clip.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/geometry/surface.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/place_feature_points.h"
#include "protocol/clips/clip_tracks.h"
#include "protocol/cpp/kernel_values.h"
#include "protocol/cpp/rig_kernel.h"
#include "protocol/package/package.h"
#include "tests/oracle/real_heads.h"
#include "tests/support/sample_head_model.h"
#include "tests/unit/clips/gltf_player.h"

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
    face.turn = packed.table.turn.empty() ? nullptr : packed.table.turn.data();
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

/// "sample paper", "sample smooth", "body", "scan", "ict-facekit", "makehuman"; null where the real heads are not
/// there.
const TestFace* test_face(const std::string& name) {
  static std::map<std::string, std::unique_ptr<TestFace>> made;
  const auto at = made.find(name);
  if (at != made.end()) return at->second.get();
  std::unique_ptr<TestFace>& face = made[name];
  if (name.starts_with("sample")) {
    face = face_of(testing::sample_head_model(), testing::sample_head_points(),
                   name == "sample paper" ? WeightMethod::paper : WeightMethod::smooth);
  } else if (name == "body" || name == "scan") {
    const SampleHeadTraits traits{.form = name == "body" ? SampleHeadForm::body : SampleHeadForm::scan};
    face = face_of(testing::sample_head_model(traits), testing::sample_head_points(traits), WeightMethod::smooth);
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
                         ::testing::Values("sample paper", "sample smooth", "body", "scan", "ict-facekit", "makehuman"),
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
    // A skin blends the turns of head and body linearly, which on the neck differs from a share of the turn.
    const double of_neck = face_->packed.table.turn.empty() ? 0.0 : 900.0;
    EXPECT_LT(clip->figures.error, (of_neck + (influences == 4 ? 200.0 : influences == 8 ? 80.0 : 40.0)) * quantum);
  }
}

TEST_P(ClipOfHead, Played_BetweenTheFrames_IsTheKernelsInterpolation) {
  const auto frames = many_frames();
  const auto clip = make_clip(face_->parts(), frames);
  ASSERT_TRUE(clip.ok());
  const double quantum = clip->figures.quantum;
  const GltfPlayer player(clip->glb);
  double greatest = 0.0;
  for (std::size_t i = 0; i + 1 < frames.size(); i += 3) {
    const semblante_pose a = face_->pose(frames[i].state);
    const semblante_pose b = face_->pose(frames[i + 1].state);
    for (const float t : {0.25F, 0.5F}) {
      semblante_pose between{};
      semblante_interpolate(&a, &b, t, &between);
      const float from = seconds_of(frames, i);
      const float at = from + t * (seconds_of(frames, i + 1) - from);
      greatest = std::max(greatest, worst(*face_, player, at, face_->deformed(between)));
    }
  }
  // As at the frames; turns by slerp there and by nlerp here differ by 0.03 degrees for a step of 30, in steps of up to
  // 0.3 rad about as little as a quarter of that: 1e-4 of the head's size.
  EXPECT_LE(greatest, clip->figures.error + 1.5 * quantum + 2.0 * quantum);
}

TEST_P(ClipOfHead, Shares_SumToOneExactly_AndNameJointsOnce) {
  for (const int influences : {4, 8, 16}) {
    ClipOptions options;
    options.influences = influences;
    const auto face = make_skinned_face(face_->parts(), options);
    ASSERT_TRUE(face.ok());
    const GltfPlayer player(face->glb);
    EXPECT_EQ(player.animation_count(), 0U);
    for (const GltfPlayer::Primitive& primitive : player.primitives()) {
      EXPECT_LE(primitive.sets * 4, static_cast<std::size_t>(influences));
      const std::size_t width = primitive.sets * 4;
      for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
        std::uint32_t sum = 0;
        std::set<std::uint32_t> joints;
        for (std::size_t i = v * width; i < (v + 1) * width; ++i) {
          sum += primitive.weights[i];
          if (primitive.weights[i] > 0) {
            EXPECT_TRUE(joints.insert(primitive.joints[i]).second);
          } else {
            EXPECT_EQ(primitive.joints[i], 0U);
          }
          if (i % width > 0) {
            EXPECT_LE(primitive.weights[i], primitive.weights[i - 1]);
          }
        }
        ASSERT_EQ(sum, 65535U) << v;
      }
    }
    // At rest every vertex is where it was, but for what float matrices lose.
    EXPECT_LT(worst(*face_, player, 0.0F, face_->packed.mesh.positions), 0.2 * face->figures.quantum);
  }
}

const TestFace& sample() { return *test_face("sample smooth"); }

std::vector<TimedValues> jaw_frames(std::initializer_list<std::pair<std::uint32_t, double>> keys) {
  std::vector<TimedValues> frames;
  for (const auto& [time, value] : keys) {
    frames.push_back({time, {}});
    frames.back().state.fap[3] = value;
  }
  return frames;
}

TEST(Clip, OfFewFrames_HasOnlyTheChannelsThatMove_AndTheirLength) {
  // A line: its middle is left out. 2.1 moves, alone and for the tongue twice as far; the head's turn marks the length.
  const auto line = make_clip(sample().parts(), jaw_frames({{500, 0}, {600, 100}, {700, 200}}));
  ASSERT_TRUE(line.ok());
  const GltfPlayer player(line->glb);
  // The chin and the cheeks follow the jaw: seven companions.
  EXPECT_EQ(player.channel_count(), 10U);
  EXPECT_EQ(line->figures.keys, 20U);
  EXPECT_EQ(line->figures.keys_unthinned, 30U);
  EXPECT_FLOAT_EQ(player.duration(), 0.2F);
  EXPECT_NE(player.extras().find("\"keys\":20"), std::string::npos) << player.extras();

  const auto bent = make_clip(sample().parts(), jaw_frames({{0, 0}, {100, 180}, {200, 200}}));
  EXPECT_EQ(bent->figures.keys, 29U);

  // Still, but not neutral: one key a joint that stands elsewhere, and still as long as it was.
  const auto still = make_clip(sample().parts(), jaw_frames({{0, 200}, {100, 200}, {900, 200}}));
  const GltfPlayer held(still->glb);
  EXPECT_EQ(still->figures.keys, 11U);
  EXPECT_FLOAT_EQ(held.duration(), 0.9F);
  EXPECT_LE(worst(sample(), held, 0.5F, sample().deformed(sample().pose(jaw_frames({{0, 200}})[0].state))),
            still->figures.error + 1.5 * still->figures.quantum);

  const auto one = make_clip(sample().parts(), jaw_frames({{40, 0}}));
  ASSERT_TRUE(one.ok());
  EXPECT_EQ(GltfPlayer(one->glb).duration(), 0.0F);
}

TEST(Clip, OfFramesAtOneTime_TheLastCounts) {
  const auto clip = make_clip(sample().parts(), jaw_frames({{0, 0}, {100, 50}, {100, 200}, {200, 0}}));
  ASSERT_TRUE(clip.ok());
  EXPECT_LE(
      worst(sample(), GltfPlayer(clip->glb), 0.1F, sample().deformed(sample().pose(jaw_frames({{0, 200}})[0].state))),
      clip->figures.error + 1.5 * clip->figures.quantum);
}

TEST(Clip, OfARolledTongue_SaysWhatIsMissing) {
  auto frames = jaw_frames({{0, 0}, {100, 0}});
  frames[1].state.fap[47] = 20000.0;
  const auto clip = make_clip(sample().parts(), frames);
  ASSERT_TRUE(clip.ok());
  ASSERT_EQ(clip->warnings.size(), 1U);
  EXPECT_GT(clip->figures.error_tongue_roll, 0.0);
  EXPECT_NE(GltfPlayer(clip->glb).extras().find("FAP 47"), std::string::npos);
}

TEST(Clip, WithAVisemeShareOfItsOwn_FollowsIt) {
  std::vector<TimedValues> frames(2);
  frames[1].time = 40;
  frames[1].state.viseme = {10, 0, 63};
  frames[1].state.expression = {1, 63, 0, 0};
  ClipOptions options;
  options.viseme_share = 0.25F;
  const auto clip = make_clip(sample().parts(), frames, options);
  ASSERT_TRUE(clip.ok());
  const GltfPlayer player(clip->glb);
  const double allowed = clip->figures.error + 1.5 * clip->figures.quantum;
  EXPECT_LE(worst(sample(), player, 0.04F, sample().deformed(sample().pose(frames[1].state, 0.25F))), allowed);
  EXPECT_GT(worst(sample(), player, 0.04F, sample().deformed(sample().pose(frames[1].state))), allowed);
}

TEST(Clip, OfWhatCannotBeOne_IsRefusedWithItsPlace) {
  const auto refusal = [](std::span<const TimedValues> frames, const ClipOptions& options = {}) {
    const auto clip = make_clip(sample().parts(), frames, options);
    return clip ? "made" : clip.error().where + ": " + clip.error().message;
  };
  EXPECT_EQ(refusal({}), "/frames: there is no frame to make a clip of");
  EXPECT_EQ(refusal(jaw_frames({{10, 0}, {5, 0}})), "/frames/1/time: falls");
  EXPECT_EQ(refusal(jaw_frames({{0, 0}, {max_clip_time + 1, 0}})), "/frames/1/time: a clip lasts four hours at most");
  EXPECT_EQ(refusal(jaw_frames({{0, 0}, {1, 1e300}})), "/frames/1/faps/3: is no number that single precision can hold");
  EXPECT_EQ(refusal(jaw_frames({{0, 0}, {1, std::nan("")}})),
            "/frames/1/faps/3: is no number that single precision can hold");
  ClipOptions options;
  options.influences = 6;
  EXPECT_EQ(refusal(jaw_frames({{0, 0}}), options), "influences: are 4, 8, 12 or 16");
  options = {};
  options.viseme_share = 1.5F;
  EXPECT_EQ(refusal(jaw_frames({{0, 0}}), options), "viseme_share: is 0 to 1");
  const std::vector<TimedValues> many(max_clip_frames + 1);
  EXPECT_EQ(refusal(many), "/frames: a clip has at most 1000000 frames");
}

TEST(OpenPackage, OfPartsThatDoNotFit_SaysWhich) {
  const auto where = [](const FaceParts& parts) {
    const auto face = open_package(parts);
    return face ? "opened" : face.error().where;
  };
  FaceParts parts = sample().parts();
  EXPECT_EQ(where(parts), "opened");
  parts.mesh_drc = parts.mesh_drc.first(100);
  EXPECT_EQ(where(parts), "mesh.drc");
  parts = sample().parts();
  parts.weights = parts.weights.first(60);
  EXPECT_TRUE(where(parts).starts_with("weights")) << where(parts);
  parts = sample().parts();
  parts.rig_json = parts.rig_json.substr(0, parts.rig_json.size() / 2);
  EXPECT_TRUE(where(parts).starts_with("rig.json")) << where(parts);
  const TestFace& other = *test_face("sample paper");
  parts = sample().parts();
  parts.weights = other.package.weights.bytes;  // of the same mesh: they fit
  EXPECT_EQ(where(parts), "opened");
  // Any flipped byte of the mesh is another mesh.
  std::vector<std::uint8_t> mesh = sample().package.mesh_drc.bytes;
  for (std::size_t i = 0; i < mesh.size(); i += 997) {
    mesh[i] ^= 0x10U;
    parts.mesh_drc = mesh;
    EXPECT_EQ(where(parts), "mesh.drc");
    mesh[i] ^= 0x10U;
  }
}

TEST(VectorTrack, KeepsWhatALineDoesNotGive_WithinTheTolerance) {
  std::vector<std::pair<float, glm::vec3>> came;
  for (int i = 0; i < 2000; ++i) {
    const float t = static_cast<float>(i) * 0.04F;
    came.emplace_back(t,
                      glm::vec3(std::sin(0.3F * t), i < 500 ? 0.0F : std::cos(0.5F * t), i % 400 < 200 ? 1.0F : 0.0F));
  }
  const double tolerance = 1e-3;
  VectorTrack track(tolerance);
  for (const auto& [t, value] : came) track.push(t, value);
  track.finish();
  const auto& times = track.times();
  EXPECT_LT(times.size(), came.size() / 3);
  EXPECT_EQ(times.front(), came.front().first);
  EXPECT_EQ(times.back(), came.back().first);
  std::size_t next = 1;
  for (const auto& [t, value] : came) {
    while (next + 1 < times.size() && times[next] < t) ++next;
    const double share =
        (static_cast<double>(t) - times[next - 1]) / (static_cast<double>(times[next]) - times[next - 1]);
    const glm::dvec3 given = glm::mix(glm::dvec3(track.values()[next - 1]), glm::dvec3(track.values()[next]), share);
    EXPECT_LE(glm::distance(given, glm::dvec3(value)), tolerance * 1.001) << t;
  }
}

TEST(TurnTrack, KeepsWhatAnArcDoesNotGive_AndGoesTheShortWay) {
  const auto turn = [](float angle) { return glm::angleAxis(angle, glm::vec3(0.0F, 1.0F, 0.0F)); };
  TurnTrack even(1e-4);
  for (int i = 0; i <= 60; ++i) even.push(static_cast<float>(i), (i % 2 == 0 ? 1.0F : -1.0F) * turn(0.05F * i));
  even.finish();
  EXPECT_EQ(even.times().size(), 2U);  // an even turn is one arc, whatever the signs

  const double tolerance = 1e-3;
  TurnTrack track(tolerance);
  for (int i = 0; i < 500; ++i) track.push(static_cast<float>(i), turn(std::sin(0.01F * static_cast<float>(i))));
  track.finish();
  EXPECT_LT(track.times().size(), 150U);
  std::size_t next = 1;
  for (int i = 0; i < 500; ++i) {
    while (next + 1 < track.times().size() && track.times()[next] < static_cast<float>(i)) ++next;
    EXPECT_GE(glm::dot(track.values()[next - 1], track.values()[next]), 0.0F);
    const float share =
        (static_cast<float>(i) - track.times()[next - 1]) / (track.times()[next] - track.times()[next - 1]);
    const glm::quat given = glm::slerp(track.values()[next - 1], track.values()[next], share);
    const double off = glm::angle(glm::conjugate(given) * turn(std::sin(0.01F * static_cast<float>(i))));
    EXPECT_LE(std::min(off, 2.0 * glm::pi<double>() - off), tolerance + 5e-4)
        << i;  // glm::angle is that coarse in floats
  }
  EXPECT_LE(track.times().back(), 499.0F);
}

}  // namespace
}  // namespace semblante
