#pragma once

#include "server/cli/face_formats.h"

namespace CLI {
class App;
}

namespace semblante {

/// Declares --absent and --gaps: how `convert` and `deform` read a .fap file.
void add_face_reading_options(CLI::App& command, FaceReading& reading);

}  // namespace semblante
