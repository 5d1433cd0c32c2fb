#include "server/api/export_file.h"

#include <cerrno>
#include <fcntl.h>
#include <unistd.h>
#include <utility>

#include "server/store/disk_space.h"
#include "server/store/records.h"
#include "server/store/store_error.h"

namespace semblante::api {

ExportFile::ExportFile(const std::filesystem::path& folder, std::uint64_t reserve)
    : file_(std::make_shared<http::TemporaryFile>(folder / ("export-" + store::random_id()))),
      folder_(folder),
      reserve_(reserve),
      buffer_(buffer_bytes),
      stream_(this) {
  descriptor_ = ::open(file_->path().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor_ < 0) store::throw_store_error("export", errno);
  setp(buffer_.data(), buffer_.data() + buffer_.size());
}

ExportFile::~ExportFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool ExportFile::write_buffer() {
  const char* next = pbase();
  const auto size = static_cast<std::uint64_t>(pptr() - pbase());
  if (const auto free = store::free_bytes(folder_); free < reserve_ || free - reserve_ < size) {
    is_disk_full_ = true;
    return false;
  }
  while (next < pptr()) {
    const auto count = ::write(descriptor_, next, static_cast<std::size_t>(pptr() - next));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      error_ = errno;
      return false;
    }
    next += count;
  }
  written_ += size;
  setp(buffer_.data(), buffer_.data() + buffer_.size());
  return true;
}

ExportFile::int_type ExportFile::overflow(int_type byte) {
  if (!write_buffer()) return traits_type::eof();
  if (!traits_type::eq_int_type(byte, traits_type::eof())) {
    *pptr() = traits_type::to_char_type(byte);
    pbump(1);
  }
  return traits_type::not_eof(byte);
}

int ExportFile::sync() { return write_buffer() ? 0 : -1; }

void ExportFile::check() const {
  if (is_disk_full_) throw store::DiskFull("the disk has no room for this export: take a part");
  if (error_ != 0) store::throw_store_error("export", error_);
}

http::FileBody ExportFile::finish() {
  stream_.flush();
  check();
  if (::close(std::exchange(descriptor_, -1)) != 0) store::throw_store_error("export", errno);
  return {file_->path(), 0, written_, std::move(file_)};
}

}  // namespace semblante::api
