#include "deploy/sample_head/body.h"

#include <cmath>
#include <numbers>
#include <span>

#include <glm/geometric.hpp>

#include "deploy/sample_head/emit.h"

namespace semblante::sample_head_detail {
namespace {

using std::numbers::pi;

/// A cross-section of a tube: an ellipse about `centre` with half axes `across` and `deep`.
struct Section {
  Vec3 centre;
  double across, deep;
};

/// Adds a tube through sections, which are perpendicular to the line from the first centre to the last, and closes it
/// at both ends. `depth_axis`: direction of the half axes `deep`.
void add_tube(HalfMesh& mesh, std::span<const Section> sections, const Vec3& depth_axis, int sides) {
  const Vec3 along = glm::normalize(sections.back().centre - sections.front().centre);
  const Vec3 across = glm::normalize(glm::cross(depth_axis, along));
  const Vec3 deep = glm::cross(along, across);
  const auto ring = [&](const Section& section) {
    Loop loop;
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * pi * i / sides;
      loop.push_back(mesh.add(section.centre + across * (section.across * std::cos(angle)) +
                              deep * (section.deep * std::sin(angle))));
    }
    return loop;
  };
  Loop above = ring(sections.front());
  Loop backwards(above.rbegin(), above.rend());
  close_with_fan(mesh, backwards, true, mesh.add(sections.front().centre), Chart::outer);
  for (const Section& section : sections.subspan(1)) {
    const Loop loop = ring(section);
    bridge(mesh, above, loop, true, Chart::outer);
    above = loop;
  }
  close_with_fan(mesh, above, true, mesh.add(sections.back().centre), Chart::outer);
}

/// The left half of an upright tube about the mirror plane, from its top down.
void add_trunk(HalfMesh& mesh, std::span<const Section> sections, int steps) {
  const auto ring = [&](const Section& section) {
    Loop loop;
    for (int i = 0; i <= steps; ++i) {
      const double angle = pi * i / steps;
      const double x = i == 0 || i == steps ? 0.0 : section.across * std::sin(angle);
      loop.push_back(mesh.add(section.centre + Vec3(x, 0.0, section.deep * std::cos(angle))));
    }
    return loop;
  };
  Loop above = ring(sections.front());
  close_with_fan(mesh, above, false, mesh.add(sections.front().centre), Chart::outer);
  for (const Section& section : sections.subspan(1)) {
    const Loop loop = ring(section);
    bridge(mesh, above, loop, false, Chart::outer);
    above = loop;
  }
  close_with_fan(mesh, above, false, mesh.add(sections.back().centre), Chart::outer);
  orient(mesh, {0.0, 1.0, 0.0});
}

HalfMesh make_torso() {
  // The upper rows are inside the shirt of the bust.
  constexpr Section sections[] = {
      {{0, -20.0, -4.0}, 8.5, 5.5},   {{0, -23.0, -4.0}, 13.5, 8.2},  {{0, -27.0, -3.8}, 14.8, 9.6},
      {{0, -32.0, -3.6}, 14.9, 10.4}, {{0, -38.0, -3.6}, 14.2, 10.2}, {{0, -45.0, -3.7}, 13.4, 9.6},
      {{0, -52.0, -3.8}, 13.2, 9.2},  {{0, -59.0, -3.9}, 14.0, 9.6},  {{0, -64.0, -4.0}, 14.9, 10.2}};
  HalfMesh mesh;
  add_trunk(mesh, sections, 20);
  return mesh;
}

HalfMesh make_sleeves() {
  constexpr Section sections[] = {{{12.5, -21.5, -4.2}, 3.0, 3.4}, {{14.5, -23.5, -4.2}, 4.8, 5.0},
                                  {{16.5, -28.0, -4.3}, 5.2, 5.4}, {{18.5, -35.0, -4.5}, 4.7, 5.0},
                                  {{20.8, -46.0, -4.8}, 4.1, 4.4}, {{22.8, -57.0, -4.3}, 3.7, 3.9},
                                  {{24.6, -67.0, -3.5}, 3.1, 3.3}, {{25.0, -69.0, -3.3}, 3.1, 3.3}};
  HalfMesh mesh;
  add_tube(mesh, sections, {0.0, 0.0, 1.0}, 16);
  return mesh;
}

HalfMesh make_hands() {
  HalfMesh mesh;
  // A palm that faces the thigh: thin from side to side, then four fingers and the thumb.
  constexpr Section palm[] = {{{24.7, -67.5, -3.4}, 2.2, 2.4},
                              {{25.2, -71.0, -3.0}, 1.5, 3.0},
                              {{25.8, -75.0, -2.7}, 1.4, 3.9},
                              {{26.3, -78.5, -2.4}, 1.2, 3.9}};
  add_tube(mesh, palm, {0.0, 0.0, 1.0}, 12);
  constexpr double length[] = {6.2, 7.2, 6.8, 5.4};
  for (int finger = 0; finger < 4; ++finger) {
    const Vec3 root(26.2, -78.0, 0.5 - 1.9 * finger);
    const Vec3 along = length[finger] * Vec3(0.06, -1.0, 0.02);
    const Section sections[] = {
        {root, 0.85, 0.9}, {root + along * 0.4, 0.85, 0.9}, {root + along * 0.8, 0.7, 0.75}, {root + along, 0.3, 0.35}};
    add_tube(mesh, sections, {0.0, 0.0, 1.0}, 8);
  }
  constexpr Section thumb[] = {{{25.3, -71.5, -0.8}, 1.0, 1.2},
                               {{25.4, -74.0, 1.5}, 1.0, 1.0},
                               {{25.6, -77.0, 2.9}, 0.8, 0.8},
                               {{25.7, -78.4, 3.3}, 0.3, 0.3}};
  add_tube(mesh, thumb, {0.0, 0.7, 0.7}, 8);
  return mesh;
}

/// The part of the trousers about the hips.
HalfMesh make_hips() {
  constexpr Section sections[] = {{{0, -61.0, -4.0}, 14.3, 9.7},
                                  {{0, -66.0, -4.1}, 15.4, 10.5},
                                  {{0, -72.0, -4.2}, 15.9, 10.7},
                                  {{0, -77.0, -4.2}, 14.6, 9.6},
                                  {{0, -81.0, -4.2}, 9.0, 6.5}};
  HalfMesh mesh;
  add_trunk(mesh, sections, 20);
  return mesh;
}

HalfMesh make_legs() {
  constexpr Section sections[] = {{{6.5, -70.0, -4.0}, 6.0, 7.0},  {{7.4, -76.0, -4.2}, 7.6, 8.8},
                                  {{8.2, -84.0, -4.2}, 7.9, 9.4},  {{8.8, -98.0, -4.0}, 6.9, 7.8},
                                  {{9.2, -112.0, -3.9}, 5.8, 6.3}, {{9.4, -126.0, -4.6}, 5.7, 6.2},
                                  {{9.6, -140.0, -5.0}, 5.0, 5.3}, {{9.7, -152.0, -5.2}, 4.8, 5.0}};
  HalfMesh mesh;
  add_tube(mesh, sections, {0.0, 0.0, 1.0}, 18);
  return mesh;
}

HalfMesh make_shoes() {
  constexpr Section sections[] = {{{9.7, -154.5, -10.0}, 2.2, 2.6}, {{9.7, -154.0, -7.5}, 3.6, 4.4},
                                  {{9.8, -154.0, -3.0}, 3.9, 4.4},  {{10.1, -155.4, 3.0}, 4.3, 3.0},
                                  {{10.4, -156.0, 9.0}, 4.4, 2.4},  {{10.5, -156.6, 13.5}, 2.4, 1.6}};
  HalfMesh mesh;
  add_tube(mesh, sections, {0.0, 1.0, 0.0}, 14);
  return mesh;
}

}  // namespace

std::vector<BodyPart> make_body_parts() {
  return {{"torso", BodyPart::Look::shirt, make_torso()},  {"sleeves", BodyPart::Look::shirt, make_sleeves()},
          {"hands", BodyPart::Look::skin, make_hands()},   {"hips", BodyPart::Look::trousers, make_hips()},
          {"legs", BodyPart::Look::trousers, make_legs()}, {"shoes", BodyPart::Look::trousers, make_shoes()}};
}

Vec2 bare_skin_uv() { return outer_uv({5.0, -15.0, -2.0}); }

}  // namespace semblante::sample_head_detail
