#include "core/propose/found_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/anatomy/face_search.h"
#include "core/anatomy/face_tilt.h"
#include "core/anatomy/front_relief.h"
#include "core/anatomy/part_roles.h"
#include "core/anatomy/role_by_name.h"
#include "core/geometry/rotation.h"
#include "core/propose/face_front.h"
#include "core/propose/face_surface.h"
#include "core/propose/mouth_and_eyes.h"
#include "core/propose/seen_mouth.h"
#include "core/propose/seen_opening.h"
#include "core/types/feature_point_id.h"
#include "core/types/places.h"

namespace semblante {
namespace {

// All lengths in ES0.

constexpr double nose_top = -0.15;
constexpr double nose_bottom = -1.1;
constexpr double nose_step = 0.01;
constexpr double above_mouth = 0.10;
/// By how much a nose stands out before the places above and below it.
constexpr double least_nose = 0.02;

/// Standard deviations, from heads with points that people placed (bench_propose).
constexpr double noise_of_pupil = 0.01;
constexpr double noise_of_middle = 0.03;
constexpr double noise_of_corner = 0.05;
constexpr double noise_of_nose = 0.05;
/// Of a place that only the likeness of the whole face shows.
constexpr double noise_of_likeness = 0.10;

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

/// The cosine of the angle between the direction from eye to eye and X: below the first the head is refused, from the
/// second on it is taken for upright at first.
constexpr double least_side_by_side = 0.5;
constexpr double clearly_side_by_side = 0.95;

struct PointsOfEye {
  std::string_view pupil, upper, lower, left, right;
};
constexpr PointsOfEye points_of_left_eye = {"3.5", "3.1", "3.3", "3.7", "3.11"};
constexpr PointsOfEye points_of_right_eye = {"3.6", "3.2", "3.4", "3.8", "3.12"};

glm::dvec3 centre_of(const Part& part) { return 0.5 * (glm::dvec3(part.box_min) + glm::dvec3(part.box_max)); }
double radius_of(const Part& eye, const Similarity& frame) {
  return 0.5 * frame.scale * double(eye.box_max.y - eye.box_min.y);
}

struct Eyeballs {
  const Part* left = nullptr;
  const Part* right = nullptr;
};

Result<Eyeballs> find_eyeballs(std::span<const Part> parts) {
  const auto left = largest_part(parts, PartRole::left_eye);
  const auto right = largest_part(parts, PartRole::right_eye);
  if (!left || !right) return refused("the model has no two eyeballs that are parts of their own");
  const Eyeballs eyes{&parts[left->value()], &parts[right->value()]};
  const glm::dvec3 apart = centre_of(*eyes.left) - centre_of(*eyes.right);
  if (!(apart.x > least_side_by_side * glm::length(apart)))
    return refused("the eyes are not side by side: the head is turned in its file");
  return eyes;
}

/// The first frame of the face. Small angles between the eyes are left to the points: eyes of one face differ in
/// height.
Similarity frame_between(const Eyeballs& eyes) {
  const glm::dvec3 left = centre_of(*eyes.left);
  const glm::dvec3 right = centre_of(*eyes.right);
  const glm::dvec3 apart = left - right;
  Similarity frame;
  frame.scale = 1.0 / glm::length(apart);
  frame.from = 0.5 * (left + right);
  if (!(apart.x > clearly_side_by_side * glm::length(apart)))
    frame.rotation = rotation_between(glm::normalize(apart), {1.0, 0.0, 0.0});
  return frame;
}

/// The nose and the mouth, which every face has. Whether the mouth is seen.
bool find_nose_and_mouth(Found& found, const FaceFront& front) {
  const auto mouth = find_seen_mouth(front);
  if (const auto nose = find_nose(front, mouth ? mouth->middle.upper.place.y + above_mouth : nose_bottom))
    found.add("9.3", *nose, noise_of_nose);
  if (!mouth) return false;
  found.add("2.2", mouth->middle.upper, noise_of_middle);
  found.add("2.3", mouth->middle.lower, noise_of_middle);
  found.add("2.4", mouth->left.upper, noise_of_corner);
  found.add("2.5", mouth->right.upper, noise_of_corner);
  return true;
}

/// The eyes where their balls are seen between the lids.
class EyesOfBalls {
 public:
  EyesOfBalls(const Surface& surface, std::span<const Part> parts, const Eyeballs& eyes, const Similarity& frame)
      : parts_(parts), eyes_(eyes), frame_(frame), face_(surface, parts, frame) {}

  void find(Found& found, const FaceFront& front) const {
    find_one(found, front, *eyes_.left, points_of_left_eye);
    find_one(found, front, *eyes_.right, points_of_right_eye);
  }

 private:
  void find_one(Found& found, const FaceFront& front, const Part& eye, const PointsOfEye& points) const {
    const glm::dvec3 centre = frame_(centre_of(eye));
    const double radius = radius_of(eye, frame_);
    const glm::dvec3 pupil = find_pupil(face_, parts_, eye.role, centre + glm::dvec3(0.0, 0.0, radius));
    found.add_at(points.pupil, std::nullopt, frame_.back(pupil), noise_of_pupil);
    const auto opening = find_seen_opening(front, centre, radius);
    if (!opening) return;
    found.add(points.upper, opening->upper, noise_of_middle);
    found.add(points.lower, opening->lower, noise_of_middle);
    found.add(points.left, opening->left, noise_of_corner);
    found.add(points.right, opening->right, noise_of_corner);
  }

