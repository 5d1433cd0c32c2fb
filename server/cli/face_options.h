#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/kernel/semblante_kernel.h"
#include "core/types/rig.h"
#include "server/cli/head_input.h"

namespace semblante {

/// The command line options of a face, as text.
struct FaceOptions {
  std::string faps;           ///< "3=200,19=512"
  std::string viseme;         ///< number 0..14 or name; empty: none
  std::string expression;     ///< number 1..6 or name; empty: none
  double intensity = 1.0;     ///< of both and of the set, 0..1
  std::string displacements;  ///< path of a JSON file; empty: none
  std::string set;            ///< path of a displacement set; empty: none
};

/// The pose of a head for these options. Throws CommandFailure naming the option, or the place in the file, and the
/// reason: an unknown name or number, a point that is not marked, a FAPU that cannot be measured. Points of a viseme or
/// expression that cannot move, because a unit is unknown or the point is not marked, give a warning.
semblante_pose make_pose(const FaceOptions& options, const Head& head, std::vector<std::string>& warnings);

}  // namespace semblante
