#include "core/anatomy/eye_skin.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>

#include <glm/geometric.hpp>

namespace semblante {
namespace {

// Lengths in widths of the eye, which is about half of ES0.
/// The skin that is looked at, about the middle of the lids' points.
constexpr glm::dvec3 reach(0.9, 0.7, 0.7);
/// Lids stand this far before the ball, at least.
constexpr double least_lid_step = 0.05;
/// The patch from which on a ball is fitted to it, and the radii of balls.
constexpr double least_for_ball = 0.15;
constexpr double least_radius = 0.25;
constexpr double greatest_radius = 2.0;
/// A ball with a greater radius is none to roll on: the eye is flat.
constexpr double flat_radius = 1.0;
/// A patch ends where the surface bends forward by more than this between two triangles, or where a triangle is turned
/// by more than `greatest_turn` against the ball (cosine of 35 degrees). Radians.
constexpr double groove = 0.35;
constexpr double greatest_turn = 0.82;
/// The patch covers at least this share of the opening between the points, seen from the front.
constexpr double least_covered = 0.45;
/// At least this share of the patch's outline is a groove; the rest ends between the points. A membrane has none.
constexpr double least_grooved = 0.6;
/// What lies so far behind other skin is hidden by it.
constexpr double least_gap = 0.01;
/// A patch that has not filled the eye after so many rings of triangles is a strip that winds.
constexpr int most_rings = 400;
/// Knots of the view from the front.
constexpr double knots_per_width = 80.0;

/// The vertices of `all` that are not of `others`; rising.
std::vector<SurfaceVertexId> difference(std::vector<SurfaceVertexId> all, std::vector<SurfaceVertexId> others) {
  for (auto* const list : {&all, &others}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  std::vector<SurfaceVertexId> rest;
  std::set_difference(all.begin(), all.end(), others.begin(), others.end(), std::back_inserter(rest));
  return rest;
}

}  // namespace

double EyeOpening::width() const { return glm::distance(p_.right, p_.left); }

glm::dvec3 EyeOpening::middle() const { return 0.25 * (p_.upper + p_.lower + p_.right + p_.left); }

bool EyeOpening::is_sane() const {
  return width() > 0.0 && arc(p_.upper.x) > 0.0 && arc(p_.lower.x) > 0.0 && p_.upper.y > p_.lower.y;
}

bool EyeOpening::contains(const glm::dvec3& at) const {
  return arc(at.x) > 0.0 && height(p_.lower, at.x) - beyond_ < at.y && at.y < height(p_.upper, at.x) + beyond_;
}

double EyeOpening::area() const {
  const double across = std::abs(p_.left.x - p_.right.x);
  const auto of = [&](const glm::dvec3& m) { return (m.y - base(m.x)) / arc(m.x) * across * across * across / 6.0; };
  return of(p_.upper) - of(p_.lower);
}

double EyeOpening::base(double x) const {
  return p_.right.y + (p_.left.y - p_.right.y) * (x - p_.right.x) / (p_.left.x - p_.right.x);
}

double EyeOpening::height(const glm::dvec3& middle, double x) const {
  return base(x) + (middle.y - base(middle.x)) * arc(x) / arc(middle.x);
}

EyeSkin::EyeSkin(const Surface& surface, std::span<const glm::dvec3> places, std::span<const Triangle> triangles,
                 PartId part, const EyeOpening& opening, double width)
    : places_(places), opening_(opening), width_(width) {
  const glm::dvec3 middle = opening.middle();
  const auto is_near = [&](SurfaceVertexId v) {
    const glm::dvec3 d = (place(v) - middle) / width_;
    return surface.part_of[v.value()] == part && std::abs(d.x) < reach.x && std::abs(d.y) < reach.y &&
           std::abs(d.z) < reach.z;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> at_edge;
  for (const Triangle& t : triangles) {
    const Corners c = {surface.surface_of[t[0]], surface.surface_of[t[1]], surface.surface_of[t[2]]};
    if (!is_near(c[0]) || !is_near(c[1]) || !is_near(c[2])) continue;
    const glm::dvec3& a = place(c[0]);
    const glm::dvec3& b = place(c[1]);
    const glm::dvec3& d = place(c[2]);
    const glm::dvec3 normal = glm::cross(b - a, d - a);
    const double length = glm::length(normal);
    if (!(length > 0.0)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = c[k].value();
      const std::uint32_t to = c[(k + 1) % 3].value();
      at_edge[std::minmax(from, to)].push_back(faces_.size());
    }
    faces_.push_back({c, normal / length, (a + b + d) / 3.0, 0.5 * length, {}});
  }
  for (const auto& [edge, faces] : at_edge) {
    if (faces.size() != 2) continue;
    faces_[faces[0]].beside.push_back(faces[1]);
    faces_[faces[1]].beside.push_back(faces[0]);
  }
  of_eye_.assign(faces_.size(), false);
}

bool EyeSkin::find_eye() {
  if (!grow_from(opening_.middle())) return false;
  const bool is_grooved = grooved_share() > least_grooved;
  add_holes();
  double area = 0.0;
  for (const std::size_t f : patch_) area += faces_[f].area * faces_[f].normal.z;
  return area > least_covered * opening_.area() && is_grooved;
}

bool EyeSkin::find_welded_eye() {
  if (!grow_from(opening_.middle()) || !ball()) return false;
  if (hidden_share() <= least_grooved) return false;
  double area = 0.0;
  for (const std::size_t f : patch_) area += faces_[f].area * std::max(faces_[f].normal.z, 0.0);
  if (area <= least_covered * opening_.area()) return false;
  for (std::size_t k = 0; k < patch_.size(); ++k) {
    const Face& from = faces_[patch_[k]];
    for (const std::size_t next : from.beside) {
      if (of_eye_[next] || !is_on_ball(faces_[next]) || bends_forward(from, faces_[next])) continue;
      of_eye_[next] = true;
      patch_.push_back(next);
    }
  }
  is_welded_ = true;
  return true;
}

bool EyeSkin::grow_from(const glm::dvec3& at) {
  of_eye_.assign(faces_.size(), false);
  patch_.clear();
  ball_.reset();
  const auto seed = front_face(at);
  if (!seed || !opening_.contains(faces_[*seed].middle)) return false;
  patch_ = {*seed};
  of_eye_[*seed] = true;
  int rings = 0;
  for (std::size_t grown = 0; grown != patch_.size(); ++rings) {
    if (rings == most_rings) return false;
    grown = patch_.size();
    ball_ = ball_of_patch();
    for (std::size_t k = 0; k < grown; ++k) {
      for (const std::size_t next : faces_[patch_[k]].beside) {
        if (of_eye_[next] || !continues(faces_[patch_[k]], faces_[next])) continue;
        of_eye_[next] = true;
        patch_.push_back(next);
      }
    }
  }
  return true;
}

EyeSkin::View EyeSkin::view() const {
  View view;
  const glm::dvec3 half = width_ * reach;
  view.origin = glm::dvec2(opening_.middle() - half);
  view.step = width_ / knots_per_width;
  view.columns = 1 + static_cast<int>(2.0 * half.x / view.step);
  view.rows = 1 + static_cast<int>(2.0 * half.y / view.step);
  view.z.assign(view.size(), -std::numeric_limits<double>::infinity());
  view.is_eye.assign(view.size(), false);
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const auto& [a, b, c] = faces_[f].corners;
    view.visit_knots({place(a), place(b), place(c)}, [&](std::size_t knot, double z) {
      if (z <= view.z[knot]) return;
      view.z[knot] = z;
      view.is_eye[knot] = of_eye_[f];
    });
  }
  return view;
}

std::optional<Sphere> EyeSkin::ball() const {
  return ball_ && ball_->radius < flat_radius * width_ ? ball_ : std::nullopt;
}

bool EyeSkin::is_on_ball(SurfaceVertexId v) const {
  return ball_ && std::all_of(faces_.begin(), faces_.end(), [&](const Face& face) {
           return std::find(face.corners.begin(), face.corners.end(), v) == face.corners.end() || is_on_ball(face);
         });
}

std::vector<SurfaceVertexId> EyeSkin::inner_vertices() const {
  std::vector<SurfaceVertexId> inside;
  std::vector<SurfaceVertexId> outside;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    auto& list = of_eye_[f] ? inside : outside;
    list.insert(list.end(), faces_[f].corners.begin(), faces_[f].corners.end());
  }
  return difference(std::move(inside), std::move(outside));
}

std::vector<SurfaceVertexId> EyeSkin::vertices_on_ball() const {
  std::vector<SurfaceVertexId> on_ball;
  std::vector<SurfaceVertexId> outside;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    auto& list = of_eye_[f] || (ball_ && is_on_ball(faces_[f])) ? on_ball : outside;
    list.insert(list.end(), faces_[f].corners.begin(), faces_[f].corners.end());
  }
  return difference(std::move(on_ball), std::move(outside));
}

