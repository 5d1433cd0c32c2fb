#pragma once

#include <string>
#include <vector>

namespace semblante {

/// The warnings of a head by pipeline stage. The pipeline moves the warnings of Model and Rig here, so that each is
/// stored once.
struct HeadWarnings {
  std::vector<std::string> file;    ///< what was repaired or left out on import
  std::vector<std::string> stance;  ///< how the head was turned, or that its stance is not sure
  std::vector<std::string> points;  ///< how the marked points meet the model
  std::vector<std::string> rig;     ///< what is missing and what it stops
  std::vector<std::string> levels;  ///< budgets that no level keeps

  /// All warnings in the order of the members, for users and for rig.json.
  [[nodiscard]] std::vector<std::string> all() const;
};

}  // namespace semblante
