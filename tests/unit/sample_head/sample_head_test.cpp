#include "deploy/sample_head/sample_head.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/ext/vector_int3.hpp>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deploy/sample_head/eyelids.h"
#include "deploy/sample_head/sculpt.h"
#include "deploy/sample_head/upper_lid.h"
#include "deploy/sample_head/write_sample_head.h"

namespace semblante {
namespace {

using testing::UnorderedElementsAre;

const SampleHead& head() {
  static const SampleHead the_head = make_sample_head();
  return the_head;
}

const SampleHeadMesh& part(const std::string& name) {
  for (const auto& mesh : head().meshes) {
    if (mesh.name == name) return mesh;
  }
  throw std::runtime_error("no part " + name);
}

const SampleHeadPoint& point(const std::string& id) {
  for (const auto& p : head().points) {
    if (p.id == parse_feature_point(id)) return p;
  }
  throw std::runtime_error("no point " + id);
}

glm::dvec3 at(const std::string& id) { return point(id).position; }

/// One mesh with its seams closed by position: every vertex number to that of the first one at its place.
std::vector<std::uint32_t> welded(const SampleHeadMesh& mesh) {
  std::map<std::tuple<float, float, float>, std::uint32_t> first;
  std::vector<std::uint32_t> result;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const auto& p = mesh.positions[v];
    result.push_back(first.try_emplace({p.x + 0.0F, p.y + 0.0F, p.z + 0.0F}, v).first->second);
  }
  return result;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Triangles per edge, directed: (a, b) counts triangles that run from a to b.
std::map<Edge, int> directed_edges(const SampleHeadMesh& mesh) {
  const auto weld = welded(mesh);
  std::map<Edge, int> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{weld[t[i]], weld[t[(i + 1) % 3]]}];
  }
  return edges;
}

/// The part an FP lies on and its vertex there.
std::pair<const SampleHeadMesh*, std::uint32_t> place_of(const SampleHeadPoint& p) {
  std::uint32_t v = *p.vertex;
  for (const auto& mesh : head().meshes) {
    if (v < mesh.positions.size()) return {&mesh, v};
    v -= static_cast<std::uint32_t>(mesh.positions.size());
  }
  return {nullptr, 0};
}

/// Lengths of the shortest edge paths over the stitched part from one vertex: plain Dijkstra.
std::vector<double> distances(const SampleHeadMesh& mesh, std::uint32_t from) {
  const auto weld = welded(mesh);
  std::vector<std::set<std::uint32_t>> neighbours(mesh.positions.size());
  for (const auto& [edge, count] : directed_edges(mesh)) {
    neighbours[edge.first].insert(edge.second);
    neighbours[edge.second].insert(edge.first);
  }
  std::vector<double> best(mesh.positions.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  queue.emplace(0.0, weld[from]);
  best[weld[from]] = 0.0;
  while (!queue.empty()) {
    const auto [d, v] = queue.top();
    queue.pop();
    if (d > best[v]) continue;
    for (const std::uint32_t n : neighbours[v]) {
      const double through = d + glm::distance(glm::dvec3(mesh.positions[v]), glm::dvec3(mesh.positions[n]));
      if (through < best[n]) {
        best[n] = through;
        queue.emplace(through, n);
      }
    }
  }
  for (std::size_t v = 0; v < best.size(); ++v) best[v] = best[weld[v]];
  return best;
}

TEST(SampleHead, IsDeterministic_WhenMadeTwice) {
  const auto first = sample_head_glb(head());
  const auto second = sample_head_glb(make_sample_head());
  ASSERT_TRUE(first.ok());
  ASSERT_TRUE(second.ok());
  EXPECT_EQ(first.value(), second.value());
  EXPECT_EQ(sample_head_feature_points_json(head()), sample_head_feature_points_json(make_sample_head()));
}

TEST(SampleHead, StaysSmall_AsAFile) {
  std::size_t vertices = 0;
  for (const auto& mesh : head().meshes) vertices += mesh.positions.size();
  EXPECT_GE(vertices, 5000U);
  EXPECT_LE(vertices, 15000U);
  const auto glb = sample_head_glb(head());
  ASSERT_TRUE(glb.ok());
  EXPECT_LT(glb.value().size(), 1'500'000U);
  for (const auto& image : head().images) {
    EXPECT_LE(image.width, 512);
    EXPECT_LE(image.height, 512);
  }
}

TEST(SampleHead, ArraysFit_InEveryPart) {
  for (const auto& mesh : head().meshes) {
    SCOPED_TRACE(mesh.name);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    ASSERT_LT(mesh.material, head().materials.size());
    std::vector<bool> used(mesh.positions.size(), false);
    for (const auto& t : mesh.triangles) {
      for (const std::uint32_t v : t) {
        ASSERT_LT(v, mesh.positions.size());
        used[v] = true;
      }
    }
    EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      for (int i = 0; i < 3; ++i) ASSERT_TRUE(std::isfinite(mesh.positions[v][i]));
      ASSERT_NEAR(glm::length(mesh.normals[v]), 1.0F, 1e-4F);
      for (int i = 0; i < 2; ++i) {
        ASSERT_GE(mesh.uvs[v][i], 0.0F);
        ASSERT_LE(mesh.uvs[v][i], 1.0F);
      }
    }
  }
}

