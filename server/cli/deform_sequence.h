#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/cli/face_formats.h"
#include "server/cli/head_input.h"

namespace semblante {

/// The options of `deform --frames`: a head in each face of a file, one mesh each.
struct DeformSequence {
  std::string frames;         ///< path of a .fap file or another face animation
  std::string frames_format;  ///< a name; empty: by the path
  FaceReading reading;
  std::optional<std::uint32_t> from, to;  ///< frame numbers; empty: the first, the last
  std::uint32_t between = 0;              ///< meshes between each frame and the next
  std::string format = "obj";             ///< "obj" or "ply"
};

/// Writes frame-00000.obj, ... into the folder `out`, numbered by meshes. In a file with a rate, frames have numbers,
/// and missing frames are filled in; other files have one frame per entry. Between two frames the displacements of the
/// feature points are interpolated linearly and rotations along the shorter arc: every vertex moves as in the paper.
/// Throws CommandFailure.
void write_deformed_sequence(const DeformSequence& options, Head& head, const std::string& out);

}  // namespace semblante
