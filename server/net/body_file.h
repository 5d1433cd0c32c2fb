#pragma once

// Private to net/.

#include <filesystem>

#include "server/net/state.h"

namespace semblante::net {

/// The open file of a request's or an answer's body: the second descriptor that a connection may need. Within the limit
/// of such files.
class BodyFile {
 public:
  /// `flags`: of OpenFile.
  BodyFile(SharedState& state, const std::filesystem::path& path, int flags);
  /// Of an answer: a file that is open already is not opened again.
  BodyFile(SharedState& state, const http::FileBody& body);
  ~BodyFile();
  BodyFile(const BodyFile&) = delete;
  BodyFile& operator=(const BodyFile&) = delete;

  /// -1 if it is not open.
  [[nodiscard]] int descriptor() const { return open_ ? open_->descriptor() : -1; }
  /// True if the file was not opened because the limit of open files is reached.
  [[nodiscard]] bool is_over_limit() const { return !is_counted_; }
  /// errno of open(); 0 if that was not called.
  [[nodiscard]] int error() const { return open_ ? open_->error() : 0; }

 private:
  std::atomic<std::uint64_t>& count_;
  const bool is_counted_;
  std::shared_ptr<const http::OpenFile> open_;  ///< null if the limit is reached
};

}  // namespace semblante::net
