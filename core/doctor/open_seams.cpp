#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include <glm/geometric.hpp>

#include "core/doctor/part_checks.h"
#include "core/doctor/words.h"
#include "core/types/seeded_hash.h"

namespace semblante {
namespace {

/// Borders closer than this fraction of their edge length were meant to be joined: no modeller makes so small a gap.
constexpr double gap_share = 0.05;
/// Maximum number of vertices examined per cell, so that coincident vertices do not cost quadratic time.
constexpr std::size_t most_in_cell = 16;

/// A spatial grid of vertices.
class Cells {
 public:
  Cells(const Surface& surface, double size) : surface_(surface), size_(size) {}

  void insert(std::uint32_t vertex) {
    auto& cell = cells_[key(surface_.positions[vertex], 0, 0, 0)];
    if (cell.size() < most_in_cell) cell.push_back(vertex);
  }

  template <class Visit>
  void visit_near(std::uint32_t vertex, Visit visit) const {
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const auto cell = cells_.find(key(surface_.positions[vertex], x, y, z));
          if (cell == cells_.end()) continue;
          for (const std::uint32_t other : cell->second) visit(other);
        }
  }

 private:
  [[nodiscard]] std::uint64_t key(const glm::dvec3& p, int x, int y, int z) const {
    // Different cells may share a key: this costs a comparison, but the result stays correct.
    const auto along = [&](double value, int step) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value / size_)) + step);
    };
    return along(p.x, x) * 73856093U ^ along(p.y, y) * 19349663U ^ along(p.z, z) * 83492791U;
  }

  const Surface& surface_;
  double size_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>, SeededHash> cells_;
};

struct Border {
  std::uint32_t a, b;
};

std::vector<Border> borders_of(const MeshSides& mesh) {
  std::vector<Border> borders;
  for (std::size_t e = 0; e < mesh.edge_count(); ++e)
    if (mesh.sides_of(e).size() == 1) borders.push_back({mesh.sides_of(e)[0].low, mesh.sides_of(e)[0].high});
  return borders;
}

/// Border edges in figures.
struct BorderLengths {
  double middle = 0.0;                                    ///< the median
  double extent = 0.0;                                    ///< of their vertices from the origin
  std::unordered_map<std::uint32_t, double> shortest_at;  ///< the shortest border edge at each vertex

  /// Gaps of borders that were meant to be joined are no wider.
  [[nodiscard]] double widest_gap() const { return gap_share * middle; }
};

/// `borders` must not be empty.
BorderLengths lengths_of(std::span<const Border> borders, const Surface& surface) {
  BorderLengths result;
  std::vector<double> lengths;
  for (const auto& [a, b] : borders) {
    const double length = glm::distance(surface.positions[a], surface.positions[b]);
    lengths.push_back(length);
    for (const std::uint32_t v : {a, b}) {
      result.extent = std::max(result.extent, glm::length(surface.positions[v]));
      double& shortest = result.shortest_at.try_emplace(v, length).first->second;
      shortest = std::min(shortest, length);
    }
  }
  const auto half = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), half, lengths.end());
  result.middle = *half;
  return result;
}

/// The vertices of other borders that border vertices touch without being joined to them.
class Contacts {
 public:
  Contacts(const Surface& surface, const BorderLengths& lengths)
      : surface_(surface), lengths_(lengths), cells_(surface, lengths.widest_gap()) {
    for (const auto& [vertex, length] : lengths.shortest_at) cells_.insert(vertex);
  }

  [[nodiscard]] std::optional<std::uint32_t> of(std::uint32_t vertex) const {
    std::optional<std::uint32_t> contact;
    double nearest = std::min(lengths_.widest_gap(), gap_share * lengths_.shortest_at.at(vertex));
    cells_.visit_near(vertex, [&](std::uint32_t other) {
      if (other == vertex) return;
      const double distance = glm::distance(surface_.positions[vertex], surface_.positions[other]);
      if (distance > nearest || distance > gap_share * lengths_.shortest_at.at(other)) return;
      for (const Surface::Step& step : surface_.steps_from(SurfaceVertexId(vertex)))
        if (step.to.value() == other) return;
      nearest = distance;
      contact = other;
    });
    return contact;
  }

 private:
  const Surface& surface_;
  const BorderLengths& lengths_;
  Cells cells_;
};

bool is_slit(const Slits& slits, const glm::dvec3& start) {
  return std::any_of(slits.places.begin(), slits.places.end(),
                     [&](const glm::dvec3& place) { return glm::distance(place, start) < slits.reach; });
}

}  // namespace

std::vector<Finding> find_open_seams(const Model& model, const Surface& surface, std::span<const Part> parts,
                                     const MeshSides& mesh, const Slits& slits) {
  const std::vector<Border> borders = borders_of(mesh);
  if (borders.empty()) return {};
  const BorderLengths lengths = lengths_of(borders, surface);
  // No gap is possible at zero width, and the cell coordinates must fit into 64 bits.
  if (!(lengths.widest_gap() > lengths.extent * 1e-12)) return {};

  // An edge with a contact at both ends is a seam.
  const Contacts contacts(surface, lengths);
  VertexSample vertices;
  std::size_t count = 0;
  double gap = 0.0;
  for (const auto& [a, b] : borders) {
    const auto at_a = contacts.of(a);
    if (!at_a) continue;
    const auto at_b = contacts.of(b);
    if (!at_b || at_a == at_b) continue;
    // The piece that was cut off may have any role, but one of the two must be skin.
    if (!is_skin(surface, parts, a) && !is_skin(surface, parts, *at_a)) continue;
    if (is_slit(slits, surface.positions[a])) continue;
    ++count;
    gap = std::max({gap, glm::distance(surface.positions[a], surface.positions[*at_a]),
                    glm::distance(surface.positions[b], surface.positions[*at_b])});
    vertices.add(surface.file_vertex_of[a]);
  }
  if (count == 0) return {};
  Finding finding;
  finding.code = FindingCode::open_seam;
  finding.severity = Severity::warning;
  finding.place = place_of(model, surface, std::move(vertices));
  finding.words = count_of(count, "border edge of the skin lies", "border edges of the skin lie") +
                  " next to another border without being joined to it; the skin is cut there, and no movement crosses "
                  "the cut";
  finding.remedy =
      "merge vertices by distance along the seam: give those that belong together the same position; lips and lids "
      "that only touch may stay as they are";
  finding.measured = {"widest gap as a fraction of the length of a border edge", gap / lengths.middle, gap_share};
  return {std::move(finding)};
}

}  // namespace semblante
