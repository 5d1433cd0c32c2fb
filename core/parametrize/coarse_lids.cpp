#include "core/parametrize/coarse_lids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "core/anatomy/lids.h"
#include "core/expressions/kernel_rig.h"
#include "core/geometry/triangle_shape.h"
#include "core/kernel/semblante_kernel.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

// FAPs of the left eye; those of the right one are the next.
constexpr std::size_t close_upper_lid = 19;
constexpr std::size_t close_lower_lid = 21;
constexpr std::size_t pitch_of_eye = 25;

/// The closures of upper and lower lid that are tried, each with all gazes below.
constexpr std::array<std::array<double, 2>, 5> closures = {
    {{1.0, 0.0}, {0.5, 0.0}, {0.5, 0.5}, {0.25, 0.25}, {0.0, 1.0}}};
/// Pitches of the gaze, radians.
constexpr std::array gazes = {-0.35, 0.0, 0.35};
/// Places along each edge of a triangle.
constexpr int places_along = 6;
/// A place is in the ball if it is deeper than this; of the ball's radius, as all lengths below.
constexpr double depth_in_ball = 0.005;
/// Of all places in all poses, the share in the ball from which on lids are coarse. It is 0 on heads of five
/// thousand vertices and more, 0.0007 to 0.009 on the same heads of 3000 to 600 and on others of few vertices.
constexpr double least_cut = 0.0002;
/// Triangles whose edges are all shorter cannot reach into the ball, even if a closing lid doubles the edges: their
/// vertices keep a greater distance from the ball (lids.c).
constexpr double long_edge = 0.2;
/// The lifts that are tried: multiples of `step`.
constexpr int steps = 10;
constexpr double step = 0.06;
/// A lift of one costs as much as this share of what is cut: lids that stand far out are no better.
constexpr double price = 0.5;

/// The places on a triangle, as shares of its corners.
std::vector<glm::dvec3> shares_of_places() {
  constexpr double of_edge = 1.0 / places_along;
  std::vector<glm::dvec3> shares;
  for (int i = 0; i <= places_along; ++i) {
    for (int j = 0; i + j <= places_along; ++j)
      shares.emplace_back(i * of_edge, j * of_edge, (places_along - i - j) * of_edge);
  }
  return shares;
}

/// The lids of one eye as a mesh of their own, that takes poses.
class LidMesh {
 public:
  LidMesh(const Model& model, const Rig& rig, std::size_t eye)
      : lids_(*rig.lids[eye]),
        eye_(eye),
        pivot_(eye == 0 ? rig.left_eye_pivot : rig.right_eye_pivot),
        kernel_rig_(make_kernel_rig(rig)),
        irisd_(rig.fapu[FapuUnit::irisd].value_or(0.0)),
        largest_radius_(*std::max_element(lids_.ball.begin(), lids_.ball.end())) {
    const RigidMotion own = eye == 0 ? RigidMotion::left_lids : RigidMotion::right_lids;
    const std::vector<glm::dvec3> all_places = shares_of_places();
    std::vector<std::uint32_t> numbers(model.positions.size(), unknown);
    for (const Triangle& t : model.triangles) {
      if (std::none_of(t.begin(), t.end(), [&](std::uint32_t v) { return rig.rigid_of_vertex[v] == own; })) continue;
      if (rig.parts[rig.part_of_vertex[t[0]].value()].role != PartRole::skin) continue;
      Places before{t, {}};
      if (!find_places(corners_of(t, model.positions), all_places, before)) continue;
      for (std::uint32_t& v : before.triangle) v = number_of(model, rig, v, numbers);
      places_.push_back(std::move(before));
    }
  }

  /// The share of the places before the ball on the neutral face that are in it in other poses.
  [[nodiscard]] double cut(double lift) const {
    if (places_.empty() || !(irisd_ > 0.0)) return 0.0;
    semblante_rig rig = kernel_rig_.view();
    rig.lids[eye_].lift = static_cast<float>(lift);
    std::size_t in_ball = 0;
    for (const auto& closure : closures) {
      for (const double gaze : gazes) in_ball += count_in_ball(rig, closure, gaze);
    }
    return static_cast<double>(in_ball) / static_cast<double>(places_before_ball_ * closures.size() * gazes.size());
  }

 private:
  using Corners = std::array<glm::dvec3, 3>;

  /// Places on a triangle, as shares of its corners.
  struct Places {
    Triangle triangle;
    std::vector<glm::dvec3> shares;
  };

  static glm::dvec3 place(const glm::dvec3& shares, const Corners& corners) {
    return shares.x * corners[0] + shares.y * corners[1] + shares.z * corners[2];
  }

