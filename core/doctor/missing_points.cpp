#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "core/doctor/point_checks.h"
#include "core/doctor/words.h"
#include "core/expressions/library.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

/// A group of points that are marked together, with the severity of their absence.
struct Region {
  std::string_view name;
  std::uint8_t group, first, last;  ///< ids "group.first" to "group.last"
  Severity severity;                ///< where a translation FAP or a set of displacements loses a point
};

/// Missing brows or lids are warnings; ears, tongue and skull may be absent from a head.
constexpr auto regions = std::to_array<Region>({
    {"chin and jaw", 2, 1, 1, Severity::warning},
    {"inner lips", 2, 2, 9, Severity::warning},
    {"chin and jaw", 2, 10, 14, Severity::note},
    {"lid edges", 3, 1, 4, Severity::warning},
    {"pupils", 3, 5, 6, Severity::warning},
    {"corners and folds of the eyes", 3, 7, 14, Severity::note},
    {"brows", 4, 1, 6, Severity::warning},
    {"cheeks", 5, 1, 4, Severity::note},
    {"tongue", 6, 1, 4, Severity::note},
    {"centre of head rotation", 7, 1, 1, Severity::note},
    {"outer lips", 8, 1, 10, Severity::warning},
    {"nose", 9, 1, 7, Severity::note},
    {"teeth", 9, 8, 11, Severity::note},
    {"nose", 9, 12, 15, Severity::note},
    {"ears", 10, 1, 10, Severity::note},
    {"hair line and skull", 11, 1, 6, Severity::note},
});

bool covers(const Region& region, FeaturePointId id) {
  return group_of(id) == region.group && number_of(id) >= region.first && number_of(id) <= region.last;
}

/// The features that need one of the missing points, by name, in the order of the tables.
struct Losses {
  std::vector<int> faps;
  std::vector<std::string_view> units, visemes, expressions;

  [[nodiscard]] bool empty() const { return faps.empty() && units.empty() && visemes.empty() && expressions.empty(); }
};

bool holds(const std::vector<FeaturePointId>& ids, std::uint8_t index) {
  return std::find(ids.begin(), ids.end(), FeaturePointId(index)) != ids.end();
}

std::vector<std::string_view> sets_with(std::span<const DisplacementSet> sets, const std::vector<FeaturePointId>& ids) {
  std::vector<std::string_view> names;
  for (const DisplacementSet& set : sets) {
    if (std::any_of(set.displacements.begin(), set.displacements.end(),
                    [&](const Displacement& d) { return holds(ids, d.point.value()); }))
      names.push_back(set.name);
  }
  return names;
}

Losses losses_without(const std::vector<FeaturePointId>& missing, const Fapu& fapu) {
  Losses losses;
  for (const auto& fap : mpeg4::faps) {
    if (fap.kind != mpeg4::FapKind::translation) continue;
    for (std::size_t i = 0; i < fap.feature_point_count; ++i) {
      if (!holds(missing, fap.feature_points[i])) continue;
      losses.faps.push_back(fap.number);
      break;
    }
  }
  for (std::size_t unit = 0; unit < fapu_unit_count; ++unit) {
    const auto& info = mpeg4::fapus[unit];
    for (std::size_t m = 0; m < info.measure_count && !fapu.value[unit]; ++m) {
      if (!holds(missing, info.measures[m].from) && !holds(missing, info.measures[m].to)) continue;
      losses.units.push_back(info.name);
      break;
    }
  }
  losses.visemes = sets_with(viseme_library(), missing);
  losses.expressions = sets_with(expression_library(), missing);
  return losses;
}

/// "3-5, 8".
std::string ranges(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t first = 0; first < numbers.size();) {
    std::size_t last = first;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    if (!text.empty()) text += ", ";
    text += std::to_string(numbers[first]);
    if (last > first) text += (last == first + 1 ? ", " : "-") + std::to_string(numbers[last]);
    first = last + 1;
  }
  return text;
}

std::string names(const std::vector<std::string_view>& list, std::size_t of) {
  if (list.size() == of) return "all";
  std::string text;
  for (const std::string_view name : list) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

std::string consequences(const Losses& losses, const std::vector<FeaturePointId>& missing) {
  std::string text;
  const auto add = [&](const std::string& sentence) { text += (text.empty() ? "" : "; ") + sentence; };
  if (!losses.units.empty())
    add(names(losses.units, 0) + " cannot be measured, so FAPs, visemes and expressions in that unit have no effect");
  if (!losses.faps.empty())
    add(losses.faps.size() == 1 ? "FAP " + ranges(losses.faps) + " has no effect there"
                                : "FAPs " + ranges(losses.faps) + " have no effect there");
  if (!losses.visemes.empty())
    add("part of these visemes is lost: " + names(losses.visemes, viseme_library().size() - 1));
  if (!losses.expressions.empty())
    add("part of these expressions is lost: " + names(losses.expressions, expression_library().size() - 1));
  if (missing.size() == 1 && to_string(missing.front()) == "7.1") add("the centre of head rotation is an estimate");
  if (text.empty()) text = "no motion needs them";
  return text;
}

}  // namespace

std::vector<Finding> find_missing_points(const Subject& head) {
  std::vector<Finding> findings;
  std::set<FeaturePointId> marked;
  for (const FeaturePoint& point : head.rig.points) marked.insert(point.id);
  if (marked.empty()) {
    Finding finding;
    finding.code = FindingCode::no_points;
    finding.severity = Severity::error;
    finding.words = "no feature point is marked, so nothing can move";
    finding.remedy = "mark at least the middle and the corners of the mouth, the lids, the pupils, 9.15 and 2.1";
    return {finding};
  }
  std::set<std::string_view> told;
  for (const Region& region : regions) {
    if (!told.insert(region.name).second) continue;
    Severity severity = Severity::note;
    std::vector<FeaturePointId> missing;
    for (std::uint8_t index = 0; index < feature_point_count; ++index) {
      const FeaturePointId id(index);
      if (marked.contains(id)) continue;
      for (const Region& same : regions) {
        if (same.name != region.name || !covers(same, id)) continue;
        missing.push_back(id);
        severity = std::min(severity, same.severity);
      }
    }
    if (missing.empty()) continue;
    const Losses losses = losses_without(missing, head.rig.fapu);
    Finding finding;
    finding.code = FindingCode::missing_points;
    finding.severity = !losses.units.empty() ? Severity::error : losses.empty() ? Severity::note : severity;
    finding.place.points = missing;
    finding.words = std::string(region.name) + ": " + list_of(missing) + (missing.size() == 1 ? " is" : " are") +
                    " not marked; " + consequences(losses, missing);
    finding.remedy = finding.severity == Severity::note
                         ? "mark them if the head has these places; otherwise no action is needed"
                         : "mark them, or let the server propose them from the marked points";
    findings.push_back(std::move(finding));
  }
  return findings;
}

}  // namespace semblante
