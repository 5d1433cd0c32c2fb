// Proposals for the lids of a sculpture, whose eyes are modelled in one skin and are not at the same height.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/anatomy/reference_heads.h"
#include "core/propose/propose.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

using testing::fp;

constexpr double half_width = 0.21;  // of an eye, in ES0
constexpr double higher = 0.07;      // how much higher the right eye is than the left one, in ES0

/// One skin: two balls of radius 1.2 in half widths of the eye, and lids that stand `step` before them.
class Sculpture {
 public:
  explicit Sculpture(double step, double higher_right = higher)
      : step_(step), middles_{glm::dvec2{0.5, 0.0}, glm::dvec2{-0.5, higher_right}} {
    constexpr int columns = 200;
    constexpr int rows = 90;
    for (int r = 0; r <= rows; ++r) {
      for (int c = 0; c <= columns; ++c) {
        const double x = -0.9 + 1.8 * c / columns;
        const double y = -0.4 + 0.87 * r / rows;
        model_.positions.emplace_back(x, y, depth(x, y));
      }
    }
    const auto at = [](int r, int c) { return static_cast<std::uint32_t>(r * (columns + 1) + c); };
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) {
        model_.triangles.push_back({at(r, c), at(r, c + 1), at(r + 1, c + 1)});
        model_.triangles.push_back({at(r, c), at(r + 1, c + 1), at(r + 1, c)});
      }
    }
    surface_ = build_surface(model_);
    part_.role = PartRole::skin;
    // The rest of the face as on a reference head, with the left eye and a corner of the right one on the rims.
    const auto& reference = reference_heads().front();
    for (std::uint8_t id = 0; id < feature_point_count; ++id) {
      const std::string name = to_string(FeaturePointId(id));
      if (reference.points[id] && name.substr(0, 2) != "3.")
        known_.push_back({FeaturePointId(id), std::nullopt, glm::vec3(*reference.points[id])});
    }
    mark("3.1", 0, 0.0, 0.37);
    mark("3.3", 0, 0.0, -0.37);
    mark("3.7", 0, 1.02, 0.0);
    mark("3.11", 0, -1.02, 0.0);
    mark("3.12", 1, -1.02, 0.0);
    std::sort(known_.begin(), known_.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  }

  [[nodiscard]] Proposals propose(std::span<const Triangle> triangles) const {
    return propose_feature_points(surface_, {&part_, 1}, known_, reference_heads(), {}, triangles).value();
  }
  [[nodiscard]] const Model& model() const { return model_; }

  /// A place in half widths of the right eye, from its middle.
  [[nodiscard]] glm::dvec2 in_right_eye(const glm::vec3& p) const { return (glm::dvec2(p) - middles_[1]) / half_width; }

 private:
  [[nodiscard]] double depth(double x, double y) const {
    const glm::dvec2 p = (glm::dvec2(x, y) - middles_[x > 0.0 ? 0 : 1]) / half_width;
    const bool is_eye = std::abs(p.x) < 1.0 && std::abs(p.y) < 0.35 * (1.0 - p.x * p.x);
    return half_width * (std::sqrt(std::max(0.3, 1.44 - p.x * p.x - p.y * p.y)) + (is_eye ? 0.0 : step_) - 1.2);
  }

  void mark(std::string_view name, std::size_t eye, double x, double y) {
    const glm::dvec2 place = middles_[eye] + half_width * glm::dvec2(x, y);
    const auto away = [&](const glm::vec3& p) { return glm::distance(glm::dvec2(p), place); };
    const auto at = std::min_element(model_.positions.begin(), model_.positions.end(),
                                     [&](const glm::vec3& a, const glm::vec3& b) { return away(a) < away(b); });
    known_.push_back({fp(name), VertexId(static_cast<std::uint32_t>(at - model_.positions.begin())), *at});
  }

  double step_;
  std::array<glm::dvec2, 2> middles_;  ///< left, right
  Model model_;
  Surface surface_;
  Part part_;
  FeaturePointSet known_;
};

const Proposal& proposal(const Proposals& proposals, std::string_view name) {
  return *std::find_if(proposals.points.begin(), proposals.points.end(),
                       [&](const Proposal& p) { return p.point.id == fp(name); });
}

TEST(ProposeModelledRims, LidsOfAnEyeThatIsHigherThanTheOtherAreOnItsRims) {
  const Sculpture head(0.08);
  const Proposals proposals = head.propose(head.model().triangles);
  const glm::dvec2 upper = head.in_right_eye(proposal(proposals, "3.2").point.position);
  const glm::dvec2 lower = head.in_right_eye(proposal(proposals, "3.4").point.position);
  const glm::dvec2 corner = head.in_right_eye(proposal(proposals, "3.8").point.position);
  EXPECT_NEAR(upper.y, 0.35, 0.06);
  EXPECT_NEAR(upper.x, 0.0, 0.2);
  EXPECT_NEAR(lower.y, -0.35, 0.06);
  EXPECT_NEAR(lower.x, 0.0, 0.2);
  EXPECT_NEAR(corner.x, 1.1, 0.15);
  EXPECT_NEAR(corner.y, 0.0, 0.15);
  for (const char* const name : {"3.2", "3.4", "3.8"})
    EXPECT_EQ(proposal(proposals, name).method, ProposalMethod::shape) << name;
}

TEST(ProposeModelledRims, ThePupilOfAnEyeThatIsHigherThanTheOtherIsInItsMiddle) {
  const Sculpture head(0.08);
  const glm::vec3 pupil = proposal(head.propose(head.model().triangles), "3.6").point.position;
  EXPECT_NEAR(head.in_right_eye(pupil).x, 0.0, 0.15);
  EXPECT_NEAR(head.in_right_eye(pupil).y, 0.0, 0.1);
  EXPECT_NEAR(pupil.z, 0.0, 0.02);
  const glm::vec3 before = proposal(head.propose({}), "3.6").point.position;
  EXPECT_GT(std::abs(head.in_right_eye(before).y), 0.2) << "the mirror image is elsewhere";
}

TEST(ProposeModelledRims, MirrorImagesOnTheRimsStay) {
  const Sculpture head(0.08, 0.0);
  const Proposals proposals = head.propose(head.model().triangles);
  for (const char* const name : {"3.2", "3.4", "3.8"})
    EXPECT_EQ(proposal(proposals, name).method, ProposalMethod::mirror) << name;
}

TEST(ProposeModelledRims, WithoutAStepOrWithoutTrianglesMirrorImagesStay) {
  const Sculpture head(0.08);
  const Sculpture mask(0.0);
  for (const Proposals& proposals : {head.propose({}), mask.propose(mask.model().triangles)}) {
    for (const char* const name : {"3.2", "3.4", "3.8"}) {
      const Proposal& p = proposal(proposals, name);
      EXPECT_EQ(p.method, ProposalMethod::mirror) << name;
      EXPECT_LT(std::abs(p.point.position.y - (name == std::string("3.2")   ? 0.37 * half_width
                                               : name == std::string("3.4") ? -0.37 * half_width
                                                                            : 0.0)),
                0.02)
          << name;
    }
  }
}

}  // namespace
}  // namespace semblante