  [[nodiscard]] static double squared_longest_edge(const Corners& corners) {
    double longest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 edge = corners[(k + 1) % 3] - corners[k];
      longest = std::max(longest, glm::dot(edge, edge));
    }
    return longest;
  }

  [[nodiscard]] static Corners corners_of(const Triangle& triangle, const std::vector<glm::vec3>& at) {
    return {glm::dvec3(at[triangle[0]]), glm::dvec3(at[triangle[1]]), glm::dvec3(at[triangle[2]])};
  }

  static constexpr std::uint32_t unknown = ~0U;

  /// The number of a vertex in this mesh, which gets it if it has none.
  std::uint32_t number_of(const Model& model, const Rig& rig, std::uint32_t file_vertex,
                          std::vector<std::uint32_t>& numbers) {
    if (numbers[file_vertex] != unknown) return numbers[file_vertex];
    const auto points = rig.influence.points_of(file_vertex);
    const auto weights = rig.influence.weights_of(file_vertex);
    for (std::size_t k = 0; k < points.size(); ++k) moved_.influence.push(points[k], weights[k]);
    moved_.influence.end_row();
    moved_.rigid_of_vertex.push_back(rig.rigid_of_vertex[file_vertex]);
    rest_.push_back(model.positions[file_vertex]);
    return numbers[file_vertex] = static_cast<std::uint32_t>(rest_.size() - 1);
  }

  /// Counts the places of a triangle before the ball, on the outside of lids: the inside is hidden behind it, and may
  /// lie in the ball. Whether the triangle is large enough to cut the ball; `before` has the places then.
  bool find_places(const Corners& corners, const std::vector<glm::dvec3>& all_places, Places& before) {
    const glm::dvec3 outwards = area_vector(corners[0], corners[1], corners[2]);
    if (!(glm::dot(outwards, corners[0] - pivot_) > 0.0)) return false;
    const double longest = long_edge * lids_.ball.back();
    const bool is_large = squared_longest_edge(corners) > longest * longest;
    if (!is_large && is_before_ball(corners)) {
      places_before_ball_ += all_places.size();
      return false;
    }
    for (const glm::dvec3& shares : all_places) {
      const glm::dvec3 from = place(shares, corners) - pivot_;
      if (from.z > 0.0 && !is_in_ball(from, glm::dvec3(lids_.gaze), 0.0)) before.shares.push_back(shares);
    }
    places_before_ball_ += before.shares.size();
    return is_large && !before.shares.empty();
  }

  [[nodiscard]] bool is_in_ball(const glm::dvec3& from_pivot, const glm::dvec3& pole, double deep) const {
    const double distance = glm::length(from_pivot) + deep;
    return distance < largest_radius_ && distance < radius_towards(lids_, pole, from_pivot);
  }

  /// Whether no place of a triangle is in the ball, by the identity |sum a_k v_k|^2 = sum a_k |v_k|^2 -
  /// sum_{i<j} a_i a_j |v_i - v_j|^2 for shares a of its corners v: the products of shares sum to a third at most.
  [[nodiscard]] bool is_clear_of_ball(const Corners& corners) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& corner : corners) nearest = std::min(nearest, glm::dot(corner - pivot_, corner - pivot_));
    return nearest - squared_longest_edge(corners) / 3.0 > largest_radius_ * largest_radius_;
  }

  /// Whether all places of a triangle are before the ball.
  [[nodiscard]] bool is_before_ball(const Corners& corners) const {
    const bool is_in_front =
        std::all_of(corners.begin(), corners.end(), [&](const glm::dvec3& corner) { return corner.z > pivot_.z; });
    return is_in_front && is_clear_of_ball(corners);
  }

  [[nodiscard]] std::size_t count_in_ball(const semblante_rig& rig, const std::array<double, 2>& closure,
                                          double gaze) const {
    semblante_frame frame{};
    // Of an eye that is open wider than IRISD, the unit of FAPs 19 to 22 is its own opening (lids.h of core/kernel).
    const double whole = std::min(lids_.opening / irisd_, 1024.0);
    frame.fap[close_upper_lid + eye_] = static_cast<float>(closure[0] * whole);
    frame.fap[close_lower_lid + eye_] = static_cast<float>(closure[1] * whole);
    frame.fap[pitch_of_eye + eye_] = static_cast<float>(gaze / mpeg4::radians_per_au);
    semblante_pose pose;
    semblante_evaluate(&rig, &frame, &pose);
    const semblante_face face = make_kernel_face(moved_, &rest_[0].x);
    std::vector<glm::vec3> posed(rest_.size());
    semblante_deform(&face, &pose, &posed[0].x);
    const double sine = std::sin(gaze);
    const double cosine = std::cos(gaze);
    const glm::dvec3 g(lids_.gaze);
    const glm::dvec3 pole(g.x, cosine * g.y - sine * g.z, sine * g.y + cosine * g.z);
    const double deep = depth_in_ball * lids_.ball.back();
    std::size_t count = 0;
    for (const Places& places : places_) {
      const Corners corners = corners_of(places.triangle, posed);
      if (is_clear_of_ball(corners)) continue;
      for (const glm::dvec3& shares : places.shares)
        count += is_in_ball(place(shares, corners) - pivot_, pole, deep) ? 1 : 0;
    }
    return count;
  }

  const Lids& lids_;
  std::size_t eye_;
  glm::dvec3 pivot_;
  KernelRig kernel_rig_;
  double irisd_;
  double largest_radius_;
  std::size_t places_before_ball_ = 0;
  std::vector<Places> places_;   ///< places before the ball on triangles that are large enough to cut it
  std::vector<glm::vec3> rest_;  ///< the vertices of those triangles
  Rig moved_;                    ///< what moves the vertices: influence and rigid_of_vertex alone
};

double best_lift(const LidMesh& mesh) {
  const double unlifted = mesh.cut(0.0);
  if (unlifted <= least_cut) return 0.0;
  double best = 0.0;
  double least_cost = 1.0;
  for (int k = 1; k <= steps; ++k) {
    const double cost = mesh.cut(k * step) / unlifted + price * k * step;
    if (cost >= least_cost) continue;
    least_cost = cost;
    best = k * step;
  }
  return best;
}

}  // namespace

void lift_coarse_lids(const Model& model, Rig& rig) {
  for (std::size_t eye = 0; eye < rig.lids.size(); ++eye) {
    if (!rig.lids[eye] || !(rig.lids[eye]->ball.back() > 0.0F)) continue;
    rig.lids[eye]->lift = static_cast<float>(best_lift(LidMesh(model, rig, eye)));
  }
}

}  // namespace semblante