std::optional<EyeSkin::Seen> EyeSkin::seen_at(double x) const {
  struct Piece {
    glm::dvec3 low, high;
    bool is_eye;
  };
  std::vector<Piece> pieces;
  std::vector<double> heights;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    std::vector<glm::dvec3> cut;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3& a = place(faces_[f].corners[k]);
      const glm::dvec3& b = place(faces_[f].corners[(k + 1) % 3]);
      if ((a.x < x) != (b.x < x)) cut.push_back(a + (x - a.x) / (b.x - a.x) * (b - a));
    }
    if (cut.size() != 2) continue;
    if (cut[0].y > cut[1].y) std::swap(cut[0], cut[1]);
    if (of_eye_[f]) heights.insert(heights.end(), {cut[0].y, cut[1].y});
    pieces.push_back({cut[0], cut[1], of_eye_[f]});
  }
  if (heights.empty()) return std::nullopt;
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  constexpr int steps = 200;
  std::optional<Seen> seen;
  for (int k = 0; k <= steps; ++k) {
    const double y = *low + (*high - *low) * (k + 0.5) / (steps + 1);
    double z = -std::numeric_limits<double>::infinity();
    bool is_eye = false;
    for (const Piece& piece : pieces) {
      if ((piece.low.y < y) == (piece.high.y < y)) continue;
      const double share = (y - piece.low.y) / (piece.high.y - piece.low.y);
      const double at = piece.low.z + share * (piece.high.z - piece.low.z);
      if (at <= z) continue;
      z = at;
      is_eye = piece.is_eye;
    }
    if (!is_eye || (is_welded_ && !opening_.contains({x, y, z}))) continue;
    if (!seen) seen = Seen{{x, y, z}, {x, y, z}};
    seen->upper = {x, y, z};
  }
  return seen;
}

