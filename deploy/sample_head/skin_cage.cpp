#include "deploy/sample_head/skin_cage.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <span>
#include <sstream>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>

#include "deploy/sample_head/sculpt.h"
#include "deploy/sample_head/shirt.h"

namespace semblante::sample_head_detail {
namespace {

using std::numbers::pi;

struct NamedVertex {
  const char* name;
  double x, y, z;  ///< cm; rough, the sculpt determines the depth
};

// clang-format off
constexpr NamedVertex face_vertices[] = {
    // middle line, glabella to the base of the nose
    {"G", 0, 2.2, 9.4}, {"N0", 0, 0.5, 9.0}, {"N1", 0, -1.2, 9.7}, {"N2", 0, -2.4, 10.4}, {"N3", 0, -3.2, 11.3},
    {"N4", 0, -3.95, 11.6}, {"N5", 0, -4.5, 10.9}, {"M5_0", 0, -4.95, 9.9},
    // side of the nose
    {"aG", 0.7, 2.1, 9.3}, {"a0", 0.6, 0.5, 8.7}, {"a1", 0.7, -1.2, 9.1}, {"a2", 0.85, -2.4, 9.6},
    {"a3", 0.72, -3.2, 10.8}, {"a4", 0.6, -4.05, 11.1}, {"a5", 0.28, -4.5, 10.5}, {"b2", 1.6, -2.7, 8.8},
    // wing of the nose and rim of the nostril
    {"w3", 1.3, -3.35, 9.9}, {"w4", 1.74, -4.0, 9.4}, {"O1", 1.1, -4.15, 10.4}, {"O2", 1.5, -4.5, 9.7},
    {"M6_2", 2.05, -3.9, 8.7}, {"M5_2", 1.55, -5.0, 9.0}, {"M5_1", 0.62, -5.05, 9.6},
    {"h0", 0.55, -4.45, 10.5}, {"h1", 0.8, -4.45, 10.35}, {"h2", 1.0, -4.55, 9.95}, {"h3", 0.92, -4.65, 9.6},
    {"h4", 0.6, -4.65, 9.6}, {"h5", 0.42, -4.55, 10.0},
    // orbit, from the inner corner over the brow
    {"E0", 1.35, 0.1, 8.0}, {"E1", 1.6, 1.45, 8.5}, {"E2", 2.3, 2.05, 8.6}, {"E3", 3.2, 2.25, 8.5},
    {"E4", 4.2, 2.05, 8.1}, {"E5", 5.1, 1.45, 7.3}, {"E6", 5.45, 0.1, 6.6}, {"E7", 5.1, -1.15, 7.0},
    {"E8", 4.2, -1.85, 7.7}, {"E9", 3.2, -2.05, 8.0}, {"E10", 2.3, -1.85, 8.1}, {"E11", 1.6, -1.15, 8.2},
    // brow and forehead foot, temple, cheek
    {"W0", 0, 3.6, 9.2}, {"aW", 0.75, 3.6, 9.1}, {"W1", 1.5, 3.5, 9.0}, {"W2", 2.6, 3.75, 8.7},
    {"W3", 3.8, 3.7, 8.2}, {"W4", 5.0, 3.3, 7.2}, {"W5", 6.0, 2.4, 5.9}, {"T6", 6.4, 0.2, 5.4},
    {"H7", 6.1, -1.7, 5.8}, {"H8", 5.1, -2.9, 6.9}, {"H9", 3.9, -3.3, 7.7}, {"H10", 2.6, -3.1, 8.1},
    // ring round the mouth, ring outside it, jaw
    {"M5_3", 2.5, -5.4, 8.8}, {"M5_4", 3.15, -6.7, 8.2}, {"M5_5", 2.7, -7.9, 8.4}, {"M5_6", 1.9, -8.45, 8.8},
    {"M5_7", 1.0, -8.65, 9.1}, {"M5_8", 0, -8.7, 9.2},
    {"M6_3", 3.2, -4.5, 8.3}, {"M6_4", 4.1, -6.3, 7.5}, {"M6_5", 3.7, -8.3, 7.4}, {"M6_6", 2.7, -9.5, 8.0},
    {"M6_7", 1.4, -10.0, 9.1}, {"M6_8", 0, -10.0, 9.6},
    {"S", 5.1, -5.2, 6.4}, {"S2", 4.7, -7.6, 5.9}, {"S3", 3.5, -9.9, 6.7}, {"S4", 1.8, -11.0, 8.0},
    {"S5", 0, -11.2, 8.4}, {"V6", 3.9, -10.2, 4.6}, {"V7", 2.0, -11.3, 5.8}, {"V8", 0, -11.6, 6.1},
    // side of the head, in columns from face to nape: U before the ear, Y its front, I its middle, Z its back, B behind
    {"U5", 6.8, 2.6, 3.6}, {"U6", 7.1, 0.4, 3.4}, {"U7", 6.9, -1.7, 3.5}, {"U8", 6.3, -3.8, 3.9},
    {"U9", 5.8, -5.9, 3.4}, {"U10", 5.3, -8.0, 2.4},
    {"Y5", 7.2, 2.8, 1.3}, {"Y6", 7.1, 0.7, 1.0}, {"Y7", 7.0, -1.5, 0.9}, {"Y8", 6.7, -3.7, 1.0},
    {"Y9", 6.3, -5.9, 0.9}, {"Y10", 5.7, -8.1, -0.2},
    {"I5", 7.3, 2.9, -0.3}, {"I6", 7.3, 1.1, -0.4}, {"I8", 6.8, -3.9, -0.1}, {"I9", 6.2, -6.1, -0.5},
    {"I10", 5.6, -8.4, -1.6},
    {"Z5", 7.2, 2.8, -1.9}, {"Z6", 7.2, 0.8, -1.7}, {"Z7", 7.1, -1.4, -1.6}, {"Z8", 6.8, -3.6, -1.1},
    {"Z9", 6.1, -6.1, -1.9}, {"Z10", 5.4, -8.6, -3.0},
    {"B1_5", 6.3, 2.7, -5.3}, {"B1_6", 6.2, 0.6, -5.2}, {"B1_7", 6.0, -1.6, -5.0}, {"B1_8", 5.6, -3.9, -4.7},
    {"B1_9", 5.2, -6.3, -4.6}, {"B1_10", 4.6, -8.8, -4.9},
    {"B2_5", 3.6, 2.6, -8.6}, {"B2_6", 3.6, 0.4, -8.5}, {"B2_7", 3.4, -1.8, -8.0}, {"B2_8", 3.2, -4.2, -7.2},
    {"B2_9", 2.9, -6.6, -6.6}, {"B2_10", 2.6, -9.0, -6.4},
    {"B3_5", 0, 2.6, -9.8}, {"B3_6", 0, 0.4, -9.6}, {"B3_7", 0, -1.8, -9.1}, {"B3_8", 0, -4.2, -8.2},
    {"B3_9", 0, -6.6, -7.4}, {"B3_10", 0, -9.0, -7.0},
};

constexpr const char* face_quads[] = {
    // brow, bridge and side of the nose
    "W0 aW aG G", "aW W1 E1 aG", "G aG a0 N0", "aG E1 E0 a0", "N0 a0 a1 N1", "a0 E0 E11 a1", "N1 a1 a2 N2",
    "a1 E11 b2 a2", "N2 a2 a3 N3", "a2 b2 w3 a3", "N3 a3 a4 N4", "a3 w3 O1 a4", "N4 a4 a5 N5", "N5 a5 M5_1 M5_0",
    "b2 M6_2 w4 w3", "w3 w4 O2 O1", "w4 M6_2 M5_2 O2",
    // rim of the nostril
    "a4 O1 h1 h0", "O1 O2 h2 h1", "O2 M5_2 h3 h2", "M5_2 M5_1 h4 h3", "M5_1 a5 h5 h4", "a5 a4 h0 h5",
    // round the orbit
    "E1 W1 W2 E2", "E2 W2 W3 E3", "E3 W3 W4 E4", "E4 W4 W5 E5", "E5 W5 T6 E6", "E6 T6 H7 E7", "E7 H7 H8 E8",
    "E8 H8 H9 E9", "E9 H9 H10 E10", "E10 H10 b2 E11",
    // round the mouth
    "M5_2 M5_3 M6_3 M6_2", "M5_3 M5_4 M6_4 M6_3", "M5_4 M5_5 M6_5 M6_4", "M5_5 M5_6 M6_6 M6_5",
    "M5_6 M5_7 M6_7 M6_6", "M5_7 M5_8 M6_8 M6_7",
    // cheek and jaw
    "b2 H10 M6_3 M6_2", "H10 H9 M6_4 M6_3", "H9 H8 S M6_4", "M6_4 S S2 M6_5", "M6_5 S2 S3 M6_6", "M6_6 S3 S4 M6_7",
    "M6_7 S4 S5 M6_8", "S2 U10 V6 S3", "S3 V6 V7 S4", "S4 V7 V8 S5",
    "W5 U5 U6 T6", "T6 U6 U7 H7", "H7 U7 U8 H8", "H8 U8 U9 S", "S U9 U10 S2",
    // side, with the hole for the ear
    "U5 Y5 Y6 U6", "U6 Y6 Y7 U7", "U7 Y7 Y8 U8", "U8 Y8 Y9 U9", "U9 Y9 Y10 U10",
    "Y5 I5 I6 Y6", "Y8 I8 I9 Y9", "Y9 I9 I10 Y10", "I5 Z5 Z6 I6", "I8 Z8 Z9 I9", "I9 Z9 Z10 I10",
    "Z5 B1_5 B1_6 Z6", "Z6 B1_6 B1_7 Z7", "Z7 B1_7 B1_8 Z8", "Z8 B1_8 B1_9 Z9", "Z9 B1_9 B1_10 Z10",
    "B1_5 B2_5 B2_6 B1_6", "B1_6 B2_6 B2_7 B1_7", "B1_7 B2_7 B2_8 B1_8", "B1_8 B2_8 B2_9 B1_9",
    "B1_9 B2_9 B2_10 B1_10",
    "B2_5 B3_5 B3_6 B2_6", "B2_6 B3_6 B3_7 B2_7", "B2_7 B3_7 B3_8 B2_8", "B2_8 B3_8 B3_9 B2_9",
    "B2_9 B3_9 B3_10 B2_10",
};

/// The ring above the brows, from the forehead round to the back of the head: foot of the cranium.
constexpr const char* cranium_foot[] = {"W0", "aW", "W1", "W2", "W3", "W4", "W5", "U5", "Y5", "I5", "Z5", "B1_5",
                                        "B2_5", "B3_5"};
/// The ring under the jaw: head of the neck.
constexpr const char* neck_head[] = {"V8", "V7", "V6", "U10", "Y10", "I10", "Z10", "B1_10", "B2_10", "B3_10"};
// clang-format on

Loop loop_of(const SkinCage& cage, std::span<const char* const> names) {
  Loop loop;
  for (const char* name : names) loop.push_back(cage[name]);
  return loop;
}

/// Rings up to the crown, closed by a patch of quads: 4 columns from the front, 5 along the side, 4 from the back.
void add_cranium(SkinCage& cage) {
  const Vec3 centre(0.0, 2.6, -0.7);
  const Vec3 up = glm::normalize(Vec3(0.0, 1.0, -0.12));
  HalfMesh& mesh = cage.mesh;
  const Loop foot = loop_of(cage, cranium_foot);
  const auto direction_at = [&](int vertex, double rise) {
    const Vec3 from = glm::normalize(mesh.positions[static_cast<std::size_t>(vertex)] - centre);
    const double angle = std::acos(glm::dot(from, up));
    return (from * std::sin((1.0 - rise) * angle) + up * std::sin(rise * angle)) / std::sin(angle);
  };
  const auto add_cast = [&](Vec3 direction) {
    if (std::abs(direction.x) < 1e-9) direction.x = 0.0;
    return mesh.add(cast_from_inside(centre, direction));
  };
  Loop below = foot;
  for (const double rise : {0.27, 0.5, 0.68}) {
    Loop ring;
    for (const int v : foot) ring.push_back(add_cast(direction_at(v, rise)));
    bridge(mesh, below, ring, false, Chart::outer);
    below = ring;
  }
  constexpr std::size_t across = 4;
  constexpr std::size_t along = 5;
  std::array<std::array<int, across + 1>, along + 1> patch{};  // [0..along] front to back, [0..across] middle to side
  for (std::size_t i = 0; i <= across; ++i) patch[0][i] = below[i];
  for (std::size_t j = 0; j <= along; ++j) patch[j][across] = below[across + j];
  for (std::size_t i = 0; i <= across; ++i) patch[along][i] = below[2 * across + along - i];
  const auto ray = [&](int v) { return glm::normalize(mesh.positions[static_cast<std::size_t>(v)] - centre); };
  for (std::size_t j = 1; j < along; ++j) {
    for (std::size_t i = 0; i < across; ++i) {
      const double s = static_cast<double>(i) / across;
      const double t = static_cast<double>(j) / along;
      Vec3 side = ray(patch[j][across]);
      Vec3 other = side;
      other.x = -other.x;
      const Vec3 through = ray(patch[0][i]) * (1.0 - t) + ray(patch[along][i]) * t;
      const Vec3 sideways = side * (0.5 + 0.5 * s) + other * (0.5 - 0.5 * s);
      Vec3 blend = glm::normalize(through + sideways * 0.6);
      if (i == 0) blend.x = 0.0;
      patch[j][i] = add_cast(blend);
    }
  }
  for (std::size_t j = 0; j < along; ++j) {
    for (std::size_t i = 0; i < across; ++i) {
      mesh.add_quad(patch[j][i], patch[j][i + 1], patch[j + 1][i + 1], patch[j + 1][i]);
    }
  }
}

/// Rings down the neck; the last is the neckline, under the collar.
void add_neck(SkinCage& cage) {
  struct Ring {
    double front_y, back_y;
  };
  constexpr Ring rings[] = {{-12.6, -10.6}, {-14.2, -12.2}, {-15.9, -13.6}};
  HalfMesh& mesh = cage.mesh;
  Loop above = loop_of(cage, neck_head);
  const Loop head = above;
  const auto azimuth_of = [&](std::size_t i) {
    return pi * static_cast<double>(i) / static_cast<double>(head.size() - 1);
  };
  for (const auto& ring : rings) {
    Loop loop;
    for (std::size_t i = 0; i < head.size(); ++i) {
      const double azimuth = azimuth_of(i);
      const double t = 0.5 - 0.5 * std::cos(azimuth);
      Vec3 direction(std::sin(azimuth), 0.0, std::cos(azimuth));
      if (i == 0 || i + 1 == head.size()) direction.x = 0.0;
      const double y = ring.front_y + (ring.back_y - ring.front_y) * t;
      loop.push_back(mesh.add(cast_from_inside({0.0, y, -2.6}, direction)));
    }
    bridge(mesh, above, loop, false, Chart::outer);
    above = loop;
  }
  Loop edge;
  for (std::size_t i = 0; i < head.size(); ++i)
    edge.push_back(mesh.add(neckline(i + 1 == head.size() ? pi : azimuth_of(i))));
  bridge(mesh, above, edge, false, Chart::outer);
  cage.names["neckline"] = edge[0];
}

}  // namespace

SkinCage make_skin_cage() {
  SkinCage cage;
  for (const auto& v : face_vertices) cage.names[v.name] = cage.mesh.add(project_to_head({v.x, v.y, v.z}));
  for (const char* quad : face_quads) {
    std::istringstream words(quad);
    std::array<std::string, 4> corner;
    words >> corner[0] >> corner[1] >> corner[2] >> corner[3];
    cage.mesh.add_quad(cage[corner[0]], cage[corner[1]], cage[corner[2]], cage[corner[3]]);
  }
  add_cranium(cage);
  add_neck(cage);
  return cage;
}

}  // namespace semblante::sample_head_detail
