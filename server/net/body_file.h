#pragma once

// Private to net/.

#include <filesystem>

#include "server/net/state.h"

namespace semblante::net {

/// The open file of a request's or an answer's body: the second descriptor that a connection may need. Within the limit
/// of such files.
class BodyFile {
 public:
  /// `flags`: of open(); new files are readable for their owner only.
  BodyFile(SharedState& state, const std::filesystem::path& path, int flags);
  /// Of an answer; what is open already stays so until the end of this.
  BodyFile(SharedState& state, const http::FileBody& body);
  ~BodyFile();
  BodyFile(const BodyFile&) = delete;
  BodyFile& operator=(const BodyFile&) = delete;

  /// -1 if it is not open.
  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// True if the file was not opened because the limit of open files is reached.
  [[nodiscard]] bool is_over_limit() const { return !is_counted_; }
  /// errno of open(); 0 if that was not called.
  [[nodiscard]] int error() const { return error_; }

 private:
  std::atomic<std::uint64_t>& count_;
  const bool is_counted_;
  const std::shared_ptr<const http::OpenFile> open_;  ///< whose descriptor it is; null: its own
  int descriptor_ = -1, error_ = 0;
};

}  // namespace semblante::net
