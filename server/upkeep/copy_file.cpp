#include "server/upkeep/copy_file.h"

#include <span>
#include <vector>

#include "protocol/hash/sha256.h"
#include "server/store/descriptor.h"
#include "server/store/store_error.h"

namespace semblante::upkeep {
namespace {

namespace fs = std::filesystem;

void write_all(const store::Descriptor& file, const fs::path& path, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const auto written = ::write(file.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) store::throw_store_error(path, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

}  // namespace

Result<store::Blob> copy_bytes(const fs::path& from, const fs::path& to) {
  const store::Descriptor source(from, O_RDONLY);
  if (!source.ok() && errno == ENOENT) return Error{ErrorCode::missing, "", "it is missing"};
  if (!source.ok()) return Error{ErrorCode::io, "", "it cannot be read: " + store::reason_of(from, errno)};
  const store::Descriptor copy(to, O_WRONLY | O_CREAT | O_TRUNC);
  if (!copy.ok()) store::throw_store_error(to, errno);
  Sha256Stream hash;
  store::Blob blob;
  std::vector<std::uint8_t> piece(1U << 18U);
  while (true) {
    const auto got = ::read(source.get(), piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return Error{ErrorCode::io, "", std::string("it cannot be read: ") + std::strerror(errno)};
    if (got == 0) break;
    const auto bytes = std::span(piece).first(static_cast<std::size_t>(got));
    hash.update(bytes);
    write_all(copy, to, bytes);
    blob.bytes += bytes.size();
  }
  blob.sha256 = to_hex(hash.finish());
  return blob;
}

void sync_file_system(const fs::path& folder) {
  const store::Descriptor descriptor(folder, O_RDONLY | O_DIRECTORY);
  if (!descriptor.ok() || ::syncfs(descriptor.get()) != 0) store::throw_store_error(folder, errno);
}

void write_durably(const fs::path& path, std::string_view text) {
  const fs::path part = path.string() + ".part";
  {
    const store::Descriptor file(part, O_WRONLY | O_CREAT | O_TRUNC);
    if (!file.ok()) store::throw_store_error(part, errno);
    write_all(file, part, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    if (::fsync(file.get()) != 0) store::throw_store_error(part, errno);
  }
  if (::rename(part.c_str(), path.c_str()) != 0 || !store::sync_folder(path.parent_path()))
    store::throw_store_error(path, errno);
}

}  // namespace semblante::upkeep
