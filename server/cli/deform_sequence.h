#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/cli/face_formats.h"
#include "server/cli/head_input.h"

namespace semblante {

/// A head in the faces of a file, one mesh each: what `deform --frames` writes.
struct DeformSequence {
  std::string frames;         ///< path of a .fap file or another of faces in time
  std::string frames_format;  ///< a name; empty: by the path
  FaceReading reading;
  std::optional<std::uint32_t> from, to;  ///< frame numbers; empty: the first, the last
  std::uint32_t between = 0;              ///< meshes between each frame and the next
  std::string format = "obj";             ///< "obj" or "ply"
};

/// Writes frame-00000.obj, ... into the folder `out`, numbered by meshes. A file with a rate has frames by their
/// numbers, so that those it leaves out are filled in; others have one frame an entry. Between two frames the
/// displacements of the feature points go linearly and rotations along the shorter arc: every vertex goes as the paper
/// interpolates it. Throws CommandFailure.
void write_deformed_sequence(const DeformSequence& options, Head& head, const std::string& out);

}  // namespace semblante
