#include "server/net/body_file.h"

#include <cerrno>
#include <fcntl.h>
#include <unistd.h>

namespace semblante::net {
namespace {

bool count_within(std::atomic<std::uint64_t>& count, std::uint64_t limit) {
  if (count++ < limit) return true;
  --count;
  return false;
}

}  // namespace

BodyFile::BodyFile(SharedState& state, const std::filesystem::path& path, int flags)
    : count_(state.files_open), is_counted_(count_within(state.files_open, state.config.limits.max_files)) {
  if (!is_counted_) return;
  descriptor_ = ::open(path.c_str(), flags | O_CLOEXEC, 0600);
  if (descriptor_ < 0) error_ = errno;
}

BodyFile::BodyFile(SharedState& state, const http::FileBody& body)
    : count_(state.files_open),
      is_counted_(count_within(state.files_open, state.config.limits.max_files)),
      open_(is_counted_ && !body.open ? std::make_shared<const http::OpenFile>(body.path) : body.open) {
  if (!is_counted_) return;
  descriptor_ = open_->descriptor();
  if (descriptor_ < 0) error_ = errno;
}

BodyFile::~BodyFile() {
  if (descriptor_ >= 0 && !open_) ::close(descriptor_);
  if (is_counted_) --count_;
}

}  // namespace semblante::net
