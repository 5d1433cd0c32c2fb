#include "server/store/blob_store.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <span>
#include <system_error>
#include <vector>

#include "server/hash/sha256.h"
#include "server/store/data_files.h"
#include "server/store/descriptor.h"

namespace semblante::store {
namespace {

namespace fs = std::filesystem;

Error io_error(const fs::path& path) {
  return {ErrorCode::io, path.string(), path.string() + ": " + std::strerror(errno)};
}

}  // namespace

Result<BlobStore> BlobStore::open(const fs::path& folder) {
  std::error_code error;
  fs::remove_all(folder / "tmp", error);
  fs::create_directories(folder / "tmp", error);
  if (!error) fs::create_directories(folder / "blobs", error);
  if (error) return Error{ErrorCode::io, folder.string(), folder.string() + ": " + error.message()};
  return BlobStore(folder);
}

fs::path BlobStore::path_of(std::string_view sha256) const {
  return folder_ / data_file_path(DataFileKind::blob, sha256);
}

Result<Blob> BlobStore::adopt(const fs::path& path) const {
  const Descriptor file(path, O_RDONLY);
  if (!file.ok()) return io_error(path);
  Sha256Stream hash;
  Blob blob;
  std::vector<std::uint8_t> piece(1U << 18U);
  while (true) {
    const auto got = ::read(file.get(), piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return io_error(path);
    if (got == 0) break;
    hash.update(std::span(piece).first(static_cast<std::size_t>(got)));
    blob.bytes += static_cast<std::uint64_t>(got);
  }
  blob.sha256 = to_hex(hash.finish());
  const auto target = path_of(blob.sha256);
  std::error_code error;
  if (is_real_file(target)) {  // the same content is there already, whole and durable
    fs::remove(path, error);
    return blob;
  }
  if (::fsync(file.get()) != 0) return io_error(path);
  const bool new_folder = fs::create_directory(target.parent_path(), error);
  if (error) return Error{ErrorCode::io, target.string(), target.string() + ": " + error.message()};
  if (new_folder && !sync_folder(folder_ / "blobs")) return io_error(folder_);
  if (::rename(path.c_str(), target.c_str()) != 0) return io_error(target);
  if (!sync_folder(target.parent_path())) return io_error(target);
  return blob;
}

Result<Blob> BlobStore::put(std::string_view bytes) const {
  static std::atomic<std::uint64_t> number{0};
  const auto path = temporary() / ("put-" + std::to_string(::getpid()) + "-" + std::to_string(number++));
  {
    const Descriptor file(path, O_WRONLY | O_CREAT | O_EXCL);
    if (!file.ok()) return io_error(path);
    while (!bytes.empty()) {
      const auto written = ::write(file.get(), bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) {
        auto error = io_error(path);
        std::error_code ignored;
        fs::remove(path, ignored);
        return error;
      }
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  return adopt(path);
}

std::optional<fs::path> BlobStore::find(std::string_view sha256) const {
  if (!is_sha256_hex(sha256)) return std::nullopt;
  auto path = path_of(sha256);
  if (!is_real_file(path)) return std::nullopt;
  return path;
}

void BlobStore::remove(std::string_view sha256) const {
  std::error_code ignored;
  if (is_sha256_hex(sha256)) fs::remove(path_of(sha256), ignored);
}

}  // namespace semblante::store
