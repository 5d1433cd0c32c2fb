#include "core/anatomy/joined_rims.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/anatomy/lids.h"
#include "core/anatomy/slanted_opening.h"
#include "core/doctor/openings.h"
#include "core/doctor/words.h"

namespace semblante {
namespace {

/// Of an opening that is no mouth: 0 left, 1 right.
std::size_t eye_of(const Opening& opening) { return &opening == &lids_of(0) ? 0 : 1; }

/// How far lids of one skin close before it folds, as a share of their distance; of lids that roll.
std::optional<double> closed_share(const Subject& head, const Opening& opening) {
  const auto& lids = head.rig.lids[eye_of(opening)];
  const auto& upper = head.frame.place(opening.upper.front());
  const auto& lower = head.frame.place(opening.lower.front());
  const auto& corner = head.frame.place(opening.corners[0]);
  const auto& other_corner = head.frame.place(opening.corners[1]);
  if (!lids || !upper || !lower || !corner || !other_corner || !(upper->y > lower->y)) return std::nullopt;
  return std::min(1.0, lids->opening / opening_height(*upper, *lower, *corner, *other_corner));
}

/// Whether lids of one skin close over an eye that is modelled in it: nothing is to be done then.
bool closes_over_eye(const Subject& head, const Opening& opening) {
  return !opening.is_mouth && are_shares(head.method) && head.rig.lids[eye_of(opening)] &&
         head.modelled_eyes[eye_of(opening)];
}

/// Whether they will, as soon as their points are off the eye.
bool will_close_over_eye(const Subject& head, const Opening& opening) {
  return are_shares(head.method) &&
         std::any_of(head.on_eyes.begin(), head.on_eyes.end(), [&](const PointOnEye& p) { return p.lids == &opening; });
}

}  // namespace

std::vector<Finding> find_joined_rims(const Subject& head) {
  std::vector<Finding> findings;
  for (const Opening& opening : openings) {
    if (closes_over_eye(head, opening) || will_close_over_eye(head, opening)) continue;
    const std::optional<RimCrossing> crossing = shortest_crossing(head.surface, opening, head.points_in_place);
    const auto ball = opening.is_mouth ? std::nullopt : hiding_ball(head.rig, eye_of(opening));
    if (!crossing || !joins(*crossing, head.surface, ball)) continue;
    Finding finding;
    finding.code = opening.is_mouth ? FindingCode::lips_joined : FindingCode::lids_joined;
    finding.severity = Severity::warning;
    finding.place.points = {crossing->upper.id, crossing->lower.id};
    finding.place.part = head.surface.part_of[crossing->upper.vertex.value()];
    for (const SurfaceVertexId vertex : crossing->way)
      finding.place.vertices.add(head.surface.file_vertex_of[vertex.value()]);
    finding.place.position = 0.5 * (crossing->upper.position + crossing->lower.position);
    const std::string name(opening.name);
    const std::optional<double> closed = opening.is_mouth ? std::nullopt : closed_share(head, opening);
    finding.words =
        "the " + name + " are joined: from " + to_string(crossing->upper.id) + " to " + to_string(crossing->lower.id) +
        " the path along the surface crosses the gap, with " + percent(crossing->share) +
        " of the distance around the corner; " +
        (opening.is_mouth ? "the mouth opens no farther than the skin between them stretches, and closes until it "
                            "would fold"
                          : "a blink closes the eye " + (closed ? "by " + percent(*closed) + ", " : std::string()) +
                                "until the skin would fold");
    finding.remedy = "delete the faces that span the gap between the " + name +
                     ", or split the vertices that both share; a head that is one skin there, as a scan, stays so";
    finding.measured = {"path across as a fraction of the distance around the nearer corner", crossing->share,
                        joined_share};
    findings.push_back(std::move(finding));
  }
  return findings;
}

}  // namespace semblante
