#pragma once

#include <string>
#include <vector>

namespace semblante {

/// The warnings of a head by pipeline stage. The pipeline moves the warnings of Model and Rig here, so that each is
/// stored once.
struct HeadWarnings {
  std::vector<std::string> file;    ///< what the import repaired or omitted
  std::vector<std::string> stance;  ///< how the head was rotated, or that its axes are uncertain
  std::vector<std::string> points;  ///< problems of placing the marked points on the model
  std::vector<std::string> rig;     ///< what is missing, and what does not move without it
  std::vector<std::string> levels;  ///< budgets that no level meets

  /// All warnings in the order of the members, equal ones grouped (WarningGroups), for users and for rig.json.
  [[nodiscard]] std::vector<std::string> all() const;
};

}  // namespace semblante