  std::span<const Part> parts_;
  const Eyeballs& eyes_;
  const Similarity& frame_;
  FaceSurface face_;
};

/// The part on which the middle of a face lies is skin, whatever its size and name.
void make_skin_at(std::vector<Part>& parts, const Surface& surface, const glm::dvec3& place) {
  const auto nearest = std::min_element(
      surface.positions.begin(), surface.positions.end(),
      [&](const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, place) < glm::distance(b, place); });
  Part& part = parts[surface.part_of[static_cast<std::size_t>(nearest - surface.positions.begin())].value()];
  if (!part.role_by_user) part.role = PartRole::skin;
}

/// The greatest distance of a pupil from the plane of the frame's origin. What is deeper is the back of the head, seen
/// through a hole for the eye.
constexpr double deepest_pupil = 0.4;

/// Of eyes that lie in the skin, or are painted on it.
void find_pupils_by_likeness(Found& found, const FaceFront& front, const Similarity& frame) {
  for (const auto& [name, x] : {std::pair("3.5", 0.5), std::pair("3.6", -0.5)}) {
    const auto seen = front.column(x).at(0.0);
    const bool is_eye = seen && std::abs(seen->z) < deepest_pupil;
    const glm::dvec3 pupil(x, 0.0, is_eye ? seen->z : 0.0);
    found.add_at(name, std::nullopt, frame.back(pupil), noise_of_likeness);
  }
}

/// Of lips that are joined: the outer ones, which lie on open skin.
void find_lips_by_likeness(Found& found, const FaceFront& front, std::span<const ReferenceHead> references) {
  const auto mean = mean_of(references);
  for (const std::string_view name : {"8.1", "8.2", "8.3", "8.4"}) {
    const auto& place = mean[parse_feature_point(name)->value()];
    if (!place) continue;
    if (const auto spot = front.spot(front.column(place->x + FaceFront::middle), *place))
      found.add(name, *spot, noise_of_likeness);
  }
}

/// How often a face is looked at again from where it looks to.
constexpr int most_turns = 3;

/// The rotation by which points that were found in `frame` show that the face is not upright there.
std::optional<glm::dmat3> turn_by(std::span<const FoundPoint> points, const Similarity& frame,
                                  std::span<const ReferenceHead> references) {
  Places places;
  for (const FoundPoint& f : points) places[f.point.id.value()] = frame(glm::dvec3(f.point.position));
  return upright_rotation(places, references);
}

/// Slopes of upright faces: sideways, and of nodding, in which people differ.
constexpr double straight_slope = 0.1;
constexpr double nodding_slope = 0.25;

bool looks_straight(const SeenFace& face) {
  return std::abs(face.slopes.x) < straight_slope && std::abs(face.slopes.y) < nodding_slope;
}

/// From the model's frame to that of a face that is looked at straight from its front.
std::optional<Similarity> frame_by_likeness(const Surface& surface, std::span<const Triangle> triangles,
                                            std::span<const ReferenceHead> references) {
  std::optional<Similarity> frame;
  glm::dmat3 turn(1.0);
  for (int turns = 0; turns <= most_turns; ++turns) {
    const auto relief = FrontRelief::draw(surface, triangles, turn);
    auto face = relief ? search_face(*relief, references) : std::nullopt;
    if (!face && relief && turns == 0) face = search_leaning_face(*relief, references);
    if (!face) break;
    frame = face->frame;
    frame->from = glm::transpose(turn) * face->frame.from;
    frame->rotation = face->frame.rotation * turn;
    if (looks_straight(*face)) break;
    const glm::dvec3 forward = glm::normalize(glm::dvec3(-face->slopes, 1.0));
    turn = rotation_between(forward, {0.0, 0.0, 1.0}) * frame->rotation;
  }
  return frame;
}

}  // namespace

Result<std::vector<FoundPoint>> find_points_by_eyeballs(const Surface& surface, std::span<const Part> described,
                                                        std::span<const Triangle> triangles,
                                                        std::span<const ReferenceHead> references) {
  const std::vector<Part> parts = with_lids_as_skin(described);
  const auto eyes = find_eyeballs(parts);
  if (!eyes) return eyes.error();
  Similarity frame = frame_between(*eyes);
  for (int turns = 0;; ++turns) {
    const FaceFront front(surface, parts, triangles, frame);
    Found found(surface);
    EyesOfBalls(surface, parts, *eyes, frame).find(found, front);
    find_nose_and_mouth(found, front);
    std::vector<FoundPoint> points = found.take();
    const auto turn = turns < most_turns ? turn_by(points, frame, references) : std::nullopt;
    if (!turn) return points;
    frame.rotation = *turn * frame.rotation;
  }
}

std::vector<FoundPoint> find_points_by_likeness(const Surface& surface, std::span<const Part> described,
                                                std::span<const Triangle> triangles,
                                                std::span<const ReferenceHead> references) {
  const auto frame = frame_by_likeness(surface, triangles, references);
  if (!frame) return {};
  std::vector<Part> parts = with_lids_as_skin(described);
  make_skin_at(parts, surface, frame->from);
  const FaceFront front(surface, parts, triangles, *frame);
  Found found(surface);
  find_pupils_by_likeness(found, front, *frame);
  if (!find_nose_and_mouth(found, front)) find_lips_by_likeness(found, front, references);
  return found.take();
}

}  // namespace semblante
