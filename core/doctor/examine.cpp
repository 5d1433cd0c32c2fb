#include "core/doctor/examine.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/anatomy/point_lookup.h"
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

/// Limits the findings of each kind, because a model may have a hundred thousand holes: the first ones are kept, and
/// the last of those states how many more there are. Findings about points never reach the limit.
void keep_few_of_each(std::vector<Finding>& findings) {
  constexpr std::size_t most_of_a_kind = 100;
  std::array<std::size_t, finding_code_names.size()> count{};
  std::array<Finding*, finding_code_names.size()> last{};
  std::size_t kept = 0;
  for (Finding& finding : findings) {
    const auto kind = static_cast<std::size_t>(finding.code);
    if (++count[kind] > most_of_a_kind) continue;
    if (&findings[kept] != &finding) findings[kept] = std::move(finding);
    last[kind] = &findings[kept++];
  }
  findings.resize(kept);
  for (std::size_t kind = 0; kind < count.size(); ++kind) {
    if (count[kind] > most_of_a_kind)
      last[kind]->words += "; the same applies to " + std::to_string(count[kind] - most_of_a_kind) + " more";
  }
}

Report errors_first(Report report) {
  keep_few_of_each(report.findings);
  std::stable_sort(report.findings.begin(), report.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity < b.severity; });
  return report;
}

/// The places of lips and lids, which may be borders of the mesh and may touch. Their points are a fifth of ES0 apart,
/// so a radius of slightly more than half of that around each covers the whole rim.
Slits slits_of(const FaceAxes& face, const FeaturePointSet& points) {
  Slits slits;
  slits.reach = 0.12 * face.eye_separation.value_or(0.0);
  for (const Opening& opening : openings)
    for (const auto names : {opening.upper, opening.lower, opening.corners})
      for (const std::string_view name : names)
        if (const FeaturePoint* const point = find_point(points, name)) slits.places.emplace_back(point->position);
  return slits;
}

void find_in_mesh(const Model& model, const Surface& surface, std::span<const Part> parts, const MeshSides& mesh,
                  const Slits& slits, Report& report) {
  append(report, find_wrong_winding(model, surface, parts, mesh));
  append(report, find_open_seams(model, surface, parts, mesh, slits));
  append(report, find_mesh_faults(model, surface, parts, mesh));
}

}  // namespace

Report examine_mesh(const Model& model, const Surface& surface, std::span<const Part> parts) {
  Report report;
  find_in_mesh(model, surface, parts, sort_sides(model, surface), {}, report);
  return errors_first(std::move(report));
}

Report examine(const Model& model, const Surface& surface, const Rig& rig, WeightMethod method) {
  const MeshSides mesh = sort_sides(model, surface);
  const std::vector<SurfacePoint> points = surface_points(surface, rig.points);
  Subject head{model,
               surface,
               mesh,
               rig,
               method,
               fit_face_axes(rig.points),
               find_misplaced_rim_points(surface, points),
               find_points_on_eyes(surface, model.triangles, rig.parts, points)};
  head.points_in_place = points;
  std::erase_if(head.points_in_place, [&](const SurfacePoint& p) { return is_misplaced(head.misplaced, p.id); });
  head.modelled_eyes = find_modelled_eyes(surface, model.triangles, rig.parts, head.points_in_place);
  Report report;
  for (const auto check : {find_wrong_way_round, find_points_on_wrong_surface, find_points_off_lid_edge,
                           find_points_on_modelled_eyes, find_unit_faults, find_joined_rims, find_leaks,
                           find_rims_not_neutral, find_points_out_of_order, find_points_off_mirror, find_idle_parts,
                           find_lids_in_eyes, find_holes, find_wrong_density, find_missing_points, find_far_reach})
    append(report, check(head));
  find_in_mesh(model, surface, rig.parts, mesh, slits_of(head.frame, rig.points), report);
  return errors_first(std::move(report));
}

}  // namespace semblante
