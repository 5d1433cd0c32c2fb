#include "core/anatomy/modelled_eye.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/anatomy/opening_margins.h"

namespace semblante {
namespace {

constexpr double radius = 1.2;

/// The upper edge of the opening: an arc from corner to corner, 0.35 high; the lower one is its mirror image.
double edge_at(double x) { return 0.35 * (1.0 - x * x); }

/// One sheet of skin over a ball of radius 1.2 about the origin, with an opening two units wide in which the ball is
/// seen; skin around it stands `step` before the ball.
struct SculptedEye {
  explicit SculptedEye(double step) {
    constexpr int columns = 60;
    constexpr int rows = 48;
    for (int r = 0; r <= rows; ++r) {
      for (int c = 0; c <= columns; ++c) {
        const double x = -1.15 + 2.3 * c / columns;
        const double y = -0.7 + 1.4 * r / rows;
        const bool is_eye = std::abs(x) < 1.0 && std::abs(y) < edge_at(x);
        const double z = std::sqrt(std::max(0.0, radius * radius - x * x - y * y));
        model.positions.emplace_back(x, y, z + (is_eye ? 0.0 : step));
      }
    }
    const auto at = [](int r, int c) { return static_cast<std::uint32_t>(r * (columns + 1) + c); };
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) {
        model.triangles.push_back({at(r, c), at(r, c + 1), at(r + 1, c + 1)});
        model.triangles.push_back({at(r, c), at(r + 1, c + 1), at(r + 1, c)});
      }
    }
    surface = build_surface(model);
    parts.emplace_back().role = PartRole::skin;
    // The rows above and below the opening, and the columns beside it.
    mark("3.1", 0.0, edge_at(0.0) + 0.03);
    mark("3.3", 0.0, -edge_at(0.0) - 0.03);
    mark("3.7", 1.02, 0.0);
    mark("3.11", -1.02, 0.0);
  }

  void mark(const char* name, double x, double y) {
    const auto id = parse_feature_point(name).value();
    std::erase_if(points, [id](const SurfacePoint& p) { return p.id == id; });
    SurfaceVertexId best(0);
    const auto off = [&](SurfaceVertexId v) {
      return std::hypot(surface.positions[v.value()].x - x, surface.positions[v.value()].y - y);
    };
    for (std::uint32_t v = 0; v < surface.vertex_count(); ++v) {
      if (off(SurfaceVertexId(v)) < off(best)) best = SurfaceVertexId(v);
    }
    points.push_back({id, best, surface.positions[best.value()]});
  }

  [[nodiscard]] std::optional<ModelledEye> left() const {
    return find_modelled_eyes(surface, model.triangles, parts, points)[0];
  }

  Model model;
  Surface surface;
  std::vector<Part> parts;
  std::vector<SurfacePoint> points;
};

TEST(ModelledEye, BallBetweenLidsIsHeld) {
  const SculptedEye head(0.08);
  const auto eye = head.left();
  ASSERT_TRUE(eye.has_value());
  ASSERT_FALSE(eye->held.empty());
  for (const SurfaceVertexId v : eye->held) {
    const glm::dvec3& p = head.surface.positions[v.value()];
    EXPECT_NEAR(glm::length(p), radius, 1e-6);
    EXPECT_LT(std::abs(p.y), edge_at(p.x));
  }
  ASSERT_TRUE(eye->ball.has_value());
  EXPECT_NEAR(eye->ball->radius, radius, 0.05 * radius);
  EXPECT_NEAR(eye->upper.y, edge_at(0.0), 0.05);
  EXPECT_NEAR(eye->lower.y, -edge_at(0.0), 0.05);
}

// What lies on the edges meets: the way of the middle, by its share, is the height of the opening there.
TEST(ModelledEye, EdgesGoAsFarAsTheEyeIsOpen) {
  const SculptedEye head(0.08);
  const auto eye = head.left();
  ASSERT_TRUE(eye.has_value());
  EXPECT_GE(eye->rim.size(), 30U);
  const double open = eye->upper.y - eye->lower.y;
  for (const ModelledEye::RimPlace& place : eye->rim) {
    const glm::dvec3& p = head.surface.positions[place.vertex.value()];
    EXPECT_EQ(place.is_upper, p.y > 0.0) << p.x;
    EXPECT_NEAR(std::abs(p.y) - place.share * open, -edge_at(p.x), 0.06) << p.x;
    EXPECT_FALSE(std::binary_search(eye->held.begin(), eye->held.end(), place.vertex));
  }
}

TEST(ModelledEye, ItsEdgesAreThePlacesOfMargins) {
  const SculptedEye head(0.08);
  const auto eye = head.left();
  ASSERT_TRUE(eye.has_value());
  const auto sites = margin_sites(head.surface, head.points, {eye, std::nullopt});
  ASSERT_GE(sites.size(), 30U);
  for (const MarginSite& site : sites) {
    const auto place = std::find_if(eye->rim.begin(), eye->rim.end(),
                                    [&](const ModelledEye::RimPlace& p) { return p.vertex == site.vertex; });
    ASSERT_NE(place, eye->rim.end());
    const auto middle = parse_feature_point(place->is_upper ? "3.1" : "3.3").value();
    double share = 0.0;
    for (const auto& [id, of_point] : site.shares) share += id == middle ? of_point : 0.0;
    EXPECT_DOUBLE_EQ(share, place->share);
  }
}

TEST(ModelledEye, ASheetWithoutAStepHasNone) { EXPECT_FALSE(SculptedEye(0.0).left().has_value()); }

TEST(ModelledEye, APointOnTheBallLeavesItAlone) {
  SculptedEye head(0.08);
  head.mark("3.3", 0.0, -0.1);
  EXPECT_FALSE(head.left().has_value());
}

TEST(ModelledEye, ACornerOnTheBallLeavesItAlone) {
  SculptedEye head(0.08);
  head.mark("3.11", -0.7, 0.0);
  EXPECT_FALSE(head.left().has_value());
}

TEST(ModelledEye, AHeadWithAnEyeballHasNone) {
  SculptedEye head(0.08);
  head.parts.emplace_back().role = PartRole::left_eye;
  EXPECT_FALSE(head.left().has_value());
}

TEST(ModelledEye, MissingPointsFindNothing) {
  SculptedEye head(0.08);
  head.points.pop_back();
  EXPECT_FALSE(head.left().has_value());
}

}  // namespace
}  // namespace semblante
