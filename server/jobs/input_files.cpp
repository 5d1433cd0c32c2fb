#include "server/jobs/input_files.h"

#include <cerrno>
#include <fcntl.h>
#include <unistd.h>

#include <sys/stat.h>

namespace semblante::jobs {

InputFiles::InputFiles(const std::vector<std::string>& paths) {
  for (const auto& path : paths) {
    if (!descriptors_.contains(path)) descriptors_[path] = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  }
}

InputFiles::~InputFiles() {
  for (const auto& [path, descriptor] : descriptors_)
    if (descriptor >= 0) ::close(descriptor);
}

Result<std::vector<std::uint8_t>> InputFiles::read(const std::string& path) const {
  const Error unreadable{ErrorCode::io, "", "the bytes of the model cannot be read"};
  const auto found = descriptors_.find(path);
  struct stat facts {};
  if (found == descriptors_.end() || found->second < 0 || ::fstat(found->second, &facts) != 0) return unreadable;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(facts.st_size));
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const auto got = ::pread(found->second, bytes.data() + filled, bytes.size() - filled, static_cast<off_t>(filled));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return unreadable;
    filled += static_cast<std::size_t>(got);
  }
  return bytes;
}

}  // namespace semblante::jobs
