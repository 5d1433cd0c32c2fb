#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <shared_mutex>
#include <string>
#include <string_view>

#include "core/types/result.h"
#include "server/store/store_error.h"

namespace semblante::store {

/// A blob that is there: its name and size.
struct Blob {
  std::string sha256;
  std::uint64_t bytes = 0;
};

/// Bytes by their SHA-256, in a folder: blobs/ab/abcdef.... A file has its final name only when it is whole and on the
/// disk (write, fsync, rename, fsync of the folder), so what is there is right, whenever the machine stopped. A
/// symbolic link in the place of a blob is none. Any thread.
class BlobStore {
 public:
  /// Makes the folders that are missing and removes what an earlier process left half done in `temporary()`. On a full
  /// disk make_folders() is still to be called.
  static Result<BlobStore> open(const std::filesystem::path& folder);
  /// Makes the folders that are missing. Errors: io. Throws DiskFull.
  Status make_folders() const;

  /// Where files may be prepared that adopt() takes over by a rename; same file system.
  [[nodiscard]] std::filesystem::path temporary() const { return folder_ / "tmp"; }

  /// Takes a file over: hashes it, makes it durable, gives it its name. The file at `path` is gone afterwards. Errors:
  /// io. Throws DiskFull.
  Result<Blob> adopt(const std::filesystem::path& path) const;
  /// The same for bytes in memory.
  Result<Blob> put(std::string_view bytes) const;

  /// The file of a blob; nullopt when it is not there. `sha256` may be any text.
  [[nodiscard]] std::optional<std::filesystem::path> find(std::string_view sha256) const;
  /// At once and for good: what its owner has deleted or replaced does not go into the trash.
  void remove(std::string_view sha256) const;

  /// Held shared from adopt() until the fact that refers to the blob is committed, and alone from the commit that drops
  /// the last reference until remove(): so nobody removes what another has just found to be there.
  [[nodiscard]] std::shared_mutex& references() const { return *references_; }

 private:
  explicit BlobStore(std::filesystem::path folder)
      : folder_(std::move(folder)), references_(std::make_shared<std::shared_mutex>()) {}
  [[nodiscard]] std::filesystem::path path_of(std::string_view sha256) const;

  std::filesystem::path folder_;
  std::shared_ptr<std::shared_mutex> references_;
};

}  // namespace semblante::store
