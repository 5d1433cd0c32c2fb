#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <sys/types.h>

namespace semblante::test {

constexpr const char* troubled_voice = SEMBLANTE_SOURCE_DIR "/tests/integration/server/troubled_voice.py";

/// Of the server's, with the voice's program in their command line.
inline std::size_t voices_of(pid_t server) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream stat(entry.path() / "stat"), command(entry.path() / "cmdline");
    std::string pid, name, state, parent;
    stat >> pid >> name >> state >> parent;
    const std::string line{std::istreambuf_iterator<char>(command), {}};
    count += parent == std::to_string(server) && line.find(troubled_voice) != std::string::npos ? 1 : 0;
  }
  return count;
}

}  // namespace semblante::test
