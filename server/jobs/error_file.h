#pragma once

#include <filesystem>

namespace semblante::jobs {

/// A temporary file for what a program writes to its standard error; removed by the destructor.
class ErrorFile {
 public:
  /// `folder` empty: the system's. Throws store::StoreError when it cannot be made.
  explicit ErrorFile(const std::filesystem::path& folder);
  ~ErrorFile();
  ErrorFile(const ErrorFile&) = delete;
  ErrorFile& operator=(const ErrorFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace semblante::jobs