TEST(SampleHead, HasNoDegenerateTriangles) {
  for (const auto& mesh : head().meshes) {
    std::size_t degenerate = 0;
    for (const auto& t : mesh.triangles) {
      const glm::dvec3 a = mesh.positions[t[0]];
      const glm::dvec3 across = glm::cross(glm::dvec3(mesh.positions[t[1]]) - a, glm::dvec3(mesh.positions[t[2]]) - a);
      if (glm::length(across) < 1e-11) ++degenerate;  // 1e-11 m^2 of doubled area: a tenth of a 10 um square
    }
    EXPECT_EQ(degenerate, 0U) << mesh.name;
  }
}

TEST(SampleHead, IsSymmetric_Exactly) {
  std::multiset<std::tuple<float, float, float>> left;
  std::multiset<std::tuple<float, float, float>> right;
  for (const auto& mesh : head().meshes) {
    for (const auto& p : mesh.positions) {
      if (p.x > 0.0F) left.insert({p.x, p.y, p.z});
      if (p.x < 0.0F) right.insert({-p.x, p.y, p.z});
    }
  }
  EXPECT_EQ(left, right);
}

TEST(SampleHead, SkinIsOneOrientedSurface_OpenOnlyAtTheNeck) {
  const auto edges = directed_edges(part("skin"));
  std::set<std::uint32_t> border;
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1) << "an edge used twice in one direction";
    if (edges.find({edge.second, edge.first}) == edges.end()) {
      border.insert(edge.first);
      border.insert(edge.second);
    }
  }
  ASSERT_FALSE(border.empty());
  // The edge of the neck is below the chin and hidden by the collar all round.
  for (const std::uint32_t v : border) {
    const glm::dvec3 p = part("skin").positions[v];
    EXPECT_LT(p.y, at("2.1").y - 0.02);
    double nearest = 1.0;
    for (const auto& q : part("shirt").positions) nearest = std::min(nearest, glm::distance(p, glm::dvec3(q)));
    EXPECT_LT(nearest, 0.015) << v;
  }
  const auto reach = distances(part("skin"), 0);
  EXPECT_EQ(std::count(reach.begin(), reach.end(), std::numeric_limits<double>::infinity()), 0);
}

