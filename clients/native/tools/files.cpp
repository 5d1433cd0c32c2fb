#include "clients/native/tools/files.h"

#include <fstream>
#include <system_error>

#include "core/import/import.h"

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

Result<Model> load_model(const std::filesystem::path& path) {
  auto bytes = read_file(path);
  if (!bytes) {
    return std::move(bytes).error();
  }
  const auto format = detect_format(*bytes, path.filename().string());
  if (!format) {
    return Error{ErrorCode::unsupported, path.string(),
                 "not a model of a format that is read: GLB, glTF, OBJ, PLY, STL"};
  }
  auto model = import_model(*bytes, *format);
  if (!model) {
    Error error = std::move(model).error();
    error.where = path.string() + (error.where.empty() ? "" : ": " + error.where);
    return error;
  }
  return model;
}

std::string to_text(const Error& error) {
  return error.where.empty() ? error.message : error.where + ": " + error.message;
}

}  // namespace semblante::tools
