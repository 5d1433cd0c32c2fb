// Whatever is proposed can be placed as it is, and the doctor does not refuse it afterwards: over all heads, the family
// of the sample head, coarse meshes, in which neighbouring points have the same nearest vertex, and heads that are
// turned, mirrored, scaled or noisy.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>

#include <glm/ext/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <gtest/gtest.h>

#include "core/anatomy/part_roles.h"
#include "core/anatomy/point_lookup.h"
#include "core/doctor/examine.h"
#include "core/geometry/insert_vertices.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/place_feature_points.h"
#include "core/propose/quick_set.h"
#include "core/tables/mpeg4.h"
#include "tests/bench/propose/proposal_study.h"
#include "tests/oracle/real_heads.h"

namespace semblante::bench {
namespace {

/// The model with all vertices of one cell of a grid merged; parts stay apart.
Model coarsened(const Model& model, const Surface& surface, double cell) {
  Model coarse;
  std::map<std::array<int, 4>, std::uint32_t> cells;
  std::vector<std::uint32_t> vertex_of;
  for (std::uint32_t v = 0; v < model.positions.size(); ++v) {
    const glm::vec3& p = model.positions[v];
    const auto index = [cell](float x) { return static_cast<int>(std::floor(static_cast<double>(x) / cell)); };
    const auto part = static_cast<int>(surface.part_of[surface.surface_of[v].value()].value());
    const auto [at, is_new] =
        cells.try_emplace({part, index(p.x), index(p.y), index(p.z)}, static_cast<std::uint32_t>(cells.size()));
    if (is_new) coarse.positions.push_back(p);
    vertex_of.push_back(at->second);
  }
  for (const Triangle& t : model.triangles) {
    const Triangle small = {vertex_of[t[0]], vertex_of[t[1]], vertex_of[t[2]]};
    if (small[0] != small[1] && small[1] != small[2] && small[2] != small[0]) coarse.triangles.push_back(small);
  }
  coarse.primitives.assign(1, Primitive{"", -1, 0, static_cast<std::uint32_t>(coarse.triangles.size())});
  return coarse;
}

std::uint32_t nearest_vertex(const Model& model, const glm::vec3& position) {
  const auto nearest = std::min_element(
      model.positions.begin(), model.positions.end(),
      [&](const auto& a, const auto& b) { return glm::distance(a, position) < glm::distance(b, position); });
  return static_cast<std::uint32_t>(nearest - model.positions.begin());
}

/// What the doctor says of points that cannot stay where they are.
bool is_refusal(FindingCode code) {
  return code == FindingCode::point_refused || code == FindingCode::point_on_no_surface ||
         code == FindingCode::point_on_wrong_part || code == FindingCode::points_on_one_vertex ||
         code == FindingCode::point_on_other_rim || code == FindingCode::left_right_swapped ||
         code == FindingCode::point_out_of_order;
}

/// Whether a finding is about the marked points alone. Merged cells put such a point on the vertex nearest to its
/// place, which may be on the other rim, or that of another point.
bool is_about_marked_points(const Finding& finding, const FeaturePointSet& known) {
  return (finding.code == FindingCode::point_on_other_rim || finding.code == FindingCode::point_out_of_order) &&
         std::all_of(finding.place.points.begin(), finding.place.points.end(), [&](FeaturePointId id) {
           return std::any_of(known.begin(), known.end(), [&](const FeaturePoint& p) { return p.id == id; });
         });
}

/// Whether a proposal with a remark is out of order: the mesh has no vertex for it, and the remark says so.
bool is_known_to_the_proposals(const Finding& finding, const Proposals& proposals) {
  return finding.code == FindingCode::point_out_of_order &&
         std::any_of(proposals.points.begin(), proposals.points.end(), [&](const Proposal& p) {
           const auto& concerned = finding.place.points;
           return !p.remark.empty() && std::find(concerned.begin(), concerned.end(), p.point.id) != concerned.end();
         });
}

/// The doctor refuses nothing but what it refuses of the marked points alone.
void expect_good_health(const std::string& name, const Model& model, const Surface& surface,
                        const FeaturePointSet& known, const Proposals& proposals, const FeaturePointSet& placed) {
  const auto examined = [&](const FeaturePointSet& points) {
    const auto rig = parametrize(model, surface, points);
    return rig ? examine(model, surface, *rig, WeightMethod::paper).findings : std::vector<Finding>{};
  };
  std::multiset<FindingCode> before;
  for (const Finding& finding : examined(known)) before.insert(finding.code);
  for (const Finding& finding : examined(placed)) {
    if (!is_refusal(finding.code) || is_about_marked_points(finding, known)) continue;
    if (is_known_to_the_proposals(finding, proposals)) continue;
    if (const auto at = before.find(finding.code); at != before.end()) {
      before.erase(at);
    } else {
      ADD_FAILURE() << name << ": " << finding.words;
    }
  }
}

/// `in_between` grows by the number of points that are proposed between vertices.
void expect_accepted(const std::string& name, const Model& model, const FeaturePointSet& known,
                     std::size_t* in_between = nullptr) {
  const Surface surface = build_surface(model);
  const auto proposals = propose_feature_points(surface, describe_parts(model, surface, known), known,
                                                reference_heads(), {}, model.triangles);
  ASSERT_TRUE(proposals) << name << ": " << proposals.error().message;
  std::vector<MarkedPoint> marked;
  std::set<std::uint32_t> taken;
  for (const FeaturePoint& p : known) {
    marked.push_back({p.id, p.vertex ? std::optional(p.vertex->value()) : std::nullopt, glm::dvec3(p.position)});
    if (p.vertex) taken.insert(surface.surface_of[p.vertex->value()].value());
  }
  for (const Proposal& p : proposals->points) {
    marked.push_back({p.point.id, p.point.vertex ? std::optional(p.point.vertex->value()) : std::nullopt,
                      glm::dvec3(p.point.position)});
    if (p.point.vertex) {
      EXPECT_TRUE(taken.insert(surface.surface_of[p.point.vertex->value()].value()).second)
          << name << ": " << to_string(p.point.id) << " shares its vertex";
    }
    EXPECT_TRUE(!is_pupil(p.point.id) || !p.point.vertex) << name << ": a pupil is a bare position";
  }
  for (const NotProposed& p : proposals->not_proposed)
    EXPECT_EQ(p.reason.find("already"), std::string::npos) << name << " " << to_string(p.id) << ": " << p.reason;
  std::vector<std::string> warnings;
  auto placed = place_feature_points(model, surface, marked, &warnings);
  ASSERT_TRUE(placed) << name << ": " << placed.error().message;
  EXPECT_TRUE(warnings.empty()) << name << ": " << warnings.front();
  EXPECT_EQ(placed->size(), marked.size()) << name;
  // Those between vertices get one each.
  Model whole = model;
  std::vector<TrianglePlace> between;
  for (const FeaturePoint& p : *placed) {
    if (p.between) between.push_back(*p.between);
  }
  if (in_between != nullptr) *in_between += between.size();
  const Insertion insertion = insert_vertices(whole, surface, between);
  auto vertex = insertion.vertex_of_place.begin();
  for (FeaturePoint& p : *placed) {
    if (!p.between) continue;
    EXPECT_TRUE(taken.insert(*vertex).second) << name << ": " << to_string(p.id) << " means the vertex of another";
    p = {p.id, VertexId(*vertex), whole.positions[*vertex]};
    ++vertex;
  }
  expect_good_health(name, whole, build_surface(whole), known, *proposals, *placed);
}

std::vector<ProposalStudy> all_heads() {
  std::vector<ProposalStudy> heads = make_sample_studies();
  if (const auto faces = oracle::faces_folder()) {
    for (ProposalStudy& study : read_proposal_studies(*faces)) heads.push_back(std::move(study));
  }
  return heads;
}

TEST(AcceptedProposals, OfAllHeadsAtSeveralLevelsOfDetail) {
  std::size_t in_between = 0;
  for (const ProposalStudy& study : all_heads()) {
    const FeaturePointSet known = some_points(study, {quick_set.begin(), quick_set.end()});
    expect_accepted(study.name, study.model, known);
    for (const double cell : {0.05, 0.1, 0.2}) {
      const Model coarse = coarsened(study.model, study.surface, cell * study.eye_separation);
      const Surface surface = build_surface(coarse);
      std::vector<MarkedPoint> marked;
      for (const FeaturePoint& p : known) {
        if (p.vertex)
          marked.push_back({p.id, nearest_vertex(coarse, p.position), std::nullopt});
        else
          marked.push_back({p.id, std::nullopt, glm::dvec3(p.position)});
      }
      const auto placed = place_feature_points(coarse, surface, marked, nullptr);
      ASSERT_TRUE(placed) << study.name << ": " << placed.error().message;
      expect_accepted(study.name + ", cells of " + std::to_string(cell) + " ES0", coarse, *placed, &in_between);
    }
  }
  EXPECT_GT(in_between, 0U);
}

struct Version {
  std::string name;
  /// The place of a vertex in the version; `random` is the same for every standard library.
  std::function<glm::vec3(const glm::vec3&, std::mt19937& random)> place;
  bool is_mirrored = false;
};

Version turned(const char* name, double radians, const glm::dvec3& axis) {
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), radians, axis);
  return {name, [turn](const glm::vec3& p, std::mt19937&) { return glm::vec3(turn * glm::dvec4(p, 1.0)); }};
}

