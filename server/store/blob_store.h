#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <shared_mutex>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/types/result.h"
#include "server/store/store_error.h"

namespace semblante::store {

/// A stored blob: its name and size.
struct Blob {
  std::string sha256;
  std::uint64_t bytes = 0;
};

/// A blob that a record refers to is missing, or its bytes are not those of its name. what() names it for clients,
/// without a path. A retry does not help: the same bytes have to be stored again.
class DamagedBlob : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class VerifiedBlobs;

/// Bytes by their SHA-256, in a folder: blobs/ab/abcdef.... A file gets its final name only when it is complete and
/// durable (write, fsync, rename, fsync of the folder), so a blob is intact after a crash at any moment. What a disk or
/// another program changes later is found by whole(), and mended by storing the same bytes again. A symbolic link in
/// the place of a blob is not a blob. Any thread.
class BlobStore {
 public:
  /// Makes missing folders and removes the unfinished files of an earlier process in `temporary()`. On a full disk, or
  /// where something else has their names, the folders may still be missing: call make_folders() later.
  static BlobStore open(const std::filesystem::path& folder);
  /// Makes missing folders. Throws StoreError.
  void make_folders() const;

  /// The folder for files that adopt() will rename into the store; on the same file system.
  [[nodiscard]] std::filesystem::path temporary() const { return folder_ / "tmp"; }

  /// Moves a file into the store: hashes it, makes it durable and renames it. `path` does not exist afterwards. A file
  /// that has the name already is replaced unless it is known to be intact. Errors: io. Throws DiskFull.
  Result<Blob> adopt(const std::filesystem::path& path) const;
  /// The same for bytes in memory.
  Result<Blob> put(std::string_view bytes) const;

  /// The file of a blob, whatever its bytes are; nullopt when it does not exist. `sha256` may be any text.
  [[nodiscard]] std::optional<std::filesystem::path> find(std::string_view sha256) const;
  /// The file of an intact blob. The first call for a file hashes it; later ones only compare its inode, size and times
  /// with those it had then. A file that has not as many `bytes` is damaged, and is not read: it may have grown without
  /// end. Throws DamagedBlob, and StoreError when the file cannot be read.
  [[nodiscard]] std::filesystem::path whole(std::string_view sha256, std::optional<std::uint64_t> bytes = {}) const;
  /// Deletes the file permanently; blobs that a user deleted or a job replaced do not pass through the trash.
  void remove(std::string_view sha256) const;

  /// Held shared from adopt() until the record that refers to the blob is committed, and exclusively from the commit
  /// that drops the last reference until remove(). So no thread removes a blob that another thread is about to refer
  /// to.
  [[nodiscard]] std::shared_mutex& references() const { return *references_; }

 private:
  explicit BlobStore(std::filesystem::path folder);
  [[nodiscard]] std::filesystem::path path_of(std::string_view sha256) const;

  std::filesystem::path folder_;
  std::shared_ptr<std::shared_mutex> references_;
  std::shared_ptr<VerifiedBlobs> verified_;
};

}  // namespace semblante::store
