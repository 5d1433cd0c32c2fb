#include "server/recordings/byte_source.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <string>
#include <unistd.h>
#include <utility>

#include <sys/stat.h>

#include "server/store/data_files.h"
#include "server/store/descriptor.h"

namespace semblante::recordings {
namespace {

class FileBytes : public ByteSource {
 public:
  FileBytes(const std::filesystem::path& path, std::uint64_t size) : file_(path, O_RDONLY) {
    struct stat facts {};
    if (file_.ok() && ::fstat(file_.get(), &facts) == 0)
      size_ = std::min(size, static_cast<std::uint64_t>(facts.st_size));
  }
  [[nodiscard]] bool ok() const { return file_.ok(); }
  [[nodiscard]] std::uint64_t size() const override { return size_; }
  [[nodiscard]] bool read(std::uint64_t offset, std::span<std::uint8_t> to) const override {
    if (offset > size_ || to.size() > size_ - offset) return false;
    while (!to.empty()) {
      const auto got = ::pread(file_.get(), to.data(), to.size(), static_cast<off_t>(offset));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      offset += static_cast<std::uint64_t>(got);
      to = to.subspan(static_cast<std::size_t>(got));
    }
    return true;
  }

 private:
  const store::Descriptor file_;
  std::uint64_t size_ = 0;
};

class MemoryBytes : public ByteSource {
 public:
  explicit MemoryBytes(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {}
  [[nodiscard]] std::uint64_t size() const override { return bytes_.size(); }
  [[nodiscard]] bool read(std::uint64_t offset, std::span<std::uint8_t> to) const override {
    if (offset > bytes_.size() || to.size() > bytes_.size() - offset) return false;
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), to.size(), to.begin());
    return true;
  }

 private:
  const std::vector<std::uint8_t> bytes_;
};

}  // namespace

Result<std::shared_ptr<const ByteSource>> open_bytes(const std::filesystem::path& path, std::uint64_t size) {
  const auto bytes = std::make_shared<FileBytes>(path, size);
  if (bytes->ok()) return std::shared_ptr<const ByteSource>(bytes);
  const int error_number = errno;
  return Error{store::is_real_file(path) ? ErrorCode::io : ErrorCode::missing, path.string(),
               store::reason_of(path, error_number)};
}

std::shared_ptr<const ByteSource> bytes_in_memory(std::vector<std::uint8_t> bytes) {
  return std::make_shared<MemoryBytes>(std::move(bytes));
}

}  // namespace semblante::recordings
