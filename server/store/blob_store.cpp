#include "server/store/blob_store.h"

#include <atomic>
#include <cerrno>
#include <system_error>

#include "protocol/hash/sha256.h"
#include "server/store/data_files.h"
#include "server/store/descriptor.h"
#include "server/store/file_hash.h"
#include "server/store/verified_blobs.h"

namespace semblante::store {
namespace {

namespace fs = std::filesystem;

/// io_error(); throws DiskFull instead when the disk is full.
Error write_error(const fs::path& path, int error_number = errno) {
  throw_if_disk_full(path, error_number);
  return io_error(path, error_number);
}

/// A file that is removed with this object, if it still exists.
struct RemovedFile {
  fs::path path;
  explicit RemovedFile(fs::path p) : path(std::move(p)) {}
  ~RemovedFile() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
  RemovedFile(const RemovedFile&) = delete;
  RemovedFile& operator=(const RemovedFile&) = delete;
};

}  // namespace

BlobStore::BlobStore(fs::path folder)
    : folder_(std::move(folder)),
      references_(std::make_shared<std::shared_mutex>()),
      verified_(std::make_shared<VerifiedBlobs>()) {}

BlobStore BlobStore::open(const fs::path& folder) {
  BlobStore blobs(folder);
  // The folder itself is kept: a full disk has no room for a new one. Behind a link are somebody else's files.
  std::error_code error;
  for (fs::directory_iterator left(blobs.temporary(), error), end;
       is_real_folder(blobs.temporary()) && !error && left != end; left.increment(error)) {
    std::error_code ignored;
    fs::remove_all(left->path(), ignored);
  }
  try {
    blobs.make_folders();
  } catch (const StoreError&) {  // reported by the caller, who calls make_folders() again
  }
  return blobs;
}

void BlobStore::make_folders() const {
  for (const auto& folder : {temporary(), folder_ / "blobs"}) make_folder(folder);
}

fs::path BlobStore::path_of(std::string_view sha256) const {
  return folder_ / data_file_path(DataFileKind::blob, sha256);
}

Result<Blob> BlobStore::adopt(const fs::path& path) const {
  const Descriptor file(path, O_RDONLY);
  if (!file.ok()) return write_error(path);
  Blob blob;
  auto hash = hash_of(file, blob.bytes);
  if (!hash) return write_error(path);
  blob.sha256 = std::move(*hash);
  const auto target = path_of(blob.sha256);
  std::error_code error;
  // The same content, complete and durable. A file that was not verified yet may be damaged: it is replaced, which
  // costs less than to read it.
  if (verified_->contains(blob.sha256, file_stamp(target))) {
    fs::remove(path, error);
    return blob;
  }
  if (::fsync(file.get()) != 0) return write_error(path);
  const bool new_folder = fs::create_directory(target.parent_path(), error);
  if (error) return write_error(target, error.value());
  if (new_folder && !sync_folder(folder_ / "blobs")) return write_error(folder_);
  if (::rename(path.c_str(), target.c_str()) != 0) return write_error(target);
  if (!sync_folder(target.parent_path())) return write_error(target);
  // Of the open file, not of whatever has the name by now.
  if (const auto stamp = file_stamp(file)) verified_->add(blob.sha256, *stamp);
  return blob;
}

Result<Blob> BlobStore::put(std::string_view bytes) const {
  static std::atomic<std::uint64_t> number{0};
  const RemovedFile file{temporary() / ("put-" + std::to_string(::getpid()) + "-" + std::to_string(number++))};
  {
    const Descriptor out(file.path, O_WRONLY | O_CREAT | O_EXCL);
    if (!out.ok()) return write_error(file.path);
    while (!bytes.empty()) {
      const auto written = ::write(out.get(), bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) return write_error(file.path);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  return adopt(file.path);
}

std::optional<fs::path> BlobStore::find(std::string_view sha256) const {
  if (!is_sha256_hex(sha256)) return std::nullopt;
  auto path = path_of(sha256);
  if (!is_real_file(path)) return std::nullopt;
  return path;
}

fs::path BlobStore::whole(std::string_view sha256, std::optional<std::uint64_t> bytes) const {
  const std::string name(sha256);
  const auto path = find(sha256);
  if (!path) throw DamagedBlob("the stored bytes with the SHA-256 " + name + " are missing");
  const DamagedBlob damaged("the stored bytes with the SHA-256 " + name + " are damaged");
  const auto stamp = file_stamp(*path);
  if (stamp && bytes && stamp->size != *bytes) throw damaged;
  if (verified_->contains(name, stamp)) return *path;
  const Descriptor file(*path, O_RDONLY);
  const auto before = file.ok() ? file_stamp(file) : std::nullopt;
  std::uint64_t read = 0;
  const auto hash = before ? hash_of(file, read) : std::nullopt;
  if (!hash) throw_store_error(*path, errno);
  if (*hash != sha256) throw damaged;
  if (file_stamp(file) == before) verified_->add(name, *before);
  return *path;
}

void BlobStore::remove(std::string_view sha256) const {
  std::error_code ignored;
  if (!is_sha256_hex(sha256)) return;
  fs::remove(path_of(sha256), ignored);
  verified_->remove(std::string(sha256));
}

}  // namespace semblante::store