std::vector<Version> versions(double eye_separation) {
  const auto noise = [eye_separation](std::mt19937& random) {
    return 0.005F * static_cast<float>(eye_separation) *
           (static_cast<float>(random()) / static_cast<float>(std::mt19937::max()) - 0.5F);
  };
  return {
      turned("nodding", 0.2, {1.0, 0.0, 0.0}),
      turned("looking aside", -0.2, {0.0, 1.0, 0.0}),
      turned("tilted", 0.2, {0.0, 0.0, 1.0}),
      {"mirrored", [](const glm::vec3& p, std::mt19937&) { return glm::vec3(-p.x, p.y, p.z); }, true},
      {"a thousand times as large", [](const glm::vec3& p, std::mt19937&) { return 1000.0F * p; }},
      {"a thousandth as large", [](const glm::vec3& p, std::mt19937&) { return 0.001F * p; }},
      {"lopsided", [](const glm::vec3& p, std::mt19937&) { return glm::vec3(1.06F * p.x, p.y + 0.05F * p.x, p.z); }},
      {"noisy",
       [noise](const glm::vec3& p, std::mt19937& random) {
         const float x = noise(random);  // one after the other: arguments have no order
         const float y = noise(random);
         return p + glm::vec3(x, y, noise(random));
       }},
  };
}

