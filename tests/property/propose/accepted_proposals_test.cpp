// Whatever is proposed can be placed as it is: over all heads, the family of the sample head, and coarse meshes, in
// which neighbouring points have the same nearest vertex.

#include <array>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "core/anatomy/part_roles.h"
#include "core/anatomy/point_lookup.h"
#include "core/parametrize/place_feature_points.h"
#include "core/propose/quick_set.h"
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

void expect_accepted(const std::string& name, const Model& model, const FeaturePointSet& known) {
  const Surface surface = build_surface(model);
  const auto proposals = propose_feature_points(surface, describe_parts(model, surface, known), known);
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
  const auto placed = place_feature_points(model, surface, marked, &warnings);
  ASSERT_TRUE(placed) << name << ": " << placed.error().message;
  EXPECT_TRUE(warnings.empty()) << name << ": " << warnings.front();
  EXPECT_EQ(placed->size(), marked.size()) << name;
}

TEST(AcceptedProposals, OfAllHeadsAtSeveralLevelsOfDetail) {
  std::vector<ProposalStudy> heads = make_sample_studies();
  if (const auto faces = oracle::faces_folder()) {
    for (ProposalStudy& study : read_proposal_studies(*faces)) heads.push_back(std::move(study));
  }
  for (const ProposalStudy& study : heads) {
    const FeaturePointSet known = some_points(study, {quick_set.begin(), quick_set.end()});
    expect_accepted(study.name, study.model, known);
    for (const double cell : {0.05, 0.1, 0.2}) {
      const Model coarse = coarsened(study.model, study.surface, cell * study.eye_separation);
      const Surface surface = build_surface(coarse);
      std::vector<MarkedPoint> marked;
      for (const FeaturePoint& p : known) marked.push_back({p.id, std::nullopt, glm::dvec3(p.position)});
      const auto placed = place_feature_points(coarse, surface, marked, nullptr);
      ASSERT_TRUE(placed) << study.name << ": " << placed.error().message;
      expect_accepted(study.name + ", cells of " + std::to_string(cell) + " ES0", coarse, *placed);
    }
  }
}

}  // namespace
}  // namespace semblante::bench