std::pair<double, double> EyeSkin::across() const {
  std::pair<double, double> ends(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (!of_eye_[f]) continue;
    for (const SurfaceVertexId v : faces_[f].corners) {
      ends.first = std::min(ends.first, place(v).x);
      ends.second = std::max(ends.second, place(v).x);
    }
  }
  return ends;
}

std::optional<SurfaceVertexId> EyeSkin::nearest_but(std::span<const SurfaceVertexId> held, const glm::dvec3& to) const {
  std::optional<SurfaceVertexId> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Face& face : faces_) {
    for (const SurfaceVertexId v : face.corners) {
      const double away = glm::distance(place(v), to);
      if (away >= least || std::binary_search(held.begin(), held.end(), v)) continue;
      least = away;
      best = v;
    }
  }
  return best;
}

std::optional<std::size_t> EyeSkin::front_face(const glm::dvec3& at) const {
  std::optional<std::size_t> best;
  double foremost = -std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    if (!(face.normal.z > 0.0) || face.middle.z < foremost) continue;
    bool is_inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3& a = place(face.corners[k]);
      const glm::dvec3& b = place(face.corners[(k + 1) % 3]);
      is_inside = is_inside && (b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x) >= 0.0;
    }
    if (!is_inside) continue;
    foremost = face.middle.z;
    best = f;
  }
  return best;
}

