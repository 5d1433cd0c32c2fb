#include "core/doctor/examine.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "core/doctor/mesh_faults.h"
#include "core/doctor/mesh_sides.h"
#include "core/doctor/openings.h"
#include "core/doctor/part_checks.h"
#include "core/doctor/point_checks.h"
#include "core/doctor/subject.h"

namespace semblante {
namespace {

void append(Report& report, std::vector<Finding> findings) {
  std::move(findings.begin(), findings.end(), std::back_inserter(report.findings));
}

Report errors_first(Report report) {
  std::stable_sort(report.findings.begin(), report.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity < b.severity; });
  return report;
}

void find_in_mesh(const Model& model, const Surface& surface, std::span<const Part> parts, const MeshSides& mesh,
                  Report& report) {
  append(report, find_wrong_winding(model, surface, parts, mesh));
  append(report, find_open_seams(model, surface, parts, mesh));
  append(report, find_mesh_faults(model, surface, parts, mesh));
}

}  // namespace

Report examine_mesh(const Model& model, const Surface& surface, std::span<const Part> parts) {
  Report report;
  find_in_mesh(model, surface, parts, sort_sides(model, surface), report);
  return errors_first(std::move(report));
}

Report examine(const Model& model, const Surface& surface, const Rig& rig, WeightMethod method) {
  const MeshSides mesh = sort_sides(model, surface);
  const Subject head{model, surface, mesh, rig, method, fit_face_frame(rig.points)};
  Report report;
  for (const auto check : {find_wrong_way_round, find_points_on_wrong_surface, find_unit_faults, find_joined_rims,
                           find_leaks, find_rims_not_neutral, find_points_out_of_order, find_points_off_mirror,
                           find_idle_parts, find_holes, find_wrong_density, find_missing_points})
    append(report, check(head));
  find_in_mesh(model, surface, rig.parts, mesh, report);
  return errors_first(std::move(report));
}

}  // namespace semblante
