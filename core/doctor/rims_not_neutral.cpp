#include <array>
#include <optional>
#include <string>
#include <utility>

#include "core/anatomy/point_lookup.h"
#include "core/doctor/openings.h"
#include "core/doctor/words.h"
#include "core/parametrize/fapu.h"

namespace semblante {
namespace {

/// In the neutral face the lips touch. Lips at rest are up to 2 mm (0.03 of ES0) apart; from 3 mm on a mouth looks
/// open, and visemes do not close it.
constexpr double open_mouth = 0.05;
/// In the neutral face the lids are tangent to the iris, which is 0.15 to 0.23 of ES0 on people. Below two thirds of
/// the mean they cover it, and FAPs 19 to 22, whose unit is the lids' distance, close the eyes too little or too much.
constexpr double closed_eye = 0.12;

Finding between(const Subject& head, std::string_view upper, std::string_view lower) {
  Finding finding;
  const FeaturePoint* const a = find_point(head.rig.points, upper);
  const FeaturePoint* const b = find_point(head.rig.points, lower);
  finding.place.points = {a->id, b->id};
  for (const FeaturePoint* const each : {a, b})
    if (each->vertex) finding.place.vertices.add(*each->vertex);
  finding.place.position = 0.5 * (glm::dvec3(a->position) + glm::dvec3(b->position));
  finding.severity = Severity::warning;
  return finding;
}

}  // namespace

std::vector<Finding> find_rims_not_neutral(const Subject& head) {
  std::vector<Finding> findings;
  if (!head.frame.eye_separation) return findings;
  const auto gap = [&](std::string_view upper, std::string_view lower) -> std::optional<double> {
    const auto& a = head.frame.place(upper);
    const auto& b = head.frame.place(lower);
    if (!a || !b) return std::nullopt;
    return (a->y - b->y) / *head.frame.eye_separation;
  };
  if (const auto mouth = gap("2.2", "2.3"); mouth && *mouth > open_mouth) {
    Finding finding = between(head, "2.2", "2.3");
    finding.code = FindingCode::mouth_open;
    finding.words = "the mouth is open by " + percent(*mouth) +
                    " of the eye distance, but in the neutral face the lips touch; p, b and m will not close it";
    finding.remedy =
        "export the model with its mouth closed, or check that 2.2 and 2.3 are on the inner rims of the lips";
    finding.measured = {"height of 2.2 above 2.3 as a fraction of ES0", *mouth, open_mouth};
    findings.push_back(std::move(finding));
  }
  for (const auto& [upper, lower, side] : {std::array<std::string_view, 3>{"3.1", "3.3", "left"},
                                           std::array<std::string_view, 3>{"3.2", "3.4", "right"}}) {
    const auto eye = gap(upper, lower);
    const bool is_closed = head.rig.fapu.origin[static_cast<std::size_t>(FapuUnit::irisd)] == FapuOrigin::closed_eyes;
    if (!eye || *eye >= closed_eye || (*eye <= 0.0 && !is_closed)) continue;
    Finding finding = between(head, upper, lower);
    finding.code = FindingCode::eye_not_open;
    finding.words = "the " + std::string(side) + " eye is " + (is_closed ? "closed" : "not open") + ": its lids are " +
                    percent(*eye) +
                    " of the eye distance apart, but in the neutral face they are tangent to the iris; " +
                    (is_closed ? "IRISD is taken as " + percent(iris_share) +
                                     " of ES0, and ES0 as the distance between the centres of the eyes' corners; the "
                                     "eye opens with negative values of FAPs 19 to 22, and a blink has nothing to close"
                               : std::string("IRISD is too small for every FAP in that unit"));
    finding.remedy = "export the model with its eyes open, or check that " + std::string(upper) + " and " +
                     std::string(lower) + " are on the rims of the lids; IRISD can also be set explicitly";
    finding.measured = {"distance of the lids as a fraction of ES0", *eye, closed_eye};
    findings.push_back(std::move(finding));
  }
  return findings;
}

}  // namespace semblante
