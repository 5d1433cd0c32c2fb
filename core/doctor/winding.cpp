#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "core/doctor/part_checks.h"
#include "core/doctor/words.h"

namespace semblante {
namespace {

/// The enclosed signed volume, relative to the sum of the absolute volumes of its pieces from the centre: 1 for a
/// closed surface, -1 for one that is inside out, near 0 for a sheet. Below this threshold a part is inside out.
constexpr double clearly_negative = -0.2;

void find_inconsistent(const Model& model, const Surface& surface, std::span<const Part> parts, const MeshSides& mesh,
                       std::vector<Finding>& out) {
  VertexSample vertices;
  std::size_t edges = 0;
  for (std::size_t e = 0; e < mesh.edge_count(); ++e) {
    const auto sides = mesh.sides_of(e);
    if (sides.size() != 2 || sides[0].rising != sides[1].rising || !is_skin(surface, parts, sides[0].low)) continue;
    ++edges;
    vertices.add(surface.file_vertex_of[sides[0].low]);
  }
  if (edges == 0) return;
  Finding finding;
  finding.code = FindingCode::inconsistent_winding;
  finding.severity = Severity::warning;
  finding.place = place_of(model, surface, std::move(vertices));
  finding.words = "along " + count_of(edges, "edge", "edges") +
                  " neighbouring triangles of the skin have opposite winding; one side is drawn dark or not at all";
  finding.remedy = "recalculate the normals to the outside in the program that made the model";
  out.push_back(std::move(finding));
}

void find_inside_out(const Model& model, const Surface& surface, std::vector<Finding>& out) {
  if (surface.part_count() == 0) return;
  std::uint32_t largest = 0;
  for (std::uint32_t p = 1; p < surface.part_count(); ++p)
    if (surface.members_of(PartId(p)).size() > surface.members_of(PartId(largest)).size()) largest = p;
  glm::dvec3 middle(0.0);
  for (const SurfaceVertexId v : surface.members_of(PartId(largest))) middle += surface.positions[v.value()];
  middle /= static_cast<double>(surface.members_of(PartId(largest)).size());

  double volume = 0.0;
  double size = 0.0;
  for (const Triangle& triangle : model.triangles) {
    if (surface.part_of[surface.surface_of[triangle[0]].value()] != PartId(largest)) continue;
    std::array<glm::dvec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = surface.positions[surface.surface_of[triangle[k]].value()] - middle;
    const double piece = glm::dot(p[0], glm::cross(p[1], p[2]));
    volume += piece;
    size += std::abs(piece);
  }
  if (size == 0.0 || volume / size > clearly_negative) return;
  Finding finding;
  finding.code = FindingCode::inside_out;
  finding.severity = Severity::warning;
  finding.place.part = PartId(largest);
  finding.place.position = middle;
  finding.words =
      "the largest part is inside out: its triangles face inwards, so its front is invisible and its back shows";
  finding.remedy = "flip the faces, or recalculate the normals to the outside, in the program that made the model";
  finding.measured = {"volume as a fraction of the sum of its pieces", volume / size, clearly_negative};
  out.push_back(std::move(finding));
}

}  // namespace

std::vector<Finding> find_wrong_winding(const Model& model, const Surface& surface, std::span<const Part> parts,
                                        const MeshSides& mesh) {
  std::vector<Finding> findings;
  find_inside_out(model, surface, findings);
  find_inconsistent(model, surface, parts, mesh, findings);
  return findings;
}

}  // namespace semblante