std::optional<Sphere> EyeSkin::ball_of_patch() const {
  std::vector<SurfaceVertexId> vertices;
  glm::dvec3 normal(0.0);
  for (const std::size_t f : patch_) {
    vertices.insert(vertices.end(), faces_[f].corners.begin(), faces_[f].corners.end());
    normal += faces_[f].area * faces_[f].normal;
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::vector<glm::dvec3> positions;
  glm::dvec3 middle(0.0);
  for (const SurfaceVertexId v : vertices) {
    positions.push_back(place(v));
    middle += place(v) / static_cast<double>(vertices.size());
  }
  double extent = 0.0;
  for (const glm::dvec3& p : positions) extent = std::max(extent, glm::distance(p, middle));
  constexpr std::size_t least_vertices = 9;
  if (extent < least_for_ball * width_ || positions.size() < least_vertices) return std::nullopt;
  const double length = glm::length(normal);
  if (!(length > 0.0)) return std::nullopt;
  normal /= length;
  std::optional<Sphere> ball = fit_sphere(positions);
  const bool is_hollow = ball && glm::dot(middle - ball->center, normal) < 0.0;
  const double radius = !ball || is_hollow ? greatest_radius * width_ : ball->radius;
  const double within = std::clamp(radius, least_radius * width_, greatest_radius * width_);
  if (!ball || is_hollow || within != radius) ball = Sphere{middle - within * normal, within, 0.0};
  return ball;
}

void EyeSkin::add_holes() {
  std::vector<bool> known = of_eye_;
  std::vector<std::size_t> pending;
  const auto visit = [&](std::size_t f) {
    if (known[f]) return;
    known[f] = true;
    pending.push_back(f);
  };
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (!opening_.contains(faces_[f].middle)) visit(f);
  }
  while (!pending.empty()) {
    const std::size_t at = pending.back();
    pending.pop_back();
    for (const std::size_t next : faces_[at].beside) visit(next);
  }
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (known[f]) continue;
    of_eye_[f] = true;
    patch_.push_back(f);
  }
}

template <class Ends>
double EyeSkin::share_of_outline(const Ends& ends) const {
  std::size_t outline = 0;
  std::size_t ended = 0;
  for (const std::size_t f : patch_) {
    for (const std::size_t next : faces_[f].beside) {
      if (of_eye_[next]) continue;
      ++outline;
      if (ends(faces_[f], faces_[next])) ++ended;
    }
  }
  return outline > 0 ? static_cast<double>(ended) / static_cast<double>(outline) : 0.0;
}

double EyeSkin::grooved_share() const {
  return share_of_outline([&](const Face& from, const Face& to) { return !is_smooth(from, to); });
}

double EyeSkin::hidden_share() const {
  return share_of_outline([&](const Face& from, const Face& to) {
    const auto front = front_face(to.middle);
    const bool is_hidden = front && faces_[*front].middle.z > to.middle.z + least_gap * width_;
    return is_hidden || !is_smooth(from, to);
  });
}

bool EyeSkin::continues(const Face& from, const Face& to) const {
  return opening_.contains(to.middle) && is_smooth(from, to);
}

bool EyeSkin::is_smooth(const Face& from, const Face& to) const {
  if (!(to.normal.z > 0.0)) return false;
  if (bends_forward(from, to)) return false;
  if (!ball_) return glm::dot(from.normal, to.normal) > greatest_turn;
  return is_on_ball(to);
}

bool EyeSkin::bends_forward(const Face& from, const Face& to) {
  return glm::dot(from.normal, to.middle - from.middle) > 0.0 && glm::dot(from.normal, to.normal) < std::cos(groove);
}

bool EyeSkin::is_on_ball(const Face& face) const {
  const glm::dvec3 d = face.middle - ball_->center;
  const double distance = glm::length(d);
  return std::abs(distance - ball_->radius) < least_lid_step * width_ &&
         glm::dot(face.normal, d) > greatest_turn * distance;
}

}  // namespace semblante
