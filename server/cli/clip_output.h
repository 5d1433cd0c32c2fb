#pragma once

#include <string>
#include <vector>

#include "server/cli/face_formats.h"
#include "server/cli/head_input.h"

namespace CLI {
class App;
}

namespace semblante {

/// A face animation on a head as an animated GLB, written by `convert --out FILE.glb`.
struct ClipOutput {
  HeadOptions head;     ///< a head to parametrize first, or
  std::string package;  ///< a folder that `parametrize --out` wrote
  int influences = 8;
};

/// Declares --package, --influences and the head's options, as --model and so on.
void add_clip_options(CLI::App& command, ClipOutput& options);

/// Whether `format` or, if that is empty, the extension of `path` selects such a file.
bool is_clip(const std::string& path, const std::string& format);

/// Writes `out`, animated as `name`; returns warnings. Throws CommandFailure.
std::vector<std::string> write_clip(const ClipOutput& options, const FaceSequence& sequence, const std::string& name,
                                    const std::string& out);

}  // namespace semblante
