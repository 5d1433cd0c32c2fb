#include "server/store/data_files.h"

#include <algorithm>
#include <system_error>

#include "protocol/hash/sha256.h"
#include "server/store/store_error.h"

namespace semblante::store {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view blobs_folder_name = "blobs";
constexpr std::string_view recording_extension = ".srec";
constexpr std::size_t prefix_length = 2;  ///< of a hash, as the name of its folder

/// The form that random_id() produces.
bool is_recording_id(std::string_view text) {
  return text.size() == 12 &&
         std::all_of(text.begin(), text.end(), [](char c) { return (c >= 'a' && c <= 'z') || (c >= '2' && c <= '7'); });
}

void add_if_file(const fs::path& path, std::string name, std::vector<DataFile>& files) {
  if (!is_real_file(path)) return;
  std::error_code error;
  const auto bytes = fs::file_size(path, error);
  files.push_back({std::move(name), error ? 0 : bytes});
}

/// Calls `each` for the entries of a folder; never when `folder` is not a folder.
template <class Each>
Status for_each_entry(const fs::path& folder, const Each& each) {
  if (!is_real_folder(folder)) return Unit{};
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    if (auto status = each(entry->path()); !status) return status;
  }
  if (error) return Error{ErrorCode::io, folder.string(), folder.string() + ": " + error.message()};
  return Unit{};
}

Status list_blobs(const fs::path& folder, std::vector<DataFile>& files) {
  return for_each_entry(folder, [&](const fs::path& prefix) {
    if (prefix.filename().string().size() != prefix_length) return Status(Unit{});
    return for_each_entry(prefix, [&](const fs::path& path) {
      auto name = path.filename().string();
      if (is_data_file_name(DataFileKind::blob, name) && name.starts_with(prefix.filename().string()))
        add_if_file(path, std::move(name), files);
      return Status(Unit{});
    });
  });
}

Status list_recordings(const fs::path& folder, std::vector<DataFile>& files) {
  return for_each_entry(folder, [&](const fs::path& path) {
    if (path.extension() == recording_extension && is_data_file_name(DataFileKind::recording, path.stem().string()))
      add_if_file(path, path.stem().string(), files);
    return Status(Unit{});
  });
}

}  // namespace

std::string recording_file_name(std::string_view id) { return std::string(id).append(recording_extension); }

bool is_data_file_name(DataFileKind kind, std::string_view name) {
  if (kind == DataFileKind::blob) return is_sha256_hex(name);
  if (kind == DataFileKind::recording) return is_recording_id(name);
  return name == database_log_name;
}

fs::path data_file_path(DataFileKind kind, std::string_view name) {
  switch (kind) {
    case DataFileKind::blob:
      return fs::path(blobs_folder_name) / name.substr(0, prefix_length) / name;
    case DataFileKind::recording:
      return fs::path(recordings_folder_name) / recording_file_name(name);
    case DataFileKind::database_log:
      break;
  }
  return database_log_name;
}

Result<std::vector<DataFile>> list_data_files(const fs::path& root, DataFileKind kind) {
  std::vector<DataFile> files;
  Status status = Unit{};
  if (kind == DataFileKind::blob)
    status = list_blobs(root / blobs_folder_name, files);
  else if (kind == DataFileKind::recording)
    status = list_recordings(root / recordings_folder_name, files);
  else
    add_if_file(root / database_log_name, std::string(database_log_name), files);
  if (!status) return status.error();
  return files;
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw_store_error(path, error.value());
}

bool is_real_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(fs::symlink_status(path, error));
}

bool is_real_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(fs::symlink_status(path, error));
}

}  // namespace semblante::store
