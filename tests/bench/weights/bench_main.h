#pragma once

#include <filesystem>

namespace semblante::bench {

/// A bench program's main: `run` on the folder of the ICT head, the one with real expressions. Says so where no real
/// heads are; returns 1 when `run` throws.
int run_on_ict_head(const char* program, void (*run)(const std::filesystem::path& folder));

}  // namespace semblante::bench
