#pragma once

#include <filesystem>

namespace semblante {

/// What `cmake --install` puts beside the program. A path is empty when nothing is there, as in a build folder.
struct InstalledFiles {
  std::filesystem::path web_root;  ///< the studio's pages
  std::filesystem::path sample;    ///< the sample head, with its feature points beside it
};

/// Searches relative to this program, so that an installation can be moved as a whole.
InstalledFiles installed_files();

/// The sample head that is installed, or the one of the build folder that this program is in; empty if there is none.
std::filesystem::path sample_head_file();

}  // namespace semblante
