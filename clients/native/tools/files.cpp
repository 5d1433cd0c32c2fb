#include "clients/native/tools/files.h"

#include <fstream>
#include <system_error>

namespace semblante::tools {
namespace {

constexpr std::uintmax_t max_file_bytes = std::uintmax_t{256} << 20U;

}  // namespace

Result<std::vector<std::uint8_t>> read_file(const std::filesystem::path& path) {
  std::error_code problem;
  const std::uintmax_t size = std::filesystem::file_size(path, problem);
  if (problem) {
    return Error{ErrorCode::io, path.string(), problem.message()};
  }
  if (size > max_file_bytes) {
    return Error{ErrorCode::too_large, path.string(), "the file is larger than 256 MiB"};
  }
  std::vector<std::uint8_t> bytes(size);
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file) {
    return Error{ErrorCode::io, path.string(), "could not read the file"};
  }
  return bytes;
}

Status write_file(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) {
    return Error{ErrorCode::io, path.string(), "could not write the file"};
  }
  return Unit{};
}

Error in_file(const std::filesystem::path& path, Error error) {
  error.where = path.string() + (error.where.empty() ? "" : ": " + error.where);
  return error;
}

std::string to_text(const Error& error) {
  return error.where.empty() ? error.message : error.where + ": " + error.message;
}

}  // namespace semblante::tools
