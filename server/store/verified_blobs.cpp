#include "server/store/verified_blobs.h"

#include <sys/stat.h>

namespace semblante::store {
namespace {

std::int64_t nanoseconds(const timespec& time) {
  constexpr std::int64_t second = 1'000'000'000;
  return static_cast<std::int64_t>(time.tv_sec) * second + time.tv_nsec;
}

std::optional<FileStamp> stamp_of(const struct stat& facts) {
  if (!S_ISREG(facts.st_mode)) return std::nullopt;
  return FileStamp{facts.st_dev, facts.st_ino, static_cast<std::uint64_t>(facts.st_size), nanoseconds(facts.st_mtim),
                   nanoseconds(facts.st_ctim)};
}

}  // namespace

std::optional<FileStamp> file_stamp(const std::filesystem::path& path) {
  struct stat facts {};
  if (::lstat(path.c_str(), &facts) != 0) return std::nullopt;
  return stamp_of(facts);
}

std::optional<FileStamp> file_stamp(const Descriptor& file) {
  struct stat facts {};
  if (::fstat(file.get(), &facts) != 0) return std::nullopt;
  return stamp_of(facts);
}

bool VerifiedBlobs::contains(const std::string& sha256, const std::optional<FileStamp>& stamp) const {
  if (!stamp) return false;
  const std::lock_guard lock(mutex_);
  const auto found = stamps_.find(sha256);
  return found != stamps_.end() && found->second == *stamp;
}

void VerifiedBlobs::add(const std::string& sha256, const FileStamp& stamp) {
  const std::lock_guard lock(mutex_);
  stamps_.insert_or_assign(sha256, stamp);
}

void VerifiedBlobs::remove(const std::string& sha256) {
  const std::lock_guard lock(mutex_);
  stamps_.erase(sha256);
}

}  // namespace semblante::store
