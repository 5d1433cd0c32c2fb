#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/result.h"

namespace semblante::store {

/// The files of a data folder other than the database file. In the trash they have the same paths, below its folders.
enum class DataFileKind {
  blob,          ///< blobs/ab/<sha256>
  recording,     ///< recordings/<id>.srec
  database_log,  ///< semblante.sqlite-wal: commits that are not in semblante.sqlite yet; there is only this one
};
inline constexpr std::array data_file_kinds = {DataFileKind::blob, DataFileKind::recording, DataFileKind::database_log};

inline constexpr std::string_view database_file_name = "semblante.sqlite";
inline constexpr std::string_view database_log_name = "semblante.sqlite-wal";
inline constexpr std::string_view recordings_folder_name = "recordings";

/// Made by `serve --lan`, the same for all its runs: phones have accepted it. Certificate and key, below a data folder.
inline constexpr std::array<std::string_view, 2> home_certificate_files = {"lan/certificate.pem", "lan/key.pem"};

std::string recording_file_name(std::string_view id);
/// Whether `name` has the form that the server gives to files of this kind.
bool is_data_file_name(DataFileKind kind, std::string_view name);
/// The path of the file with this name (hash or id) below a data folder.
std::filesystem::path data_file_path(DataFileKind kind, std::string_view name);

struct DataFile {
  std::string name;  ///< hash or id
  std::uint64_t bytes = 0;
};
/// All files of a kind below a folder, in no order. Files with other names or in other places are skipped, and so are
/// symbolic links, which are never followed. Empty when the folder is missing. Errors: io.
Result<std::vector<DataFile>> list_data_files(const std::filesystem::path& root, DataFileKind kind);

/// Makes a folder of the data folder unless it exists. Throws StoreError.
void make_folder(const std::filesystem::path& path);

/// True for a file or a folder itself, false for a symbolic link to one.
bool is_real_file(const std::filesystem::path& path);
bool is_real_folder(const std::filesystem::path& path);

}  // namespace semblante::store
