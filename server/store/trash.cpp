#include "server/store/trash.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>
#include <optional>
#include <system_error>

#include <sys/stat.h>

#include "server/store/descriptor.h"

namespace semblante::store {
namespace {

namespace fs = std::filesystem;
using std::chrono::system_clock;

constexpr const char* time_format = "%Y-%m-%dT%H-%M-%SZ";  // no colons, which other systems do not allow in file names
constexpr std::size_t time_length = 20;
constexpr int most_batches_of_a_second = 1000;

std::string time_name(system_clock::time_point time) {
  const std::time_t seconds = system_clock::to_time_t(time);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), time_format, &utc)};
}

/// The time of a batch, from the first 20 characters of its name; nullopt when a server did not name it.
std::optional<system_clock::time_point> parse_time_name(const std::string& name) {
  if (name.size() < time_length) return std::nullopt;
  std::tm utc{};
  const auto text = name.substr(0, time_length);
  const char* end = strptime(text.c_str(), time_format, &utc);
  if (end == nullptr || *end != '\0') return std::nullopt;
  const auto rest = name.substr(time_length);
  if (!rest.empty() && (rest[0] != '-' || rest.size() == 1 || rest.find_first_not_of("0123456789", 1) != rest.npos))
    return std::nullopt;
  return system_clock::from_time_t(timegm(&utc));
}

/// Removes the empty folders on a file's path below `root`.
void remove_empty_folders(const fs::path& root, const fs::path& relative) {
  for (auto folder = relative.parent_path(); !folder.empty(); folder = folder.parent_path())
    if (::rmdir((root / folder).c_str()) != 0) return;
}

/// Makes the folders on a file's path below `root`. Errors: io, also for symbolic links in place of folders.
Status make_folders(const fs::path& root, const fs::path& relative) {
  fs::path folder = root;
  for (const auto& part : relative.parent_path()) {
    folder /= part;
    if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) return io_error(folder, errno);
    if (!is_real_folder(folder)) return io_error(folder, ENOTDIR);
  }
  return Unit{};
}

/// Whether the file exists, with no symbolic link on the path from `root`.
bool has_real_file(const fs::path& root, const fs::path& relative) {
  fs::path folder = root;
  for (const auto& part : relative.parent_path())
    if (!is_real_folder(folder /= part)) return false;
  return is_real_file(root / relative);
}

std::uint64_t size_of(const fs::path& path) {
  std::error_code error;
  const auto bytes = fs::file_size(path, error);
  return error ? 0 : bytes;
}

}  // namespace

Trash::Trash(fs::path data, std::chrono::seconds grace, Time now) : data_(std::move(data)), grace_(grace), start_(now) {
  for (const auto& batch : batches())
    for (const auto kind : data_file_kinds) {
      const auto files = list_data_files(batch, kind);
      if (!files) continue;  // not readable: the batch is kept
      for (const auto& file : *files) {
        ++files_;
        bytes_ += file.bytes;
      }
    }
}

std::vector<fs::path> Trash::batches() const {
  std::vector<fs::path> found;
  const auto folder = data_ / "trash";
  if (!is_real_folder(folder)) return found;
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error))
    if (parse_time_name(entry->path().filename().string()) && is_real_folder(entry->path()))
      found.push_back(entry->path());
  std::sort(found.rbegin(), found.rend());
  return found;
}

Status Trash::make_batch() {
  const auto folder = data_ / "trash";
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) return io_error(folder, errno);
  if (!is_real_folder(folder)) return io_error(folder, ENOTDIR);
  // A new batch for each start, so that no rename replaces a file of the same name.
  for (int number = 1; number <= most_batches_of_a_second; ++number) {
    auto name = time_name(start_);
    if (number > 1) name.append("-").append(std::to_string(number));
    auto batch = folder / name;
    if (::mkdir(batch.c_str(), 0700) == 0) {
      touched_.insert({data_, folder, batch});
      batch_ = std::move(batch);
      return Unit{};
    }
    if (errno != EEXIST) return io_error(batch, errno);
  }
  return io_error(folder, EEXIST);
}

Status Trash::move(const fs::path& from, const fs::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0) return io_error(from, errno);
  touched_.insert({from.parent_path(), to.parent_path(), to.parent_path().parent_path()});
  return Unit{};
}

Status Trash::put(DataFileKind kind, std::string_view name) {
  if (batch_.empty()) {
    if (auto made = make_batch(); !made) return made;
  }
  const auto path = data_file_path(kind, name);
  if (auto made = make_folders(batch_, path); !made) return made;
  const auto bytes = size_of(data_ / path);
  if (auto moved = move(data_ / path, batch_ / path); !moved) {
    remove_empty_folders(batch_, path);
    if (::rmdir(batch_.c_str()) == 0) batch_.clear();
    return moved;
  }
  ++files_;
  bytes_ += bytes;
  return Unit{};
}

Result<bool> Trash::put_back(DataFileKind kind, std::string_view name) {
  if (!is_data_file_name(kind, name)) return false;
  const auto path = data_file_path(kind, name);
  std::error_code error;
  if (fs::symlink_status(data_ / path, error).type() != fs::file_type::not_found) return false;
  for (const auto& batch : batches()) {
    if (!has_real_file(batch, path)) continue;
    fs::create_directories((data_ / path).parent_path(), error);
    const auto bytes = size_of(batch / path);
    if (auto moved = move(batch / path, data_ / path); !moved) return moved.error();
    --files_;
    bytes_ -= bytes;
    remove_empty_folders(batch, path);
    ::rmdir(batch.c_str());
    return true;
  }
  return false;
}

Status Trash::sync() {
  for (const auto& folder : touched_)  // folders that were removed because they were empty are missing here
    if (!sync_folder(folder) && errno != ENOENT) return io_error(folder, errno);
  touched_.clear();
  return Unit{};
}

bool Trash::is_over(const fs::path& batch, Time now) const {
  if (batch == batch_ && grace_ == std::chrono::seconds::zero()) return false;
  const auto made = parse_time_name(batch.filename().string());
  return made && *made + grace_ <= now;
}

Trash::Counts Trash::purge(Time now, const std::stop_token& stop) {
  Counts removed;
  for (const auto& batch : batches()) {
    if (!is_over(batch, now)) continue;
    for (const auto kind : data_file_kinds) {
      const auto files = list_data_files(batch, kind);
      if (!files) continue;
      for (const auto& file : *files) {
        if (stop.stop_requested()) return removed;
        const auto path = data_file_path(kind, file.name);
        if (::unlink((batch / path).c_str()) != 0) continue;
        --files_;
        bytes_ -= file.bytes;
        ++removed.files;
        removed.bytes += file.bytes;
        remove_empty_folders(batch, path);
      }
    }
    ::rmdir(batch.c_str());
  }
  ::rmdir((data_ / "trash").c_str());
  return removed;
}

}  // namespace semblante::store