TEST(SampleHead, Has84Points_EachOnItsPart) {
  ASSERT_EQ(head().points.size(), feature_point_count);
  std::map<std::string, std::set<std::string>> points_of;
  for (std::size_t i = 0; i < feature_point_count; ++i) {
    const auto& p = head().points[i];
    ASSERT_EQ(p.id.value(), i);
    if (!p.vertex) {
      EXPECT_EQ(to_string(p.id), "7.1");
      continue;
    }
    const auto [mesh, v] = place_of(p);
    ASSERT_NE(mesh, nullptr);
    EXPECT_EQ(mesh->positions[v], p.position);
    points_of[mesh->name].insert(to_string(p.id));
  }
  EXPECT_THAT(points_of["left eye"], UnorderedElementsAre("3.5"));
  EXPECT_THAT(points_of["right eye"], UnorderedElementsAre("3.6"));
  EXPECT_THAT(points_of["tongue"], UnorderedElementsAre("6.1", "6.2", "6.3", "6.4"));
  EXPECT_THAT(points_of["upper teeth"], UnorderedElementsAre("9.8", "9.10"));
  EXPECT_THAT(points_of["lower teeth"], UnorderedElementsAre("9.9", "9.11"));
  EXPECT_THAT(points_of["hair"], UnorderedElementsAre("11.5"));
  EXPECT_THAT(points_of["upper lids"], UnorderedElementsAre("3.1", "3.2", "3.13", "3.14"));
  EXPECT_EQ(points_of["skin"].size(), 84U - 1 - 2 - 4 - 4 - 1 - 4);
}

TEST(SampleHead, PointsMirror_AsTheStandardPairsThem) {
  const std::vector<std::pair<std::string, std::string>> pairs = {
      {"2.4", "2.5"},    {"2.6", "2.7"},   {"2.8", "2.9"},   {"2.11", "2.12"}, {"2.13", "2.14"}, {"3.1", "3.2"},
      {"3.3", "3.4"},    {"3.5", "3.6"},   {"3.7", "3.12"},  {"3.8", "3.11"},  {"3.9", "3.10"},  {"3.13", "3.14"},
      {"4.1", "4.2"},    {"4.3", "4.4"},   {"4.5", "4.6"},   {"5.1", "5.2"},   {"5.3", "5.4"},   {"6.3", "6.4"},
      {"8.3", "8.4"},    {"8.5", "8.6"},   {"8.7", "8.8"},   {"8.10", "8.9"},  {"9.1", "9.2"},   {"9.5", "9.4"},
      {"9.7", "9.6"},    {"9.13", "9.14"}, {"10.1", "10.2"}, {"10.3", "10.4"}, {"10.5", "10.6"}, {"10.7", "10.8"},
      {"10.9", "10.10"}, {"11.3", "11.2"}};
  std::set<std::string> paired;
  for (const auto& [left, right] : pairs) {
    // 3.8 is the left corner of the RIGHT eye.
    EXPECT_EQ(at(left).x > 0.0, left != "3.8") << left;
    EXPECT_EQ(at(left), at(right) * glm::dvec3(-1.0, 1.0, 1.0)) << left;
    paired.insert({left, right});
  }
  for (const auto& p : head().points) {
    const bool alone = !paired.contains(to_string(p.id));
    EXPECT_EQ(alone, p.position.x == 0.0F) << to_string(p.id);
  }
}

TEST(SampleHead, PointsKeepTheRelations_OfTheStandard) {
  constexpr double hair_breadth = 1e-4;
  EXPECT_NEAR(at("2.6").x, 0.5 * (at("2.2").x + at("2.4").x), hair_breadth);
  EXPECT_NEAR(at("2.8").x, 0.5 * (at("2.3").x + at("2.4").x), hair_breadth);
  EXPECT_NEAR(at("8.5").x, 0.5 * (at("8.1").x + at("8.3").x), hair_breadth);
  EXPECT_NEAR(at("8.7").x, 0.5 * (at("8.2").x + at("8.3").x), hair_breadth);
  for (const char* id : {"3.1", "3.3", "3.9", "3.13"}) {
    EXPECT_NEAR(at(id).x, 0.5 * (at("3.7").x + at("3.11").x), 5e-4) << id;
  }
  EXPECT_NEAR(at("4.3").x, 0.5 * (at("4.1").x + at("4.5").x), hair_breadth);
  EXPECT_NEAR(at("5.1").y, at("8.3").y, hair_breadth);
  EXPECT_GT(at("5.3").x, at("3.5").x);
  EXPECT_LT(at("5.3").x, at("3.7").x);
  EXPECT_GT(at("5.3").y, at("9.15").y);
  EXPECT_LT(at("5.3").y, at("9.12").y);
  EXPECT_GT(at("2.11").x, at("8.7").x);
  EXPECT_LT(at("2.11").x, at("8.3").x);
  EXPECT_NEAR(at("9.12").y, 0.5 * (at("9.7").y + at("9.3").y), hair_breadth);
  EXPECT_NEAR(at("9.13").y, at("9.12").y, hair_breadth);
  EXPECT_NEAR(at("6.3").z, at("6.2").z, hair_breadth);
  EXPECT_NEAR(at("10.3").y, 0.5 * (at("10.1").y + at("10.5").y), hair_breadth);
  EXPECT_GT(at("11.3").x, at("4.3").x);
  EXPECT_GT(at("11.5").y, at("11.4").y);
  EXPECT_GT(at("8.10").y, at("8.1").y);
}

