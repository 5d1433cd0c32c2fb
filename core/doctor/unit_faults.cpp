#include <array>
#include <sstream>
#include <string>

#include "core/anatomy/point_lookup.h"
#include "core/doctor/point_checks.h"
#include "core/doctor/words.h"
#include "core/parametrize/fapu.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

/// The range of a FAPU on human faces as a fraction of ES0 (pupils 54 to 74 mm apart). From anthropometry of adults:
/// iris 11 to 12.5 mm wide, pupils to the base of the nose 38 to 52 mm, from there to the mouth line 17 to 27 mm, mouth
/// 42 to 62 mm wide.
struct HumanRange {
  double least, greatest;
};
constexpr std::array<HumanRange, fapu_unit_count> human = {
    {{0.15, 0.23}, {1.0, 1.0}, {0.55, 0.90}, {0.23, 0.45}, {0.60, 1.00}}};

/// Tolerance factor for cartoon and animal heads; beyond it, a misplaced point is more likely.
constexpr double room = 2.0;
/// Tolerance factor of ES, which is compared with an estimate from the other points of the eyes.
constexpr double room_of_es = 1.25;

std::vector<FeaturePointId> points_of(std::size_t unit) {
  std::vector<FeaturePointId> ids;
  const auto& info = mpeg4::fapus[unit];
  for (std::size_t m = 0; m < info.measure_count; ++m) {
    ids.emplace_back(info.measures[m].to);
    ids.emplace_back(info.measures[m].from);
  }
  return ids;
}

std::string two_digits(double value) {
  std::ostringstream text;
  text.precision(2);
  text << value;
  return text.str();
}

Finding about(const Subject& head, std::size_t unit) {
  Finding finding;
  finding.place.points = points_of(unit);
  for (const FeaturePointId id : finding.place.points) {
    const FeaturePoint* const point = find_point(head.rig.points, to_string(id));
    if (point == nullptr) continue;
    if (point->vertex) finding.place.vertices.add(*point->vertex);
    if (!finding.place.position) finding.place.position = glm::dvec3(point->position);
  }
  finding.remedy = "check " + list_of(finding.place.points) + ", or set the unit explicitly";
  return finding;
}

/// A unit that was set by hand, and what the points give.
Finding by_hand(const Subject& head, std::size_t unit) {
  const std::string name(fapu_unit_names[unit]);
  const double length = 1024.0 * *head.rig.fapu.value[unit];
  const std::optional<double> measured = compute_fapu(head.rig.points).value[unit];
  Finding finding = about(head, unit);
  finding.code = FindingCode::unit_by_hand;
  finding.severity = Severity::note;
  finding.words = name + ", the " + std::string(mpeg4::fapus[unit].meaning) + ", is set by hand to " +
                  two_digits(length) + " model units; " +
                  (measured ? "its points are " + two_digits(1024.0 * *measured) + " apart"
                            : std::string("its points give no value"));
  finding.remedy = "none is needed, if that is intended; without the value by hand the points give the unit";
  return finding;
}

}  // namespace

std::vector<Finding> find_unit_faults(const Subject& head) {
  std::vector<Finding> findings;
  const bool whole_face_wrong = !find_wrong_way_round(head).empty();
  for (std::size_t unit = 0; unit < fapu_unit_count; ++unit) {
    const std::string name(fapu_unit_names[unit]);
    const auto value = head.rig.fapu.value[unit];
    if (!value) {
      // Missing points and a wrong orientation have findings of their own.
      bool measurable = false;
      const auto& info = mpeg4::fapus[unit];
      for (std::size_t m = 0; m < info.measure_count; ++m)
        measurable |= head.frame.places[info.measures[m].from] && head.frame.places[info.measures[m].to];
      if (!measurable || whole_face_wrong) continue;
      Finding finding = about(head, unit);
      finding.code = FindingCode::unit_not_positive;
      finding.severity = Severity::error;
      finding.words = name + ", the " + std::string(info.meaning) +
                      ", is zero or negative: its points are at one height or exchanged, and no FAP in that unit moves";
      finding.measured = {name, 0.0, 0.0};
      findings.push_back(std::move(finding));
      continue;
    }
    if (head.rig.fapu.origin[unit] == FapuOrigin::user) findings.push_back(by_hand(head, unit));
    if (!head.frame.eye_separation) continue;
    const double share = *value * 1024.0 / *head.frame.eye_separation;
    const bool is_es = unit == static_cast<std::size_t>(FapuUnit::es);
    const double least = is_es ? 1.0 / room_of_es : human[unit].least / room;
    const double greatest = is_es ? room_of_es : human[unit].greatest * room;
    if (share >= least && share <= greatest) continue;
    Finding finding = about(head, unit);
    finding.code = FindingCode::unit_implausible;
    finding.severity = Severity::warning;
    finding.words =
        name + ", the " + std::string(mpeg4::fapus[unit].meaning) + ", is " + two_digits(share) +
        " of the eye distance; " +
        (is_es ? std::string("lids and brows indicate other places of the eyes than the pupils")
               : "on people it is " + two_digits(human[unit].least) + " to " + two_digits(human[unit].greatest)) +
        ", and every FAP in that unit is wrong by the same factor";
    finding.measured = {name + " as a fraction of ES0", share, share < least ? least : greatest};
    findings.push_back(std::move(finding));
  }
  return findings;
}

}  // namespace semblante
