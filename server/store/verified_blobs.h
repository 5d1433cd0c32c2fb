#pragma once

#include <cstdint>
#include <ctime>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

#include "server/store/descriptor.h"

namespace semblante::store {

/// What changes when the bytes of a file change or another file takes its name. The kernel alone sets the time of the
/// last change (ctime), so it also tells of a program that sets the time of the last write back.
struct FileStamp {
  std::uint64_t device = 0, inode = 0, size = 0;
  std::int64_t written = 0, changed = 0;  ///< ns since 1970

  bool operator==(const FileStamp&) const = default;
};

/// nullopt for anything but a regular file.
std::optional<FileStamp> file_stamp(const std::filesystem::path& path);
std::optional<FileStamp> file_stamp(const Descriptor& file);

/// The blobs whose bytes this process has hashed, and the files that had them. Any thread.
class VerifiedBlobs {
 public:
  /// Whether the file with this stamp was found intact.
  [[nodiscard]] bool contains(const std::string& sha256, const std::optional<FileStamp>& stamp) const;
  void add(const std::string& sha256, const FileStamp& stamp);
  void remove(const std::string& sha256);

 private:
  mutable std::mutex mutex_;
  std::unordered_map<std::string, FileStamp> stamps_;
};

}  // namespace semblante::store