TEST(SampleHead, FaceUnits_AreThoseOfAGrownPerson) {
  const double irisd = at("3.1").y - at("3.3").y;
  const double es = at("3.5").x - at("3.6").x;
  const double ens = at("3.5").y - at("9.15").y;
  const double mns = at("9.15").y - at("2.2").y;
  const double mw = at("8.3").x - at("8.4").x;
  EXPECT_NEAR(irisd, 0.012, 0.001);  // the iris of a person measures 11 to 12.5 mm
  EXPECT_NEAR(es, 0.064, 0.004);     // eyes of grown people stand 60 to 68 mm apart
  EXPECT_NEAR(ens / es, 0.74, 0.08);
  EXPECT_NEAR(mns / es, 0.31, 0.06);
  EXPECT_NEAR(mw / es, 0.78, 0.08);
  const double height = at("11.4").y - at("2.1").y;
  EXPECT_NEAR(height, 0.225, 0.015);
  EXPECT_NEAR((at("11.4").y + at("2.1").y) / 2.0, at("3.5").y, 0.006);  // eyes half way up the head
}

TEST(SampleHead, LipsAreFarApartOnTheSurface_ThoughTheyTouch) {
  const auto& skin = part("skin");
  const auto [mesh, upper] = place_of(point("2.2"));
  const auto [other, lower] = place_of(point("2.3"));
  ASSERT_EQ(mesh, &skin);
  ASSERT_EQ(other, &skin);
  EXPECT_LT(glm::distance(at("2.2"), at("2.3")), 0.0005);
  EXPECT_GT(at("2.2").y, at("2.3").y);
  const double half_width = at("8.3").x;
  EXPECT_GE(distances(skin, upper)[lower], half_width);
}

