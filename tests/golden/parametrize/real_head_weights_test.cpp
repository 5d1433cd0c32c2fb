// The fast parametrization against the literal oracle, on heads made by others and on our own family.

#include <cmath>
#include <ctime>
#include <string>

#include <gtest/gtest.h>

#include "core/geometry/surface.h"
#include "core/import/import.h"
#include "core/parametrize/influence_regions.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/place_feature_points.h"
#include "core/parametrize/point_distances.h"
#include "deploy/sample_head/write_sample_head.h"
#include "tests/oracle/literal_weights.h"
#include "tests/oracle/real_heads.h"
#include "tests/support/sample_head_model.h"
#include "tests/support/sample_obj.h"

namespace semblante {
namespace {

constexpr double weight_tolerance = 1e-9;

oracle::Mesh as_oracle_mesh(const Model& model) {
  oracle::Mesh mesh;
  for (const glm::vec3& p : model.positions) mesh.positions.push_back({p.x, p.y, p.z});
  mesh.triangles.assign(model.triangles.begin(), model.triangles.end());
  return mesh;
}

oracle::PointName as_oracle_name(FeaturePointId id) { return {group_of(id), number_of(id)}; }

struct HeadFile {
  const char* folder;
  const char* model;
  const char* points;
  const char* triangles;  ///< the file that has the triangles, where `model` holds only vertices
};

std::ostream& operator<<(std::ostream& out, const HeadFile& head) { return out << head.folder << "/" << head.model; }

class WeightsOfHead : public ::testing::Test {
 protected:
  /// Parametrizes the head, with the points that `place` finds on its surface.
  template <class Place>
  void make(Model model, Place place) {
    model_ = std::move(model);
    const std::clock_t before = std::clock();
    surface_ = build_surface(model_);
    points_ = place();
    auto rig = parametrize(model_, surface_, points_);
    ASSERT_TRUE(rig);
    rig_ = *std::move(rig);
    seconds_ = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    for (const FeaturePoint& p : points_) {
      if (p.vertex) marked_[as_oracle_name(p.id)] = p.vertex->value();
    }
  }

  void expect_those_of_the_literal_oracle() const;

