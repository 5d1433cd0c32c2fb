#include "core/propose/found_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>

#include "core/anatomy/role_by_name.h"
#include "core/propose/face_front.h"
#include "core/propose/face_surface.h"
#include "core/propose/mouth_and_eyes.h"
#include "core/propose/seen_mouth.h"
#include "core/types/feature_point_id.h"

namespace semblante {
namespace {

// All lengths in ES0.

constexpr double nose_top = -0.15;
constexpr double nose_bottom = -1.1;
constexpr double nose_step = 0.01;
constexpr double above_mouth = 0.10;
/// By how much a nose stands out before the places above and below it.
constexpr double least_nose = 0.02;
/// The height of an open eye, as a share of its width.
constexpr double least_open = 0.15;

/// Standard deviations, from heads with points that people placed (bench_propose).
constexpr double noise_of_pupil = 0.01;
constexpr double noise_of_middle = 0.03;
constexpr double noise_of_corner = 0.05;
constexpr double noise_of_nose = 0.05;

/// Lids that are parts of their own count as skin here. Before any of their points are known they are taken for what
/// lies on an eye, or for a part of it.
std::vector<Part> with_lids_as_skin(std::span<const Part> parts) {
  std::vector<Part> changed(parts.begin(), parts.end());
  for (Part& part : changed) {
    if (!part.role_by_user && is_lid_name(part.name)) part.role = PartRole::skin;
  }
  return changed;
}

/// The most forward place of the middle between the eyes and the mouth, if it stands out.
std::optional<SeenSpot> find_nose(const FaceFront& front, double low) {
  const FrontColumn column = front.column(FaceFront::middle);
  std::optional<glm::dvec3> tip;
  double first = -std::numeric_limits<double>::infinity();
  double last = first;
  for (int k = 0; nose_top - k * nose_step > low; ++k) {
    const double y = nose_top - k * nose_step;
    const auto seen = column.at(y);
    if (!seen || !seen->is_skin) continue;
    if (std::isinf(first)) first = seen->z;
    last = seen->z;
    if (!tip || seen->z > tip->z) tip = glm::dvec3(0.0, y, seen->z);
  }
  if (!tip || tip->z < std::max(first, last) + least_nose) return std::nullopt;
  return front.spot(column, *tip);
}

/// An eye as it is seen between its lids.
struct SeenOpening {
  SeenSpot upper, lower, left, right;
};

/// The columns on both sides of the middle of an eye in which its ball is seen, without a gap, with their x: from right
/// to left.
std::vector<std::pair<double, SeenEye>> columns_of_eye(const FaceFront& front, const glm::dvec3& centre,
                                                       double radius) {
  constexpr int steps = 24;
  const double step = radius / steps;
  const double reach = 1.2 * radius;
  std::vector<std::pair<double, SeenEye>> columns;
  const auto look = [&](int first, double direction) {
    for (int k = first; k <= 2 * steps; ++k) {
      const double x = centre.x + direction * k * step;
      const auto eye = front.eye(x, centre.y - reach, centre.y + reach);
      if (!eye) return;
      columns.emplace_back(x, *eye);
    }
  };
  look(0, -1.0);
  std::reverse(columns.begin(), columns.end());
  look(1, 1.0);
  return columns;
}

std::optional<SeenOpening> find_opening(const FaceFront& front, const glm::dvec3& centre, double radius) {
  const auto columns = columns_of_eye(front, centre, radius);
  if (columns.empty()) return std::nullopt;
  const auto spot_at = [&](double x, const glm::dvec3& place) { return front.spot(front.column(x), place); };
  const auto corner = [&](const std::pair<double, SeenEye>& end) {
    const auto& [x, eye] = end;
    const auto upper = spot_at(x, eye.upper);
    return upper ? std::optional(SeenSpot{0.5 * (eye.upper + eye.lower), upper->vertex}) : std::nullopt;
  };
  const double first = columns.front().first;
  const double width = columns.back().first - first;
  // A ball may lie aside of the opening: the middle of the lids is not far from that of the eye.
  const double middle = std::clamp(centre.x, first + 0.4 * width, first + 0.6 * width);
  const auto& [x, seen] = *std::min_element(columns.begin(), columns.end(), [&](const auto& a, const auto& b) {
    return std::abs(a.first - middle) < std::abs(b.first - middle);
  });
  // The slit of an eye that is shut may end anywhere.
  if (seen.upper.y - seen.lower.y < least_open * width) return std::nullopt;
  const auto upper = spot_at(x, seen.upper);
  const auto lower = spot_at(x, seen.lower);
  const auto left = corner(columns.back());
  const auto right = corner(columns.front());
  if (!upper || !lower || !left || !right) return std::nullopt;
  return SeenOpening{*upper, *lower, *left, *right};
}

Error refused(std::string why) { return Error{ErrorCode::missing, "/points", std::move(why)}; }

/// The points found so far, none at the vertex of another.
class Found {
 public:
  explicit Found(const Surface& surface) : surface_(surface) {}