TEST(SampleHead, LidsCanClose_InFrontOfTheBall) {
  const auto& eye = part("left eye");
  glm::dvec3 low(1e9);
  glm::dvec3 high(-1e9);
  for (const auto& p : eye.positions) {
    low = glm::min(low, glm::dvec3(p));
    high = glm::max(high, glm::dvec3(p));
  }
  const glm::dvec3 centre = 0.5 * (low + high);
  const double radius = 0.5 * (high.z - low.z);
  for (const auto& p : eye.positions) ASSERT_NEAR(glm::distance(glm::dvec3(p), centre), radius, 1e-6);
  EXPECT_NEAR(at("3.5").z, centre.z + radius, 1e-6);

  // A blink by Eq. 2, 4 and 7 written out for the two points of the lid, 3.1 moving down by IRISD0 and 3.13 resting:
  // each is the other's only neighbour, so d = d_12 / cos(theta).
  const auto& lid = part("upper lids");
  const auto [on_lid, edge] = place_of(point("3.1"));
  const auto [also_on_lid, root] = place_of(point("3.13"));
  ASSERT_EQ(on_lid, &lid);
  ASSERT_EQ(also_on_lid, &lid);
  const auto from_edge = distances(lid, edge);
  const auto from_root = distances(lid, root);
  const double between = from_edge[root];
  const auto weight = [&](const glm::dvec3& own, const glm::dvec3& other, const glm::dvec3& p, double way) {
    if (way == 0.0) return 1.0;
    const double cosine = glm::dot(glm::normalize(p - own), glm::normalize(other - own));
    if (cosine <= 1e-6 || way >= between / cosine) return 0.0;
    return std::sin(std::acos(0.0) * (1.0 - way * cosine / between));
  };
  const double irisd = at("3.1").y - at("3.3").y;
  double highest_of_edge = -1.0;
  std::set<std::size_t> border;  // in front: the edge, and the shell's ends
  const auto edges = directed_edges(lid);
  for (const auto& [one, count] : edges) {
    if (edges.find({one.second, one.first}) == edges.end()) border.insert({one.first, one.second});
  }
  for (std::size_t v = 0; v < lid.positions.size(); ++v) {
    const glm::dvec3 p = lid.positions[v];
    if (p.z < centre.z + 0.005 || p.x <= 0.0) continue;  // the lid's root is hidden over the ball
    const double w = weight(at("3.1"), at("3.13"), p, from_edge[v]);
    const double rest = weight(at("3.13"), at("3.1"), p, from_root[v]);
    ASSERT_GT(w + rest, 0.0) << "a vertex of the lid that nothing holds: " << v;
    const glm::dvec3 closed = p - glm::dvec3(0.0, irisd * w / (w + rest), 0.0);
    // The lid's front in the middle of the slit stays before the ball, however far it has come.
    if (p.z > centre.z + 0.0135 && p.y < centre.y + 0.0155 && std::abs(p.x - centre.x) < 0.009) {
      EXPECT_GT(glm::distance(closed, centre), radius) << v;
      EXPECT_GT(glm::distance(0.5 * (closed + p), centre), radius) << v;
    }
    if (border.contains(v) && std::abs(p.x - centre.x) < 0.012) highest_of_edge = std::max(highest_of_edge, closed.y);
  }
  EXPECT_LT(highest_of_edge, at("3.3").y + 0.15 * irisd);
  // The iris reaches from lid to lid.
  EXPECT_NEAR(at("3.1").y, 0.5 * irisd, 2e-4);
}

/// sRGB, 0 to 255.
glm::ivec3 colour_of(const SampleHeadMesh& mesh, std::size_t vertex) {
  const SampleHeadImage& image = head().images[head().materials[mesh.material].image.value()];
  const auto pixel = [](float at, int size) {
    return std::min(size - 1, static_cast<int>(at * static_cast<float>(size)));
  };
  const glm::vec2 uv = mesh.uvs[vertex];
  const auto i = static_cast<std::size_t>(3 * (pixel(uv.y, image.height) * image.width + pixel(uv.x, image.width)));
  return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
}

// Otherwise a crescent shows above the eye, light or dark.
TEST(SampleHead, UpperLid_HasTheColourOfTheSkinAboveIt) {
  const auto& skin = part("skin");
  const auto& lid = part("upper lids");
  const glm::dvec3 above = at("3.1") + glm::dvec3(0.0, 0.0055, 0.002);
  std::size_t nearest = 0;
  for (std::size_t v = 0; v < skin.positions.size(); ++v) {
    if (glm::distance(glm::dvec3(skin.positions[v]), above) <
        glm::distance(glm::dvec3(skin.positions[nearest]), above)) {
      nearest = v;
    }
  }
  const glm::ivec3 expected = colour_of(skin, nearest);
  std::size_t compared = 0;
  for (std::size_t v = 0; v < lid.positions.size(); ++v) {
    const glm::dvec3 p = lid.positions[v];
    if (std::abs(p.x - at("3.1").x) > 0.008 || p.y < at("3.1").y + 0.002) continue;  // lashes
    const glm::ivec3 colour = colour_of(lid, v);
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(colour[c], expected[c], 18) << v << ' ' << c;
    ++compared;
  }
  EXPECT_GT(compared, 50U);
}

