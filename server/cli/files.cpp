#include "server/cli/files.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "server/cli/command_failure.h"

namespace semblante {
namespace {

std::string reason() { return std::strerror(errno); }

}  // namespace

std::vector<std::uint8_t> read_file(const std::string& path, std::size_t max_bytes) {
  std::error_code fault;
  if (std::filesystem::is_directory(path, fault)) {
    throw CommandFailure(CommandFailure::bad_input, path + ": is a folder");
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw CommandFailure(CommandFailure::bad_input, path + ": " + reason());
  std::vector<std::uint8_t> bytes;
  // Reads to the end without querying the size: the file may be a pipe, or grow.
  std::array<char, 1U << 16U> block{};
  while (file) {
    file.read(block.data(), block.size());
    const auto count = static_cast<std::size_t>(file.gcount());
    if (count > max_bytes - bytes.size()) {
      throw CommandFailure(CommandFailure::bad_input,
                           path + ": has more than " + std::to_string(max_bytes) + " bytes, which is the limit");
    }
    bytes.insert(bytes.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(count));
  }
  if (file.bad()) throw CommandFailure(CommandFailure::bad_input, path + ": " + reason());
  return bytes;
}

void write_file(const std::string& path, const std::function<void(std::ostream&)>& write) {
  if (path == "-") {
    write(std::cout);
    std::cout.flush();
    if (!std::cout) throw CommandFailure(CommandFailure::internal, "standard output: cannot be written");
    return;
  }
  std::error_code fault;
  // A device or a pipe is written directly, because it cannot be replaced by a rename.
  const bool in_place = std::filesystem::exists(path, fault) && !std::filesystem::is_regular_file(path, fault);
  const std::string target = in_place ? path : path + ".part";
  errno = 0;
  std::ofstream file(target, std::ios::binary | std::ios::trunc);
  if (!file) throw CommandFailure(CommandFailure::bad_input, path + ": cannot be written: " + reason());
  write(file);
  file.close();
  if (!file) {
    const std::string why = reason();
    if (!in_place) std::filesystem::remove(target, fault);
    throw CommandFailure(CommandFailure::internal, path + ": cannot be written: " + why);
  }
  if (in_place) return;
  std::filesystem::rename(target, path, fault);
  if (fault) throw CommandFailure(CommandFailure::internal, path + ": cannot be written: " + fault.message());
}

void write_file(const std::string& path, std::span<const std::uint8_t> bytes) {
  write_file(path, [bytes](std::ostream& out) {
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  });
}

}  // namespace semblante
