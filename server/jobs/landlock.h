#pragma once

#include <filesystem>

#include "core/types/result.h"

namespace semblante::jobs {

/// Forbids this thread, and all that it starts, every access to files except creating and writing files in `folder`
/// (Landlock); and, as far as the kernel can, TCP (6.7 and later), signals and abstract sockets to other processes
/// (6.12). Descriptors that are open stay usable. Cannot be taken back. To be called after PR_SET_NO_NEW_PRIVS.
///
/// Returns the version of Landlock that is in force, at most `highest_version`; 0 if the system has none or forbids it.
/// Error `internal`: it should have worked. Error `io`: the folder cannot be opened.
Result<int> restrict_files(const std::filesystem::path& folder, int highest_version);

/// The newest version that restrict_files() knows.
inline constexpr int newest_landlock = 6;

}  // namespace semblante::jobs
