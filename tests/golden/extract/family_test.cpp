// What the tests of real heads hold of extracted sets, on the heads of our own family: the morph targets of an avatar,
// and faces of one person worn by another.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/bridges/arkit.h"
#include "core/extract/extract.h"
#include "core/extract/shape.h"
#include "core/import/import.h"
#include "core/parametrize/parametrize.h"
#include "tests/golden/extract/turned_scan.h"
#include "tests/golden/extract/worn_set.h"
#include "tests/support/posed_face.h"
#include "tests/support/sample_head_model.h"
#include "tests/support/sample_shapes.h"

namespace semblante {
namespace {

using testing::RealHead;

RealHead with_weights(Model model, const FeaturePointSet& points) {
  RealHead head{std::move(model), {}, {}};
  head.surface = build_surface(head.model);
  ParametrizeOptions options;
  options.weights = WeightMethod::smooth;
  auto rig = parametrize(head.model, head.surface, points, options);
  EXPECT_TRUE(rig);
  head.rig = *std::move(rig);
  return head;
}

const RealHead& avatar() {
  static const RealHead head = [] {
    auto model = import_model(testing::sample_avatar_glb(), ModelFormat::glb);
    EXPECT_TRUE(model);
    return with_weights(*std::move(model), testing::sample_head_points({.form = SampleHeadForm::body}));
  }();
  return head;
}

std::vector<glm::vec3> target_of(const std::string& name) {
  const auto shape = shape_of_target(avatar().model, name);
  EXPECT_TRUE(shape) << name;
  return shape ? *shape : avatar().model.positions;
}

std::uint32_t vertex_of(const RealHead& head, FeaturePointId id) {
  const auto point =
      std::find_if(head.rig.points.begin(), head.rig.points.end(), [&](const FeaturePoint& p) { return p.id == id; });
  return point->vertex->value();
}

using DenseSet = std::array<float, feature_point_count * 3>;

DenseSet set_of(const std::string& target) {
  const auto extraction =
      extract_displacements(avatar().rig.points, avatar().rig.fapu, avatar().model.positions, target_of(target));
  EXPECT_TRUE(extraction) << target;
  return extraction ? to_dense(extraction->displacements) : DenseSet{};
}

float along(const DenseSet& set, std::string_view point, std::size_t axis) {
  return set[parse_feature_point(point)->value() * 3 + axis];
}

TEST(AvatarTargets, EachGivesASetThatMovesTheHeadAsTheTargetDoes) {
  ASSERT_EQ(avatar().model.examples.size(), testing::sample_avatar().targets.size());
  for (const Example& example : avatar().model.examples) {
    const auto extraction = extract_displacements(avatar().rig.points, avatar().rig.fapu, avatar().model.positions,
                                                  target_of(example.name));
    ASSERT_TRUE(extraction) << example.name << ": " << extraction.error().message;
    const NamedSet set{example.name, SetKind::expression, extraction->displacements};
    const auto in_units = to_model_units(set.view(), avatar().rig.fapu);
    EXPECT_TRUE(in_units.skipped.empty());
    for (const Displacement& d : in_units.displacements) {
      EXPECT_LT(glm::distance(d.value, example.at(vertex_of(avatar(), d.point))), 1e-6F)
          << example.name << " " << to_string(d.point);
    }
  }
}

TEST(AvatarTargets, SayWhichSideMoves) {
  const DenseSet closed = set_of("eyeBlinkLeft");
  EXPECT_LT(along(closed, "3.1", 1), -300.0F);
  EXPECT_NEAR(along(closed, "3.2", 1), 0.0F, 1.0F);
  const DenseSet smile = set_of("mouthSmileLeft");
  EXPECT_GT(along(smile, "8.3", 0), 20.0F);
  EXPECT_NEAR(along(smile, "8.4", 0), 0.0F, 1.0F);
  EXPECT_LT(along(set_of("viseme_aa"), "2.3", 1), -20.0F);
}

TEST(AvatarTargets, AreWornByTheHeadItselfAtEveryPoint) {
  for (const char* const name : {"mouthSmileLeft", "browInnerUp", "jawOpen"}) {
    const auto shape = target_of(name);
    const auto extraction =
        extract_displacements(avatar().rig.points, avatar().rig.fapu, avatar().model.positions, shape, {.least = 0.0});
    ASSERT_TRUE(extraction);
    for (const Displacement& d : to_model_units({name, extraction->displacements}, avatar().rig.fapu).displacements) {
      const std::uint32_t vertex = vertex_of(avatar(), d.point);
      EXPECT_LT(glm::distance(d.value, shape[vertex] - avatar().model.positions[vertex]), 1e-6F) << name;
    }
  }
}

TEST(AvatarTargets, OfAHeadThatMovedAreAligned) {
  // The whole body turns, so this is the motion of a scan rather than of the neck.
  for (const char* const name : {"mouthSmileLeft", "jawOpen", "noseSneerLeft"}) {
    const auto shape = target_of(name);
    const auto moved = testing::turned_scan(shape, 10.0, {0.01, -0.02, 0.0});
    const auto& rig = avatar().rig;
    const auto still = extract_displacements(rig.points, rig.fapu, avatar().model.positions, shape);
    const auto aligned = extract_displacements(rig.points, rig.fapu, avatar().model.positions, moved, {.align = true});
    ASSERT_TRUE(still);
    ASSERT_TRUE(aligned) << aligned.error().message;
    EXPECT_NEAR(aligned->removed->degrees, 10.0, 0.05) << name;
    EXPECT_LT(testing::relative_error(aligned->displacements, still->displacements), 0.02) << name;
  }
}

bench::Head family_head(const SampleHeadTraits& traits, float scale = 1.0F) {
  bench::Head head{"", testing::sample_head_model(traits), {}, testing::sample_head_points(traits)};
  for (glm::vec3& p : head.model.positions) p *= scale;
  for (FeaturePoint& p : head.points) p.position *= scale;
  head.surface = build_surface(head.model);
  return head;
}

/// Root of sum |worn - own|^2 / sum |own|^2 over the skin. Teeth and tongue go with the jaw whatever a set says.
double difference(const std::vector<glm::dvec3>& worn, const std::vector<glm::vec3>& own_face,
                  const std::vector<glm::vec3>& rest) {
  const std::size_t skin_vertices = make_sample_head().meshes.front().positions.size();
  double error = 0.0, size = 0.0;
  for (std::size_t v = 0; v < skin_vertices; ++v) {
    const glm::dvec3 own = glm::dvec3(own_face[v]) - glm::dvec3(rest[v]);
    error += glm::dot(worn[v] - own, worn[v] - own);
    size += glm::dot(own, own);
  }
  return std::sqrt(error / size);
}

// A set is in units of the face, so one taken from the sample head is on another person what that person's own face is,
// in any unit of length.
TEST(FamilyIdentity, WearsTheFacesOfTheSampleHead) {
  const bench::Head sample = family_head({});
  const bench::PosedFace sample_face(sample, WeightMethod::smooth);
  for (const float scale : {1.0F, 100.0F}) {
    const SampleHeadTraits broad{.jaw_width = 1.10, .face_length = 0.94, .nose_length = 0.85};
    const bench::Head other = family_head(broad, scale);
    const bench::PosedFace other_face(other, WeightMethod::smooth);
    const RealHead wearer = with_weights(other.model, other.points);
    for (const std::string_view name : {"jawOpen", "mouthSmileLeft", "mouthPucker", "browInnerUp", "mouthFunnel"}) {
      ArkitCoefficients coefficients{};
      coefficients.at(find_arkit(name).value()) = 0.7F;
      const semblante_frame frame = frame_from_arkit(coefficients).value().frame;
      const auto extraction = extract_displacements(sample_face.rig().points, sample_face.rig().fapu,
                                                    sample.model.positions, sample_face.pose(frame));
      ASSERT_TRUE(extraction) << name;
      const NamedSet set{std::string(name), SetKind::expression, extraction->displacements};
      const double off = difference(testing::wear(wearer, set), other_face.pose(frame), other.model.positions);
      std::printf("%-16s worn in units of %3.0f: %.3f off\n", std::string(name).c_str(), scale, off);
      EXPECT_LT(off, 0.25) << name;
    }
  }
}

}  // namespace
}  // namespace semblante
