// The stages from a file's bytes to a head with its levels, each with what it says and how it is cancelled.
#include <algorithm>
#include <utility>

#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/expressions/kernel_rig.h"
#include "core/geometry/enclosed_volume.h"
#include "core/import/axes.h"
#include "core/import/model_formats.h"
#include "core/pipeline/levelled.h"
#include "core/pipeline/outward.h"
#include "core/pipeline/points_file.h"
#include "tests/support/meshes.h"
#include "tests/support/sample_head_model.h"
#include "tests/support/sample_shapes.h"

namespace semblante {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr Axes along_z{Direction::plus_z, Direction::minus_y};

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// The sample head as a file would have it in which it stands by `axes`.
ImportedHead sample_standing(const Axes& axes) {
  ImportedHead head{testing::sample_head_model(), {}};
  change_axes(head.model, glm::transpose(to_mpeg4(axes)));
  return head;
}

/// All points of the sample by position, in the axes of such a file.
std::vector<MarkedPoint> sample_marks(const Axes& axes) {
  std::vector<MarkedPoint> marks;
  for (const FeaturePoint& point : testing::sample_head_points())
    marks.push_back({point.id, std::nullopt, glm::transpose(to_mpeg4(axes)) * glm::dvec3(point.position)});
  return marks;
}

/// Each stage's share and name; cancels once `last` are told.
struct Listener {
  std::vector<double> shares;
  std::size_t last = 1'000'000;
  [[nodiscard]] Progress progress() {
    return [this](double share, std::string_view) {
      shares.push_back(share);
      return shares.size() < last;
    };
  }
};

TEST(ImportHead, OfNoKnownFormat_NamesTheFormats) {
  const auto head = import_head(bytes_of("once upon"), {"prose.txt", std::nullopt, {}});
  ASSERT_FALSE(head);
  EXPECT_EQ(head.error().code, ErrorCode::unsupported);
  EXPECT_THAT(head.error().message, HasSubstr(model_file_titles()));
}

TEST(ImportHead, WarningsOfTheFile_AreKeptOnce) {
  const auto head =
      import_head(bytes_of("mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), {"a.obj", std::nullopt, {}});
  ASSERT_TRUE(head) << head.error().message;
  EXPECT_THAT(head->warnings.file, ElementsAre(HasSubstr("none.mtl")));
  EXPECT_THAT(head->model.warnings, IsEmpty());
}

void reverse_winding(Model& model) {
  for (auto* const triangles : {&model.triangles, &model.uv_triangles, &model.normal_triangles})
    for (Triangle& triangle : *triangles) std::swap(triangle[1], triangle[2]);
}

TEST(TurnOutward, AHeadThatIsInsideOut_IsTurnedOver_WithItsNormals) {
  const Model right = testing::sample_head_model();
  Model model = right;
  EXPECT_FALSE(turn_outward(model));
  EXPECT_EQ(model.triangles, right.triangles);
  reverse_winding(model);
  EXPECT_TRUE(turn_outward(model));
  EXPECT_EQ(model.triangles, right.triangles);
  EXPECT_EQ(model.normal_triangles, right.normal_triangles);
  EXPECT_EQ(model.normals, right.normals) << "they pointed outwards";
  reverse_winding(model);
  for (glm::vec3& normal : model.normals) normal = -normal;
  EXPECT_TRUE(turn_outward(model));
  EXPECT_EQ(model.normals, right.normals);
}

TEST(TurnOutward, AMirroredHead_FacesOutwards) {
  Model model = testing::sample_head_model();
  for (glm::vec3& position : model.positions) position.x = -position.x;
  for (glm::vec3& normal : model.normals) normal.x = -normal.x;
  const std::vector<glm::vec3> normals = model.normals;
  EXPECT_TRUE(turn_outward(model));
  EXPECT_FALSE(turn_outward(model));
  EXPECT_EQ(model.normals, normals);
}

TEST(TurnOutward, PartsThatDisagree_AndSheets_AreLeft) {
  Model model = testing::sample_head_model();
  const Surface surface = build_surface(model);
  const PartId skin = largest_part(surface);
  for (Triangle& triangle : model.triangles)
    if (surface.part_of[surface.surface_of[triangle[0]].value()] == skin) std::swap(triangle[1], triangle[2]);
  EXPECT_FALSE(turn_outward(model)) << "the eyes are the right way out";
  Model sheet = testing::make_grid(4, 4);
  EXPECT_FALSE(turn_outward(sheet));
  reverse_winding(sheet);
  EXPECT_FALSE(turn_outward(sheet));
}

TEST(StandHead, AlongZ_IsTurnedUpright_AndSaysSo) {
  const auto head = stand_head(sample_standing(along_z), {});
  ASSERT_TRUE(head);
  EXPECT_EQ(head->frame.axes, along_z);
  EXPECT_EQ(head->to_mpeg4, to_mpeg4(along_z));
  EXPECT_EQ(head->model.positions, testing::sample_head_model().positions);
  EXPECT_EQ(head->surface.surface_of.size(), head->model.positions.size());
  EXPECT_THAT(head->warnings.all(),
              ElementsAre("the head stands along +Z and faces -Y in its file; it is turned upright"));
}

TEST(StandHead, KnownFrame_IsTakenWithoutAGuess) {
  ModelFrame known;
  known.axes = {Direction::plus_x, Direction::plus_y};
  known.axes_sure = true;
  const auto head = stand_head(sample_standing(along_z), {{}, known, {}});
  ASSERT_TRUE(head);
  EXPECT_EQ(head->frame, known);
  EXPECT_THAT(head->warnings.all(), ElementsAre(HasSubstr("stands along +X and faces +Y")));
}

TEST(StandHead, UnsureStance_IsLeft_WithAWarning) {
  const auto head = stand_head({testing::make_grid(4, 4), {}}, {});
  ASSERT_TRUE(head);
  EXPECT_EQ(head->to_mpeg4, glm::dmat3(1.0));
  EXPECT_THAT(head->warnings.all(), ElementsAre(HasSubstr("axes of the head are uncertain")));
}

TEST(StandHead, AxesOfThePointsFile_AreNotGuessedAgain) {
  const auto head = stand_head(sample_standing(along_z), {{}, {}, to_mpeg4(along_z)});
  ASSERT_TRUE(head);
  EXPECT_EQ(head->frame.axes, Axes{});
  EXPECT_TRUE(head->frame.axes_sure);
  EXPECT_EQ(head->model.positions, testing::sample_head_model().positions);
  EXPECT_THAT(head->warnings.all(), IsEmpty());
}

TEST(MarkHead, PointsThatShowAnotherStance_TurnHeadAndPoints) {
  ModelFrame known;  // as it lies, which is wrong
  known.axes_sure = true;
  auto standing = stand_head(sample_standing(along_z), {{}, known, {}});
  ASSERT_TRUE(standing);
  const auto head = mark_head(std::move(*standing), {sample_marks(along_z), {}});
  ASSERT_TRUE(head) << head.error().where << head.error().message;
  ASSERT_TRUE(head->turn);
  EXPECT_EQ(*head->turn, to_mpeg4(along_z));
  EXPECT_EQ(head->to_mpeg4, to_mpeg4(along_z));
  EXPECT_EQ(head->model.positions, testing::sample_head_model().positions);
  const auto expected = testing::sample_head_points();
  ASSERT_EQ(head->points.size(), expected.size());
  EXPECT_LT(glm::distance(head->points[0].position, expected[0].position), 1e-5F);
  EXPECT_THAT(head->warnings.stance, ElementsAre(HasSubstr("the feature points show that the head stands along +Z")));
}

TEST(MarkHead, PointsThatAreSure_TakeTheDoubtAway) {
  auto standing = stand_head(sample_standing({}), {{}, ModelFrame{}, {}});
  ASSERT_TRUE(standing);
  ASSERT_THAT(standing->warnings.stance, ElementsAre(HasSubstr("axes of the head are uncertain")));
  const auto head = mark_head(std::move(*standing), {sample_marks({}), {}});
  ASSERT_TRUE(head);
  EXPECT_FALSE(head->turn);
  EXPECT_THAT(head->warnings.stance, IsEmpty());
}

TEST(MarkHead, PointThatCannotBePlaced_StopsOrIsAFinding) {
  for (const bool leaves_out : {false, true}) {
    auto standing = stand_head(sample_standing({}), {});
    ASSERT_TRUE(standing);
    auto marks = sample_marks({});
    marks[3].position = glm::dvec3(1e6);
    const auto head = mark_head(std::move(*standing), {marks, {}, leaves_out});
    ASSERT_EQ(head.ok(), leaves_out);
    if (!leaves_out) continue;
    EXPECT_EQ(head->refused.size(), 1U);
    EXPECT_EQ(head->points.size(), marks.size() - 1);
  }
}

/// The sample head, rotated in its file, in `joy` with an open jaw; positions in the axes of the unrotated file.
std::vector<glm::vec3> joy_of_tilted(const glm::dmat3& in_file, const FrameWish& wish = {}) {
  ImportedHead imported{testing::sample_head_model(), {}};
  change_axes(imported.model, in_file);
  FeaturePointsFile file;
  file.points = sample_marks({});
  turn_points(file.points, in_file);
  auto marked = mark_by_file(std::move(imported), std::move(file), wish);
  EXPECT_TRUE(marked) << marked.error().message;
  auto head = rig_head(std::move(*marked), {WeightMethod::smooth});
  EXPECT_TRUE(head) << head.error().message;
  const KernelRig rig = make_kernel_rig(head->rig);
  const semblante_rig view = rig.view();
  semblante_frame frame{};
  frame.expression1 = 1;
  frame.intensity1 = 63;
  frame.fap[3] = 400;
  semblante_pose pose;
  semblante_evaluate(&view, &frame, &pose);
  std::vector<glm::vec3> positions(head->model.positions.size());
  const semblante_face face = make_kernel_face(head->rig, &head->model.positions[0].x);
  semblante_deform(&face, &pose, &positions[0].x);
  const glm::dmat3 back = glm::transpose(in_file) * glm::transpose(head->to_mpeg4);
  for (glm::vec3& position : positions) position = glm::vec3(back * glm::dvec3(position));
  return positions;
}

TEST(MarkHead, AHeadTiltedInItsFile_MovesAsTheUprightOne) {
  const std::vector<glm::vec3> rest = testing::sample_head_model().positions;
  const std::vector<glm::vec3> upright = joy_of_tilted(glm::dmat3(1.0));
  float farthest = 0.0F;
  for (std::size_t v = 0; v < rest.size(); ++v) farthest = std::max(farthest, glm::distance(upright[v], rest[v]));
  const auto error = [&](const std::vector<glm::vec3>& moved) {
    float worst = 0.0F;
    for (std::size_t v = 0; v < rest.size(); ++v) worst = std::max(worst, glm::distance(moved[v], upright[v]));
    return worst / farthest;
  };
  const double angle = glm::radians(20.0);
  const FrameWish as_in_file{{}, Direction::plus_y, Direction::plus_z};
  const glm::dvec3 x(1, 0, 0);
  const glm::dvec3 y(0, 1, 0);
  const glm::dvec3 z(0, 0, 1);
  EXPECT_LT(error(joy_of_tilted(glm::mat3_cast(glm::angleAxis(angle, z)))), 0.01F);
  EXPECT_LT(error(joy_of_tilted(glm::mat3_cast(glm::angleAxis(angle, y)))), 0.01F);
  // How far a face nods is known only as far as faces agree in it: 3 degrees here, of 20.
  const float nodding = error(joy_of_tilted(glm::mat3_cast(glm::angleAxis(angle, x)), as_in_file));
  EXPECT_LT(error(joy_of_tilted(glm::mat3_cast(glm::angleAxis(angle, x)))), 0.3F * nodding);
  EXPECT_LT(error(joy_of_tilted(glm::mat3_cast(glm::angleAxis(-angle, x)))), 0.3F * nodding);
  // Where the user says that the axes of the file are the head's, it moves along them.
  EXPECT_GT(error(joy_of_tilted(glm::mat3_cast(glm::angleAxis(angle, z)), as_in_file)), 0.2F);
  EXPECT_GT(nodding, 0.3F);
}

TEST(MarkHead, AHeadTiltedInItsFile_IsSaid) {
  const glm::dmat3 in_file = glm::mat3_cast(glm::angleAxis(glm::radians(20.0), glm::dvec3(0, 0, 1)));
  ImportedHead imported{testing::sample_head_model(), {}};
  change_axes(imported.model, in_file);
  FeaturePointsFile file;
  file.points = sample_marks({});
  turn_points(file.points, in_file);
  const auto head = mark_by_file(std::move(imported), file);
  ASSERT_TRUE(head);
  ASSERT_TRUE(head->turn);
  EXPECT_THAT(head->warnings.stance, ElementsAre("the feature points show that the head is tilted by 20 degrees in its "
                                                 "file; it is turned upright"));
}

/// The middle of a triangle at a vertex, in the axes of a file in which the head stands by `axes`.
glm::dvec3 middle_beside(VertexId vertex, const Axes& axes) {
  const Model model = testing::sample_head_model();
  const auto triangle = std::find_if(model.triangles.begin(), model.triangles.end(), [&](const Triangle& t) {
    return std::find(t.begin(), t.end(), vertex.value()) != t.end();
  });
  glm::dvec3 sum(0.0);
  for (const std::uint32_t v : *triangle) sum += glm::dvec3(model.positions[v]);
  return glm::transpose(to_mpeg4(axes)) * (sum / 3.0);
}

TEST(MarkHead, PointBetweenVertices_GetsOneOfItsOwn_OnATurnedHeadToo) {
  const Model model = testing::sample_head_model();
  for (const Axes& axes : {Axes{}, along_z}) {
    ModelFrame known;  // as it lies
    known.axes_sure = true;
    auto standing = stand_head(sample_standing(axes), {{}, known, {}});
    ASSERT_TRUE(standing);
    auto marks = sample_marks(axes);
    const auto nose =
        std::find_if(marks.begin(), marks.end(), [](const auto& p) { return p.id == testing::fp("9.3"); });
    const VertexId before = *testing::sample_head_points()[static_cast<std::size_t>(nose - marks.begin())].vertex;
    nose->position = middle_beside(before, axes);
    const auto head = mark_head(std::move(*standing), {marks, {}});
    ASSERT_TRUE(head) << head.error().message;
    EXPECT_EQ(head->turn.has_value(), axes == along_z);
    EXPECT_THAT(head->warnings.points, IsEmpty());
    ASSERT_EQ(head->inserted.size(), 1U);
    ASSERT_EQ(head->model.positions.size(), model.positions.size() + 1);
    EXPECT_TRUE(std::equal(model.positions.begin(), model.positions.end(), head->model.positions.begin()));
    EXPECT_EQ(head->surface.surface_of.size(), head->model.positions.size());
    for (const FeaturePoint& point : head->points) {
      EXPECT_FALSE(point.between);
      if (!point.vertex) continue;
      EXPECT_EQ(head->is_of_file(*point.vertex), point.id != testing::fp("9.3"));
      EXPECT_EQ(point.position, head->model.positions[point.vertex->value()]);
    }
  }
}

TEST(RigHead, PointBetweenVertices_MovesItsOwnVertexFully_AndIsInEveryLevel) {
  auto standing = stand_head(sample_standing({}), {});
  ASSERT_TRUE(standing);
  auto marks = sample_marks({});
  const auto cheek = std::find_if(marks.begin(), marks.end(), [](const auto& p) { return p.id == testing::fp("5.1"); });
  cheek->position =
      middle_beside(*testing::sample_head_points()[static_cast<std::size_t>(cheek - marks.begin())].vertex, {});
  auto marked = mark_head(std::move(*standing), {marks, {}});
  ASSERT_TRUE(marked) << marked.error().message;
  for (const WeightMethod method : {WeightMethod::paper, WeightMethod::smooth}) {
    auto rigged = rig_head(*marked, {method, DistanceMetric::unfolded});
    ASSERT_TRUE(rigged);
    const auto own = static_cast<std::uint32_t>(rigged->model.positions.size() - 1);
    ASSERT_EQ(rigged->rig.weights.points_of(own).size(), 1U);
    EXPECT_EQ(rigged->rig.weights.points_of(own)[0], testing::fp("5.1"));
    EXPECT_EQ(rigged->rig.weights.weights_of(own)[0], 1.0);
    const auto head = level_head(std::move(*rigged), {2000});
    ASSERT_TRUE(head);
    ASSERT_EQ(head->levels.size(), 1U);
    const auto& triangles = head->levels[0].triangles;
    EXPECT_TRUE(std::any_of(triangles.begin(), triangles.end(),
                            [&](const Triangle& t) { return std::find(t.begin(), t.end(), own) != t.end(); }));
  }
}

TEST(MarkByFile, AxesFromBothFileAndUser_AreRefused) {
  FeaturePointsFile file;
  file.to_mpeg4_axes = glm::dmat3(1.0);
  const auto head = mark_by_file(sample_standing({}), file, {{}, Direction::plus_z, {}});
  ASSERT_FALSE(head);
  EXPECT_EQ(head.error().where, "/to_mpeg4_axes");
}

Result<LevelledHead> whole_way(const Progress& progress) {
  ImportedHead imported = sample_standing(along_z);
  imported.warnings.file = {"of the file"};
  FeaturePointsFile file;
  file.points = sample_marks(along_z);
  std::erase_if(file.points, [](const MarkedPoint& p) { return p.id == testing::fp("2.1"); });
  auto marked = mark_by_file(std::move(imported), file, {}, false, part_of(progress, 0.0, 0.2));
  if (!marked) return marked.error();
  auto rigged = rig_head(std::move(*marked), {}, part_of(progress, 0.2, 0.6));
  if (!rigged) return rigged.error();
  auto head = level_head(std::move(*rigged), {2000, 100}, part_of(progress, 0.6, 0.8));
  if (!head) return head.error();
  auto errors = measure_levels(*head, part_of(progress, 0.8, 1.0));
  if (!errors) return errors.error();
  EXPECT_EQ(errors->size(), head->levels.size());
  return head;
}

/// The family's avatar, its own shapes exaggerated.
MarkedHead avatar(float exaggerated) {
  const std::vector<std::uint8_t>& bytes = testing::sample_avatar_glb();
  auto imported = import_head(bytes, {"avatar.glb", std::nullopt, {}});
  EXPECT_TRUE(imported);
  for (Example& example : imported->model.examples)
    for (glm::vec3& d : example.displacements) d *= exaggerated;
  FeaturePointsFile file;
  for (const SampleHeadPoint& point : testing::sample_avatar().points)
    file.points.push_back({point.id, point.vertex, glm::dvec3(point.position)});
  auto marked = mark_by_file(std::move(*imported), file, {});
  EXPECT_TRUE(marked) << marked.error().message;
  return *std::move(marked);
}

// The avatar's visemes were made of the library's.
TEST(RigHead, ArticulatesAsItsOwnShapes_UnlessSetByHand) {
  const auto usual = rig_head(avatar(1.0F), {});
  ASSERT_TRUE(usual);
  EXPECT_NEAR(usual->rig.articulation, usual_articulation, 0.02) << usual->articulation_reason;

  const auto wide = rig_head(avatar(2.24F), {});
  ASSERT_TRUE(wide);
  EXPECT_GT(wide->rig.articulation, 2.2);
  EXPECT_THAT(wide->articulation_reason, HasSubstr("a (viseme_aa)"));
  EXPECT_THAT(wide->articulation_reason, HasSubstr("the mouth opens 2.2"));

  const auto by_hand = rig_head(avatar(2.24F), {.articulation = 0.5});
  ASSERT_TRUE(by_hand);
  EXPECT_EQ(by_hand->rig.articulation, 0.5);
  EXPECT_EQ(by_hand->articulation_reason, "set by hand");

  MarkedHead bare = avatar(2.24F);
  bare.model.examples.clear();
  const auto without = rig_head(std::move(bare), {});
  ASSERT_TRUE(without);
  EXPECT_EQ(without->rig.articulation, usual_articulation);
  EXPECT_THAT(without->articulation_reason, HasSubstr("no own shapes"));
}

TEST(Pipeline, Warnings_ComeOnce_InTheOrderOfTheStages) {
  const auto head = whole_way({});
  ASSERT_TRUE(head) << head.error().where << head.error().message;
  EXPECT_THAT(head->model.warnings, IsEmpty());
  EXPECT_THAT(head->rig.warnings, IsEmpty());
  const auto all = head->warnings.all();
  ASSERT_GE(all.size(), 4U);
  EXPECT_EQ(all[0], "of the file");
  EXPECT_THAT(all[1], HasSubstr("stands along +Z"));
  EXPECT_FALSE(head->warnings.rig.empty());
  ASSERT_FALSE(head->missed.empty());
  EXPECT_EQ(all.back(), head->missed.back().words);
  EXPECT_EQ(head->materials.of_triangle.size(), head->model.triangles.size());
}

TEST(Pipeline, Progress_NeverFalls_AndCancelsWhereverItSaysNo) {
  Listener whole;
  ASSERT_TRUE(whole_way(whole.progress()));
  EXPECT_TRUE(std::is_sorted(whole.shares.begin(), whole.shares.end()));
  EXPECT_GE(whole.shares.front(), 0.0);
  EXPECT_LE(whole.shares.back(), 1.0);
  // The first, the last and some between.
  const std::size_t count = whole.shares.size();
  for (const std::size_t last : {std::size_t{1}, std::size_t{2}, std::size_t{3}, count / 2, count}) {
    Listener impatient;
    impatient.last = last;
    const auto head = whole_way(impatient.progress());
    ASSERT_FALSE(head) << last;
    EXPECT_EQ(head.error().code, ErrorCode::cancelled);
  }
}

}  // namespace
}  // namespace semblante