// A lid that is closed does not come out of the skin beside or above its fold.
TEST(SampleHead, UpperLid_RollsBehindItsFold) {
  using namespace sample_head_detail;
  const UpperLid lid = make_upper_lid(false);
  constexpr std::size_t columns = 21;
  for (std::size_t v = 2 * columns; v < lid.mesh.positions.size(); ++v) {  // after the lashes
    const Vec3 p = lid.mesh.positions[v] - eye_centre;
    const double ball = std::sqrt(std::max(eye_radius * eye_radius - p.x * p.x, 0.0));
    ASSERT_LE(std::hypot(p.y, p.z), std::max(fold_radius(p.x) - 0.049, ball + 0.061)) << v;
  }
}

TEST(SampleHead, TeethAndTongue_StandInsideTheMouth) {
  // The bag lies behind the lips; its back wall is its rearmost vertex on the middle line below the nose.
  for (const char* name : {"upper teeth", "lower teeth", "tongue"}) {
    for (const auto& p : part(name).positions) {
      EXPECT_LT(p.z, static_cast<float>(at("2.2").z)) << name;
      EXPECT_LT(p.y, static_cast<float>(at("9.15").y)) << name;
      EXPECT_GT(p.y, static_cast<float>(at("2.10").y)) << name;
    }
  }
  EXPECT_NEAR(at("9.10").y, at("9.11").y, 0.001);  // teeth touch
  EXPECT_NEAR(at("6.1").y, at("9.11").y, 0.003);   // tip of the tongue between them
}

glm::dvec3 at(const SampleHead& of, const std::string& id) {
  const auto wanted = parse_feature_point(id);
  return std::find_if(of.points.begin(), of.points.end(), [&](const auto& p) { return p.id == wanted; })->position;
}

TEST(SampleFamily, AnotherPersonHasTheSameMesh_WithOtherProportions) {
  const SampleHead other = make_sample_head({.jaw_width = 1.1, .face_length = 0.94, .nose_length = 0.85});
  ASSERT_EQ(other.meshes.size(), head().meshes.size());
  for (std::size_t m = 0; m < other.meshes.size(); ++m) {
    EXPECT_EQ(other.meshes[m].triangles, head().meshes[m].triangles);
    for (const auto& n : other.meshes[m].normals) ASSERT_NEAR(glm::length(n), 1.0F, 1e-4F);
  }
  EXPECT_GT(at(other, "2.1").y, at("2.1").y + 0.004);    // a shorter face
  EXPECT_GT(at(other, "2.13").x, at("2.13").x + 0.003);  // a wider jaw
  EXPECT_LT(at(other, "9.3").z, at("9.3").z - 0.002);    // a flatter nose
  EXPECT_LT(glm::distance(at(other, "3.5"), at("3.5")), 5e-4);
  EXPECT_EQ(at(other, "8.3"), at(other, "8.4") * glm::dvec3(-1.0, 1.0, 1.0));
}

TEST(SampleFamily, PressedLips_AreThinAndAllButTouch) {
  const SampleHead pressed = make_sample_head({.pressed_lips = true});
  EXPECT_GT(at(pressed, "2.2").y, at(pressed, "2.3").y);
  EXPECT_LT(at(pressed, "2.2").y - at(pressed, "2.3").y, 0.5 * (at("2.2").y - at("2.3").y));
  EXPECT_LT(at(pressed, "8.1").y - at(pressed, "8.2").y, 0.7 * (at("8.1").y - at("8.2").y));
}

TEST(SampleFamily, ClosedEyes_HaveTheUpperLidsOnTheLowerOnes) {
  const SampleHead closed = make_sample_head({.closed_eyes = true});
  const double opening = at(closed, "3.1").y - at(closed, "3.3").y;
  EXPECT_GT(opening, 0.0);
  EXPECT_LT(opening, 0.1 * (at("3.1").y - at("3.3").y));
  EXPECT_EQ(at(closed, "3.7"), at("3.7"));
}

}  // namespace
}  // namespace semblante
