#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace semblante::oracle {

/// A second reading of surfaces and Eq. 1 to 4, written from the text alone: plain containers, one vertex and
/// one feature point at a time, as slow as it likes. It shares no code and no type with core/.
using Point3 = std::array<double, 3>;

struct Mesh {
  std::vector<std::array<float, 3>> positions;  ///< file vertices
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// (group, number): compares as the standard orders the points.
using PointName = std::pair<int, int>;

struct LiteralResult {
  std::vector<std::uint32_t> surface_of;             ///< file vertex -> lowest file vertex of its surface vertex
  std::vector<std::map<PointName, double>> weights;  ///< by file vertex: W_iP of Eq. 4
  std::vector<std::set<PointName>> regions;          ///< by file vertex: B of section 4; empty at points themselves
};

/// `points`: the file vertex of each marked point.
LiteralResult literal_weights(const Mesh& mesh, const std::map<PointName, std::uint32_t>& points);

}  // namespace semblante::oracle