  void add(std::string_view name, const SeenSpot& spot, double noise) {
    const bool is_taken = std::any_of(points_.begin(), points_.end(), [&](const FoundPoint& p) {
      return p.point.vertex && surface_.surface_of[p.point.vertex->value()] == spot.vertex;
    });
    if (is_taken) return;
    const VertexId vertex = surface_.file_vertex_of[spot.vertex.value()];
    add_at(name, vertex, surface_.positions[spot.vertex.value()], noise);
  }
  void add_at(std::string_view name, std::optional<VertexId> vertex, const glm::dvec3& position, double noise) {
    points_.push_back({{*parse_feature_point(name), vertex, glm::vec3(position)}, noise});
  }

  std::vector<FoundPoint> take() {
    std::sort(points_.begin(), points_.end(),
              [](const FoundPoint& a, const FoundPoint& b) { return a.point.id < b.point.id; });
    return std::move(points_);
  }

 private:
  const Surface& surface_;
  std::vector<FoundPoint> points_;
};

struct PointsOfEye {
  std::string_view pupil, upper, lower, left, right;
};
constexpr PointsOfEye points_of_left_eye = {"3.5", "3.1", "3.3", "3.7", "3.11"};
constexpr PointsOfEye points_of_right_eye = {"3.6", "3.2", "3.4", "3.8", "3.12"};

glm::dvec3 centre_of(const Part& part) { return 0.5 * (glm::dvec3(part.box_min) + glm::dvec3(part.box_max)); }
double radius_of(const Part& eye, const Similarity& frame) {
  return 0.5 * frame.scale * double(eye.box_max.y - eye.box_min.y);
}

/// `pupil`: in the model's frame.
void find_eye(Found& found, const FaceFront& front, const glm::dvec3& pupil, const Similarity& frame, const Part& eye,
              const PointsOfEye& points) {
  found.add_at(points.pupil, std::nullopt, pupil, noise_of_pupil);
  const auto opening = find_opening(front, frame(centre_of(eye)), radius_of(eye, frame));
  if (!opening) return;
  found.add(points.upper, opening->upper, noise_of_middle);
  found.add(points.lower, opening->lower, noise_of_middle);
  found.add(points.left, opening->left, noise_of_corner);
  found.add(points.right, opening->right, noise_of_corner);
}

}  // namespace

Result<std::vector<FoundPoint>> find_points_by_shape(const Surface& surface, std::span<const Part> described,
                                                     std::span<const Triangle> triangles) {
  const std::vector<Part> parts = with_lids_as_skin(described);
  const auto left_part = largest_part(parts, PartRole::left_eye);
  const auto right_part = largest_part(parts, PartRole::right_eye);
  if (!left_part || !right_part) return refused("the model has no two eyeballs that are parts of their own");
  const Part& left = parts[left_part->value()];
  const Part& right = parts[right_part->value()];
  const glm::dvec3 apart = centre_of(left) - centre_of(right);
  constexpr double side_by_side = 0.95;  // cosine
  if (!(apart.x > side_by_side * glm::length(apart)))
    return refused("the eyes are not side by side: the head is turned in its file");

  Similarity frame;
  frame.scale = 1.0 / glm::length(apart);
  frame.from = 0.5 * (centre_of(left) + centre_of(right));
  const FaceFront front(surface, parts, triangles, frame);
  const FaceSurface face(surface, parts, frame);
  const auto pupil_of = [&](const Part& eye) {
    const glm::dvec3 front_of_ball = frame(centre_of(eye)) + glm::dvec3(0.0, 0.0, radius_of(eye, frame));
    return frame.from + find_pupil(face, parts, eye.role, front_of_ball) / frame.scale;
  };

  Found found(surface);
  find_eye(found, front, pupil_of(left), frame, left, points_of_left_eye);
  find_eye(found, front, pupil_of(right), frame, right, points_of_right_eye);
  const auto mouth = find_seen_mouth(front);
  if (const auto nose = find_nose(front, mouth ? mouth->middle.upper.place.y + above_mouth : nose_bottom))
    found.add("9.3", *nose, noise_of_nose);
  if (mouth) {
    found.add("2.2", mouth->middle.upper, noise_of_middle);
    found.add("2.3", mouth->middle.lower, noise_of_middle);
    found.add("2.4", mouth->left.upper, noise_of_corner);
    found.add("2.5", mouth->right.upper, noise_of_corner);
  }
  return found.take();
}

}  // namespace semblante
