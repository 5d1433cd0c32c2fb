#include "server/net/body_file.h"

#include <memory>

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
  if (is_counted_) open_ = std::make_shared<const http::OpenFile>(path, flags);
}

BodyFile::BodyFile(SharedState& state, const http::FileBody& body)
    : count_(state.files_open), is_counted_(count_within(state.files_open, state.config.limits.max_files)) {
  if (is_counted_) open_ = body.open ? body.open : std::make_shared<const http::OpenFile>(body.path);
}

BodyFile::~BodyFile() {
  if (is_counted_) --count_;
}

}  // namespace semblante::net