/// The model and its points in another version. Vertices at one place stay at one place.
std::pair<Model, FeaturePointSet> in_version(const Version& version, const Model& model, const Surface& surface,
                                             const FeaturePointSet& points) {
  std::mt19937 random(7);
  std::vector<glm::vec3> places;
  for (std::uint32_t s = 0; s < surface.vertex_count(); ++s) {
    places.push_back(version.place(model.positions[surface.file_vertex_of[s].value()], random));
  }
  Model other = model;
  for (std::uint32_t v = 0; v < other.positions.size(); ++v) {
    other.positions[v] = places[surface.surface_of[v].value()];
  }
  if (version.is_mirrored) {
    for (Triangle& t : other.triangles) std::swap(t[0], t[1]);
  }
  FeaturePointSet moved = points;
  std::mt19937 for_bare(8);
  for (FeaturePoint& p : moved) {
    p.position = p.vertex ? other.positions[p.vertex->value()] : version.place(p.position, for_bare);
    if (version.is_mirrored) p.id = FeaturePointId(mpeg4::feature_points[p.id.value()].mirror);
  }
  std::sort(moved.begin(), moved.end(), [](const FeaturePoint& a, const FeaturePoint& b) { return a.id < b.id; });
  return {std::move(other), std::move(moved)};
}

TEST(AcceptedProposals, OfAllHeadsTurnedMirroredScaledAndNoisy) {
  for (const ProposalStudy& study : all_heads()) {
    const FeaturePointSet known = some_points(study, {quick_set.begin(), quick_set.end()});
    for (const Version& version : versions(study.eye_separation)) {
      const auto [model, points] = in_version(version, study.model, study.surface, known);
      expect_accepted(study.name + ", " + version.name, model, points);
    }
  }
}

}  // namespace
}  // namespace semblante::bench
