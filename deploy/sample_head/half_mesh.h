#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace semblante::sample_head_detail {

/// Positions are in centimetres and double precision: eye line at y = 0, ear canals near z = 0, +X the face's own left.
using Vec3 = glm::dvec3;
using Vec2 = glm::dvec2;

/// Which part of the texture a face uses. `inner` is the lining of mouth, nostrils and eye sockets, which a
/// projection from outside would map onto the face.
enum class Chart : std::uint8_t { outer, inner };

/// Properties of a vertex for painting the texture, each 0..1.
struct Paint {
  double lip = 0.0;    ///< red of the lips
  double lid = 0.0;    ///< edge of the lids
  double lash = 0.0;   ///< dark of the lashes on it
  double flush = 0.0;  ///< warm thin skin: ears, wings of the nose
  Vec2 inner_uv{0.0};  ///< x: depth from the opening 0..1, y: 0 mouth, 1 socket, 2 nostril, 3 upper lid
};

/// The left half of a symmetric surface. Vertices of the mirror plane have x == 0 exactly and exist once.
struct HalfMesh {
  struct Face {
    std::array<int, 4> corner{};  ///< a triangle has corner[3] == -1; counter-clockwise seen from outside
    Chart chart = Chart::outer;
  };
  std::vector<Vec3> positions;  ///< #V
  std::vector<Paint> paint;     ///< #V
  std::vector<Face> faces;      ///< #F

  int add(const Vec3& position, const Paint& about = {}) {
    positions.push_back(position);
    paint.push_back(about);
    return static_cast<int>(positions.size()) - 1;
  }
  void add_quad(int a, int b, int c, int d, Chart chart = Chart::outer) { faces.push_back({{a, b, c, d}, chart}); }
  void add_triangle(int a, int b, int c, Chart chart = Chart::outer) { faces.push_back({{a, b, c, -1}, chart}); }
  [[nodiscard]] bool on_mirror(int v) const { return positions[static_cast<std::size_t>(v)].x == 0.0; }
};

/// Connected vertices in order: a ring around the eye, half a ring around the mouth.
using Loop = std::vector<int>;

/// Joins two loops of equal length by quads; `closed` also joins last and first. `outside` is the loop on whose left
/// side, seen from outside the head and walking along it, the quads lie.
void bridge(HalfMesh& mesh, const Loop& outside, const Loop& inside, bool closed, Chart chart);

/// Joins a closed loop to one of twice as many vertices, whose even ones lie opposite the loop's.
void bridge_doubling(HalfMesh& mesh, const Loop& outside, const Loop& inside, Chart chart);

/// Closes a loop by a fan to one vertex.
void close_with_fan(HalfMesh& mesh, const Loop& loop, bool closed, int centre, Chart chart);

/// Flips faces so that all connected ones have the winding of the first, whose normal must point along `first_looks`.
void orient(HalfMesh& mesh, const Vec3& first_looks);

/// Unique neighbours by edges of faces (diagonals excluded), #V rows.
std::vector<std::vector<int>> neighbours_of(const HalfMesh& mesh);

}  // namespace semblante::sample_head_detail