  Model model_;
  Surface surface_;
  FeaturePointSet points_;
  Rig rig_;
  double seconds_ = 0.0;  ///< of processor time
  std::map<oracle::PointName, std::uint32_t> marked_;
};

void WeightsOfHead::expect_those_of_the_literal_oracle() const {
  const oracle::LiteralResult expected = oracle::literal_weights(as_oracle_mesh(model_), marked_);

  for (std::uint32_t v = 0; v < model_.positions.size(); ++v) {
    ASSERT_EQ(surface_.file_vertex_of[surface_.surface_of[v].value()], VertexId(expected.surface_of[v]));
  }

  std::vector<std::set<oracle::PointName>> regions(surface_.vertex_count());
  for (std::uint32_t p = 0; p < surface_.part_count(); ++p) {
    const PointDistances distances = measure_distances(surface_, PartId(p), surface_points(surface_, points_));
    const std::vector<SlotSet> sets = influence_regions(surface_, distances);
    for (std::size_t m = 0; m < sets.size(); ++m) {
      sets[m].for_each([&](std::size_t slot) {
        regions[distances.members[m].value()].insert(as_oracle_name(distances.points[slot].id));
      });
    }
  }

  double largest_error = 0.0;
  for (std::uint32_t v = 0; v < model_.positions.size(); ++v) {
    ASSERT_EQ(regions[surface_.surface_of[v].value()], expected.regions[v]) << "region of vertex " << v;
    const auto ids = rig_.weights.points_of(v);
    const auto weights = rig_.weights.weights_of(v);
    ASSERT_EQ(ids.size(), expected.weights[v].size()) << "influencers of vertex " << v;
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const auto found = expected.weights[v].find(as_oracle_name(ids[k]));
      ASSERT_NE(found, expected.weights[v].end()) << "vertex " << v << ", point " << to_string(ids[k]);
      largest_error = std::max(largest_error, std::abs(weights[k] - found->second));
    }
  }
  EXPECT_LE(largest_error, weight_tolerance);
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  // The promise is two seconds on one core; a tenth of that is usual.
  EXPECT_LT(seconds_, 2.0);
#endif
}

class RealHeads : public WeightsOfHead, public ::testing::WithParamInterface<HeadFile> {};

TEST_P(RealHeads, WeightsEqualTheLiteralOracle) {
  const auto folder = oracle::faces_folder();
  if (!folder) GTEST_SKIP() << "no folder of real heads";
  const auto& [name, model_file, points_file, triangles_file] = GetParam();
  const Model trusted = oracle::read_trusted_obj(*folder / name / triangles_file);
  Model model = oracle::import_head(*folder / name / triangles_file);
  ASSERT_EQ(model.triangles, trusted.triangles);  // else our edges would not be those of other programs
  ASSERT_EQ(model.positions, trusted.positions);
  if (std::string_view(model_file) != triangles_file) {
    model.positions = oracle::read_trusted_obj(*folder / name / model_file).positions;
  }
  const auto marked = oracle::read_trusted_points(*folder / name / points_file);
  ASSERT_NO_FATAL_FAILURE(make(std::move(model), [&] {
    auto placed = place_feature_points(model_, surface_, marked, nullptr);
    EXPECT_TRUE(placed) << placed.error().message;
    return placed ? *std::move(placed) : FeaturePointSet{};
  }));
  expect_those_of_the_literal_oracle();
}

class FamilyHeads : public WeightsOfHead, public ::testing::WithParamInterface<testing::FamilyMember> {};

TEST_P(FamilyHeads, WeightsEqualTheLiteralOracle) {
  const SampleHeadTraits& traits = GetParam().traits;
  ASSERT_NO_FATAL_FAILURE(
      make(testing::sample_head_model(traits), [&] { return testing::sample_head_points(traits); }));
  expect_those_of_the_literal_oracle();
}

INSTANTIATE_TEST_SUITE_P(Faces, FamilyHeads, ::testing::ValuesIn(testing::sample_family()), testing::member_name);

INSTANTIATE_TEST_SUITE_P(
    Faces, RealHeads,
    ::testing::Values(HeadFile{"ict-facekit", "neutral.obj", "ict-facekit.fps.json", "neutral.obj"},
                      HeadFile{"ict-facekit", "identity-sample.obj", "ict-facekit.fps.json", "neutral.obj"},
                      HeadFile{"makehuman", "head.obj", "makehuman.fps.json", "head.obj"},
                      HeadFile{"mediapipe-canonical", "face_model_with_iris.obj", "mediapipe-canonical.fps.json",
                               "face_model_with_iris.obj"}),
    [](const auto& info) {
      std::string name = std::string(info.param.folder) + "_" + info.param.model;
      for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
      return name;
    });

struct ParametrizedHead {
  Model model;
  Rig rig;
};

ParametrizedHead parametrize_head(const std::filesystem::path& model_file, const std::filesystem::path& points_file) {
  ParametrizedHead head;
  head.model = oracle::import_head(model_file);
  const Surface surface = build_surface(head.model);
  const auto points = place_feature_points(head.model, surface, oracle::read_trusted_points(points_file), nullptr);
  EXPECT_TRUE(points);
  auto rig = parametrize(head.model, surface, *points);
  EXPECT_TRUE(rig);
  head.rig = *std::move(rig);
  return head;
}

ParametrizedHead parametrize_bytes(std::span<const std::uint8_t> bytes, ModelFormat format, const SampleHead& points) {
  ParametrizedHead head;
  auto model = import_model(bytes, format);
  EXPECT_TRUE(model);
  head.model = *std::move(model);
  const Surface surface = build_surface(head.model);
  std::vector<MarkedPoint> marked;
  for (const SampleHeadPoint& point : points.points)
    marked.push_back({point.id, std::nullopt, glm::dvec3(point.position)});
  const auto placed = place_feature_points(head.model, surface, marked, nullptr);
  EXPECT_TRUE(placed);
  auto rig = parametrize(head.model, surface, *placed);
  EXPECT_TRUE(rig);
  head.rig = *std::move(rig);
  return head;
}

void expect_same_weights_at_same_positions(const ParametrizedHead& obj, const ParametrizedHead& glb) {
  std::map<std::array<float, 3>, std::vector<std::uint32_t>> at;
  for (std::uint32_t v = 0; v < obj.model.positions.size(); ++v) {
    const glm::vec3& p = obj.model.positions[v];
    at[{p.x, p.y, p.z}].push_back(v);
  }
  std::size_t compared = 0;
  for (std::uint32_t v = 0; v < glb.model.positions.size(); ++v) {
    const glm::vec3& p = glb.model.positions[v];
    const auto same = at.find({p.x + 0.0F, p.y + 0.0F, p.z + 0.0F});
    ASSERT_NE(same, at.end());
    if (same->second.size() > 1) continue;  // parts that touch: not told apart here
    ++compared;
    const std::uint32_t other = same->second.front();
    const auto ids = glb.rig.weights.points_of(v);
    const auto expected_ids = obj.rig.weights.points_of(other);
    ASSERT_TRUE(std::equal(ids.begin(), ids.end(), expected_ids.begin(), expected_ids.end())) << "vertex " << v;
    for (std::size_t k = 0; k < ids.size(); ++k) {
      ASSERT_NEAR(glb.rig.weights.weights_of(v)[k], obj.rig.weights.weights_of(other)[k], weight_tolerance);
    }
  }
  EXPECT_GT(compared, glb.model.positions.size() * 9 / 10);
}

TEST(FamilyFormats, GlbAndObjOfOneHeadGiveTheSameWeightsAtTheSamePositions) {
  for (const testing::FamilyMember& member : testing::sample_family()) {
    SCOPED_TRACE(member.name);
    const SampleHead head = make_sample_head(member.traits);
    const std::string text = testing::obj_of(head);
    const std::span obj(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    expect_same_weights_at_same_positions(parametrize_bytes(obj, ModelFormat::obj, head),
                                          parametrize_bytes(sample_head_glb(head).value(), ModelFormat::glb, head));
  }
}

TEST(RealHeadFormats, GlbAndObjOfOneHeadGiveTheSameWeightsAtTheSamePositions) {
  const auto folder = oracle::faces_folder();
  if (!folder) GTEST_SKIP() << "no folder of real heads";
  const std::filesystem::path points = *folder / "makehuman/makehuman.fps.json";
  const ParametrizedHead obj = parametrize_head(*folder / "makehuman/head.obj", points);
  const ParametrizedHead glb = parametrize_head(*folder / "makehuman/head.glb", points);
  EXPECT_EQ(glb.rig.parts.size(), 10U);  // the seams that split the skin into five are stitched

  expect_same_weights_at_same_positions(obj, glb);
}

}  // namespace
}  // namespace semblante
