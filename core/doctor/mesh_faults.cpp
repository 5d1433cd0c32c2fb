#include "core/doctor/mesh_faults.h"

#include <string>
#include <string_view>

#include "core/doctor/words.h"

namespace semblante {
namespace {

VertexSample first_corners(const Model& model, const std::vector<std::uint32_t>& triangles) {
  VertexSample sample;
  for (const std::uint32_t t : triangles) sample.add(VertexId(model.triangles[t][0]));
  return sample;
}

Finding about(const Model& model, const Surface& surface, FindingCode code, Severity severity, VertexSample vertices) {
  Finding finding;
  finding.code = code;
  finding.severity = severity;
  finding.place = place_of(model, surface, std::move(vertices));
  return finding;
}

void find_degenerate(const Model& model, const Surface& surface, const MeshSides& mesh, std::vector<Finding>& out) {
  if (mesh.degenerate.empty()) return;
  Finding finding =
      about(model, surface, FindingCode::degenerate_triangles, Severity::note, first_corners(model, mesh.degenerate));
  finding.words = count_of(mesh.degenerate.size(), "triangle has", "triangles have") +
                  " no area; they are not drawn, and only their edges carry influence";
  finding.remedy = "dissolve degenerate faces in the program that made the model and export it again";
  out.push_back(std::move(finding));
}

void find_repeated(const Model& model, const Surface& surface, const MeshSides& mesh, std::vector<Finding>& out) {
  if (mesh.repeated.empty()) return;
  Finding finding =
      about(model, surface, FindingCode::duplicate_triangles, Severity::warning, first_corners(model, mesh.repeated));
  finding.words = count_of(mesh.repeated.size(), "triangle lies", "triangles lie") +
                  " exactly on another one; both are drawn and flicker";
  finding.remedy = "delete duplicate faces; to make a surface visible from behind, set its material to double-sided";
  out.push_back(std::move(finding));
}

void find_non_manifold(const Model& model, const Surface& surface, std::span<const Part> parts, const MeshSides& mesh,
                       std::vector<Finding>& out) {
  VertexSample vertices;
  std::size_t edges = 0;
  for (std::size_t e = 0; e < mesh.edge_count(); ++e) {
    const auto sides = mesh.sides_of(e);
    if (sides.size() <= 2 || !is_skin(surface, parts, sides[0].low)) continue;
    ++edges;
    vertices.add(surface.file_vertex_of[sides[0].low]);
  }
  if (edges == 0) return;
  Finding finding = about(model, surface, FindingCode::non_manifold_edges, Severity::warning, std::move(vertices));
  finding.words = count_of(edges, "edge joins", "edges join") +
                  " more than two triangles; influence spreads there onto surfaces that should move apart";
  finding.remedy = "separate the surfaces that meet there, or delete the inner faces between them";
  out.push_back(std::move(finding));
}

void find_unused(const Model& model, const Surface& surface, std::vector<Finding>& out) {
  std::vector<bool> used(model.positions.size(), false);
  for (const Triangle& triangle : model.triangles)
    for (const std::uint32_t corner : triangle) used[corner] = true;
  VertexSample vertices;
  for (std::uint32_t v = 0; v < used.size(); ++v)
    if (!used[v]) vertices.add(VertexId(v));
  if (vertices.count == 0) return;
  const std::size_t count = vertices.count;
  Finding finding = about(model, surface, FindingCode::unused_vertices, Severity::note, std::move(vertices));
  finding.words =
      count_of(count, "vertex belongs", "vertices belong") + " to no triangle; the package omits unused vertices";
  finding.remedy = "no action is needed; unused vertices can be deleted before the export";
  out.push_back(std::move(finding));
}

}  // namespace

std::vector<Finding> find_mesh_faults(const Model& model, const Surface& surface, std::span<const Part> parts,
                                      const MeshSides& mesh) {
  std::vector<Finding> findings;
  find_non_manifold(model, surface, parts, mesh, findings);
  find_repeated(model, surface, mesh, findings);
  find_degenerate(model, surface, mesh, findings);
  find_unused(model, surface, findings);
  return findings;
}

}  // namespace semblante
