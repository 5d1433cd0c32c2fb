#pragma once

#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "core/doctor/report.h"

namespace semblante {

inline constexpr int report_version = 1;

/// A member of the report document beside the findings: the results of another stage for the same head.
struct ReportSection {
  std::string name;  ///< of the member
  nlohmann::ordered_json value;
};

/// The report document, `report.json`, as text:
///
///     {"version": 1,
///      "summary": {"errors": 1, "warnings": 0, "notes": 2},
///      "findings": [{"code": "lips-joined", "severity": "error", "words": "...", "remedy": "...",
///                    "place": {"part": 0, "points": ["2.2"], "vertices": {"sample": [17], "count": 1},
///                              "position": [x, y, z]},
///                    "measured": {"what": "...", "value": 0.1, "threshold": 0.5}}],
///      <sections, in their order>}
///
/// `part`, `position` and `measured` are null where a finding has none. The sections' names must be none of the
/// members above.
std::string write_report(const Report& report, std::span<const ReportSection> sections = {});

}  // namespace semblante
