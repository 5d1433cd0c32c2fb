#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "core/doctor/part_checks.h"
#include "core/doctor/words.h"
#include "core/geometry/enclosed_volume.h"

namespace semblante {
namespace {

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
  const PartId largest = largest_part(surface);
  const double share = enclosed_volumes(model, surface)[largest.value()];
  if (share > inside_out_share) return;
  glm::dvec3 middle(0.0);
  for (const SurfaceVertexId v : surface.members_of(largest)) middle += surface.positions[v.value()];
  middle /= static_cast<double>(surface.members_of(largest).size());
  Finding finding;
  finding.code = FindingCode::inside_out;
  finding.severity = Severity::warning;
  finding.place.part = largest;
  finding.place.position = middle;
  finding.words =
      "the largest part is inside out: its triangles face inwards, so its front is invisible and its back shows";
  finding.remedy = "flip the faces, or recalculate the normals to the outside, in the program that made the model";
  finding.measured = {"volume as a fraction of the sum of its pieces", share, inside_out_share};
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
