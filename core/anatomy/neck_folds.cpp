#include "core/anatomy/neck_folds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

namespace semblante {
namespace {

constexpr std::uint8_t full = 255;

constexpr int greatest_steps = 100;  ///< of the smoothing
constexpr int patience = 10;         ///< steps without less skin turned over

/// A turn of the whole head: its axis, and sine and cosine of half its angle, 0.6 rad.
struct Turn {
  int axis;
  double sine;
  double cosine = 0.955336489125606;
};
constexpr double half_sine = 0.29552020666133955;
constexpr std::array<Turn, 6> turns = {
    {{0, half_sine}, {0, -half_sine}, {1, half_sine}, {1, -half_sine}, {2, half_sine}, {2, -half_sine}}};

/// A place with this share of the turn, by the kernel's blend of quaternions.
glm::dvec3 turned_place(const glm::dvec3& from_pivot, const Turn& turn, double share) {
  const double x = share * turn.sine;
  const double w = 1.0 - share + share * turn.cosine;
  const double cosine = (w * w - x * x) / (w * w + x * x);
  const double sine = 2.0 * w * x / (w * w + x * x);
  const int u = (turn.axis + 1) % 3;
  const int v = (turn.axis + 2) % 3;
  glm::dvec3 result = from_pivot;
  result[u] = cosine * from_pivot[u] - sine * from_pivot[v];
  result[v] = sine * from_pivot[u] + cosine * from_pivot[v];
  return result;
}

using Corners = std::array<std::uint32_t, 3>;

/// The neck's triangles, by surface vertices.
std::vector<Corners> triangles_of_neck(const Surface& surface, std::span<const Triangle> triangles,
                                       std::span<const std::uint8_t> turn) {
  std::vector<Corners> neck;
  for (const Triangle& t : triangles) {
    Corners corners{};
    bool is_partial = false;
    for (std::size_t c = 0; c < 3; ++c) {
      corners[c] = surface.surface_of[t[c]].value();
      is_partial = is_partial || (turn[corners[c]] > 0 && turn[corners[c]] < full);
    }
    if (is_partial) neck.push_back(corners);
  }
  return neck;
}

glm::dvec3 twice_area(const std::array<glm::dvec3, 3>& p) { return glm::cross(p[1] - p[0], p[2] - p[0]); }

class NeckShares {
 public:
  NeckShares(const Surface& surface, std::vector<Corners> triangles, const glm::dvec3& pivot,
             std::span<const std::uint8_t> turn)
      : surface_(surface), triangles_(std::move(triangles)), pivot_(pivot), turn_(turn) {
    for (const std::uint8_t t : turn) share_.push_back(static_cast<double>(t) / full);
  }

  /// The sum over all turns of the area that turns over. `at_fold`: the vertices of those triangles.
  double area_turned_over(std::vector<bool>& at_fold) const {
    at_fold.assign(share_.size(), false);
    double area = 0.0;
    for (const Corners& corners : triangles_) {
      std::array<glm::dvec3, 3> rest;
      for (std::size_t c = 0; c < 3; ++c) rest[c] = surface_.positions[corners[c]] - pivot_;
      const glm::dvec3 before = twice_area(rest);
      for (const Turn& turn : turns) {
        std::array<glm::dvec3, 3> moved;
        for (std::size_t c = 0; c < 3; ++c) moved[c] = turned_place(rest[c], turn, share_[corners[c]]);
        const glm::dvec3 after = twice_area(moved);
        if (glm::dot(before, after) >= 0.0) continue;
        area += glm::length(after);
        for (const std::uint32_t v : corners) at_fold[v] = true;
      }
    }
    return area;
  }

  /// Moves the shares at folds, and beside them, half way to the mean of their neighbours.
  void smooth(const std::vector<bool>& at_fold) {
    std::vector<bool> chosen = at_fold;
    for (std::uint32_t v = 0; v < share_.size(); ++v) {
      if (!at_fold[v]) continue;
      for (const Surface::Step& step : surface_.steps_from(SurfaceVertexId(v))) chosen[step.to.value()] = true;
    }
    std::vector<double> next = share_;
    for (std::uint32_t v = 0; v < share_.size(); ++v) {
      if (!chosen[v] || turn_[v] == 0 || turn_[v] == full) continue;
      double sum = 0.0;
      double weights = 0.0;
      for (const Surface::Step& step : surface_.steps_from(SurfaceVertexId(v))) {
        if (!(step.length > 0.0)) continue;
        sum += share_[step.to.value()] / step.length;
        weights += 1.0 / step.length;
      }
      if (weights > 0.0) next[v] = 0.5 * (share_[v] + sum / weights);
    }
    share_ = std::move(next);
  }

  [[nodiscard]] const std::vector<double>& shares() const { return share_; }

 private:
  const Surface& surface_;
  std::vector<Corners> triangles_;
  glm::dvec3 pivot_;
  std::span<const std::uint8_t> turn_;
  std::vector<double> share_;
};

}  // namespace

void unfold_neck(const Surface& surface, std::span<const Triangle> triangles, const glm::vec3& head_pivot,
                 std::span<std::uint8_t> turn) {
  NeckShares neck(surface, triangles_of_neck(surface, triangles, turn), glm::dvec3(head_pivot), turn);
  std::vector<bool> at_fold;
  double least = neck.area_turned_over(at_fold);
  if (least == 0.0) return;
  std::vector<double> best = neck.shares();
  int best_step = 0;
  for (int step = 1; step <= greatest_steps && step <= best_step + patience && least > 0.0; ++step) {
    neck.smooth(at_fold);
    const double area = neck.area_turned_over(at_fold);
    if (area >= least) continue;
    least = area;
    best = neck.shares();
    best_step = step;
  }
  for (std::size_t s = 0; s < turn.size(); ++s) {
    if (turn[s] > 0 && turn[s] < full)
      turn[s] = static_cast<std::uint8_t>(std::clamp(std::lround(full * best[s]), 1L, long{full - 1}));
  }
}

}  // namespace semblante
