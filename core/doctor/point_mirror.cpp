#include <string>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/doctor/mirror_offsets.h"
#include "core/doctor/point_checks.h"
#include "core/doctor/words.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

/// About a centimetre on a human face. The sides of a real face differ by 1 to 4 mm (0.02 to 0.06 of ES0). Places
/// without a distinct point (cheeks, jaw, ears, hair line) are marked less exactly, so their tolerance is doubled.
constexpr double most_off = 0.15;
constexpr double most_off_in_areas = 0.30;

bool is_an_area(FeaturePointId id) {
  const int group = group_of(id);
  const std::string name = to_string(id);
  return group == 5 || group >= 10 || name == "2.13" || name == "2.14" || group == 6;
}

}  // namespace

std::vector<Finding> find_points_off_mirror(const Subject& head) {
  std::vector<Finding> findings;
  const auto offsets = mirror_offsets(head.frame);
  for (std::uint8_t index = 0; index < feature_point_count; ++index) {
    const auto& info = mpeg4::feature_points[index];
    if (info.side == mpeg4::Side::right) continue;  // reported with the left one
    const FeaturePointId id(index);
    const FeaturePointId other(info.mirror);
    const double off = offsets[index];
    const double most = is_an_area(id) ? most_off_in_areas : most_off;
    if (off <= most) continue;
    Finding finding;
    finding.code = FindingCode::point_off_mirror;
    finding.severity = Severity::warning;
    finding.place.points.push_back(id);
    if (id != other) finding.place.points.push_back(other);
    for (const FeaturePointId each : finding.place.points) {
      const FeaturePoint* const at = find_point(head.rig.points, to_string(each));
      if (at != nullptr && at->vertex) finding.place.vertices.add(*at->vertex);
      if (at != nullptr && !finding.place.position) finding.place.position = glm::dvec3(at->position);
    }
    finding.words = id == other ? to_string(id) + " belongs in the middle of the face, but is off by " + percent(off) +
                                      " of the eye distance"
                                : to_string(id) + " and " + to_string(other) + " are not symmetric: one is off by " +
                                      percent(off) + " of the eye distance";
    finding.remedy = id == other ? "move the point to the middle, unless the face is asymmetric"
                                 : "move the wrong one, or let it be filled in from the other side, unless the "
                                   "face is asymmetric";
    finding.measured = {"distance from the symmetric place as a fraction of ES0", off, most};
    findings.push_back(std::move(finding));
  }
  return findings;
}

}  // namespace semblante
